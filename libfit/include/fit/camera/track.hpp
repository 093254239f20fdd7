#pragma once
/// \file  What a film tells: where markers were seen, frame by frame, with the covariance of each place.
#include <Eigen/Core>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fit/camera/view.hpp"

namespace fit::camera {

struct Sighting {
  Eigen::Vector2d at;                                          ///< px, or m
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Constant(-1);  ///< of its errors, in that unit squared
  bool has_covariance() const { return covariance(0, 0) >= 0; }
};

/// One marker over all frames; none where it was not seen.
struct Marker {
  std::string name;
  std::vector<std::optional<Sighting>> seen;
};

struct Track {
  std::vector<double> time;  ///< s, of the frames; ascending, not necessarily even
  std::vector<Marker> markers;
  bool in_metres = false;      ///< pixels otherwise
  Eigen::Vector2i size{0, 0};  ///< px, width and height of the film's pictures; zero where that is not told

  std::size_t frames() const { return time.size(); }
  /// \throws hydro::InputError with the nearest name
  const Marker& marker(std::string_view name) const;
};

/// The frames from one time to another, both counted; time is then counted from the first of these times. \throws
/// hydro::InputError if fewer than two are left
Track cut(const Track& track, double from, double to);

/// The same places in metres of the plane of motion, covariances along; `deviation` in the track's unit is that of the
/// sightings that have none. \throws hydro::InputError as point_of(), naming marker and time, and for a sighting
/// without covariance where `deviation` is not positive
Track in_plane(const Track& track, const View& view, double deviation);

/// Mean distance between two markers in the frames in which both were seen, in the track's unit, with the lens's
/// distortion taken out. \throws hydro::InputError if they never were
double mean_distance(const Track& track, const View& view, std::string_view a, std::string_view b);

}  // namespace fit::camera
