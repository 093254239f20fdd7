#pragma once
/// \file  Places and poses in space from pixels, by one calibrated camera and markers whose places on a body are known,
///        or by two; (V21)-(V23), docs/theory/camera.md.
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

#include "fit/camera/track.hpp"

namespace fit::camera {

/// \throws hydro::InputError for a point that is not before the camera
Eigen::Vector2d pixel_of(const Eye& eye, const Eigen::Vector3d& point);
/// ∂ pixel / ∂ point.
Eigen::Matrix<double, 2, 3> pixel_slope(const Eye& eye, const Eigen::Vector3d& point);

struct MarkerInSpace {
  std::string marker;
  Eigen::Vector3d at;  ///< m, body axes from its origin
};

struct SpacePose {
  Eigen::Vector3d place;                   ///< of the body's origin, scene, m
  Eigen::Quaterniond attitude;             ///< from body axes to the scene's
  Eigen::Matrix<double, 6, 6> covariance;  ///< of the place, m, and of a small turn about the scene's axes, rad
  double stray;                            ///< rms of pixels missed over their errors
  double freedoms = 0;                     ///< of these pixels: 2 n − 6
};

struct SpacePoses {
  std::vector<std::optional<SpacePose>> pose;  ///< one a frame
  int too_few = 0;                             ///< frames in which fewer than four markers were seen
  int ambiguous = 0;                           ///< frames that a mirrored pose explains as well
  int lost = 0;                                ///< frames that no pose near the one before explains
  /// One a frame: rms of the pixels that the best pose misses over their errors, also where that is too much for a pose
  /// to be told; not a number where none was found.
  std::vector<double> stray;
  /// Frames whose pixels lie farther from every pose than their errors allow; `lost` counts them, too.
  std::vector<std::size_t> misfits;
};

/// At each frame by weighted least squares of the pixels, sightings without covariance by `deviation`, px; the first
/// begins at `place` and without a turn, each other at the one before. Markers in one plane have a second pose, tilted
/// the other way, that looks nearly alike: where twice its log-likelihood is within 9 of the best, and it is another
/// pose, the frame tells none. Nor does one whose χ² of 2 n − 6 freedoms is above the level that a clean film exceeds
/// in no frame in 99 of 100 cases. \throws hydro::InputError: a track in metres or of another size than the lens, fewer
/// than four markers, markers on one line, an unknown one, sightings without covariance where `deviation` is not
/// positive
SpacePoses poses_in_space(const Track& track, const Eye& eye, const std::vector<MarkerInSpace>& markers,
                          const Eigen::Vector3d& place, double deviation);

struct SpacePoint {
  Eigen::Vector3d at;          ///< m
  Eigen::Matrix3d covariance;  ///< m²
  double stray;                ///< |pixels missed over their errors|; one number is left over: of χ with one freedom
};
/// The point of which two cameras see one pixel each, with the covariances of both; none where their rays do not meet
/// before both. \throws hydro::InputError as ray_of()
std::optional<SpacePoint> triangulated(const Eye& first, const Sighting& at_first, const Eye& second,
                                       const Sighting& at_second);

struct SeenByEye {
  Track track;  ///< px; times of one clock for both cameras
  Eye eye;
  double deviation = 0;  ///< px, of sightings without covariance; 0: none is stated
};
struct SpaceTrack {
  std::vector<double> time;
  std::vector<std::string> markers;                           ///< that both tracks have
  std::vector<std::vector<std::optional<SpacePoint>>> point;  ///< of each marker, one a frame
  double spacing = 0;                                         ///< s, mean, of the second track's frames
  int points = 0, behind = 0;  ///< pairs of sightings with a point, and those whose rays do not meet
};
/// At the times of the first track. The second is taken between its frames by the cubic through the two on each side,
/// their covariances along, with what the bends of the marker's path let such a cubic miss; where one of the four is
/// missing there is a gap. \throws hydro::InputError: tracks in
/// metres or of another size than their lens, no marker in both, times that have nothing in common, sightings without
/// covariance where `deviation` is not positive
SpaceTrack joined(const SeenByEye& first, const SeenByEye& second);

}  // namespace fit::camera
