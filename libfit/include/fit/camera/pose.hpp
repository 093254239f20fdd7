#pragma once
/// \file  How a rigid body moves in the plane of a film, from smoothed markers on it; (V20), docs/theory/camera.md.
#include <Eigen/Core>

#include <string>
#include <vector>

#include "fit/camera/smooth.hpp"

namespace fit::camera {

/// A marker, and where it sits on the body.
struct MarkerOnBody {
  std::string marker;
  Eigen::Vector2d at;  ///< m, from the body's origin along its axes, which are those of the plane where its angle is 0
};

/// One instant of a body.
struct PlanarMotion {
  Eigen::Vector3d place, velocity, acceleration;  ///< of the origin along the axis and up, m; of the angle, rad
  Eigen::Matrix<double, 9, 9> covariance;         ///< of place, velocity and acceleration, one after the other
  double stray = 0;                               ///< rms of what markers are off the body by, over their errors
};

/// At each frame, weighted least squares of the places, velocities and accelerations of the markers, whose errors
/// belong together, by those of a rigid body. Angles grow up from the axis, or down, and go on without jumps, the first
/// within ±π. \throws hydro::InputError: fewer than two markers, an unknown one, all at one place of the body
std::vector<PlanarMotion> planar_motion(const SmoothTrack& track, const std::vector<MarkerOnBody>& markers,
                                        bool downwards);

}  // namespace fit::camera
