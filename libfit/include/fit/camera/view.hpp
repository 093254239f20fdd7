#pragma once
/// \file  From pixels to metres in the plane of motion and back; (V3), (V4), docs/theory/camera.md.
#include <Eigen/Core>

#include <optional>

#include "fit/camera/lens.hpp"

namespace fit::camera {

/// Where the plane of motion stands before the camera, as a board in it tells: its own axes (x right, y down) in those
/// of the camera.
struct PlanePose {
  Eigen::Vector3d rotation;     ///< rad, axis times angle (Rodrigues), board to camera
  Eigen::Vector3d translation;  ///< m, of the board's first corner in the camera's axes
};

/// What is true of a film, so that its pixels are places. One of `metres_per_pixel` and `pose`; a pose needs a lens.
struct View {
  std::optional<Lens> lens = {};
  std::optional<PlanePose> pose = {};
  double metres_per_pixel = 0;  ///< of the picture without distortion, where there is no pose
  bool y_down = true;           ///< in the track; false: rows count upwards
  bool leftwards = false;       ///< the axis of the plane of motion points to the left in the picture
  double rotation = 0;          ///< rad, anticlockwise as seen: turns the picture upright
  Eigen::Vector2d pivot = {0,
                           0};  ///< a point of the picture, as the track has it: px, or m where `metres_per_pixel` is 1
  Eigen::Vector2d pivot_at = {0, 0};  ///< where it is in the plane of motion: m, along the axis and up
};

/// A place in the plane of motion (m: along the axis that points to the right, and up) of a pixel. \throws
/// hydro::InputError as ray_of(), and for a pixel that looks past the plane
Eigen::Vector2d point_of(const View& view, const Eigen::Vector2d& pixel);
/// The other way. \throws hydro::InputError for a place behind the camera
Eigen::Vector2d pixel_of(const View& view, const Eigen::Vector2d& point);
/// ∂ point / ∂ pixel, by central differences of a thousandth of a pixel: good to 1e-6.
Eigen::Matrix2d point_slope(const View& view, const Eigen::Vector2d& pixel);

/// A camera in the scene: X_camera = rotation X_scene + translation, camera axes x right, y down, z ahead.
struct Eye {
  Lens lens;
  Eigen::Matrix3d rotation;
  Eigen::Vector3d translation;  ///< m
};
/// (V21) From the pose of a board in the plane of motion; `along` is the coordinate of the scene along the picture (0:
/// x, 1: y), `across_at` where the plane is on the other horizontal one, m. \throws hydro::InputError without a pose
Eye eye_of(const View& view, int along, double across_at);

}  // namespace fit::camera
