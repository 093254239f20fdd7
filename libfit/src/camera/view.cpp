#include "fit/camera/view.hpp"

#include <Eigen/Geometry>

#include "hydro/base/error.hpp"

namespace fit::camera {
namespace {

Eigen::Matrix3d matrix_of(const PlanePose& pose) {
  const double angle = pose.rotation.norm();
  if (angle == 0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, pose.rotation / angle).toRotationMatrix();
}

/// m in the plane, x right and y down in its own axes, before it is turned upright and placed. (V3)
Eigen::Vector2d flat(const View& view, const Eigen::Vector2d& pixel) {
  if (!view.lens) return view.metres_per_pixel * pixel;
  const Eigen::Vector2d ray = ray_of(*view.lens, pixel);
  if (!view.pose) return view.metres_per_pixel * (view.lens->principal + view.lens->focal.cwiseProduct(ray)).eval();
  // The ray λ(x, y, 1) meets the plane R q + t: Rᵀ(λ d − t) has no third component.
  const Eigen::Matrix3d back = matrix_of(*view.pose).transpose();
  const Eigen::Vector3d d = back * Eigen::Vector3d(ray.x(), ray.y(), 1), t = back * view.pose->translation;
  const double along = t.z() / d.z();
  if (!(along > 0) || !std::isfinite(along))
    throw hydro::InputError(
        fmt::format("the pixel ({:.6g}, {:.6g}) looks past the plane of motion", pixel.x(), pixel.y()), {},
        "the pose is not that of a board in the plane of motion: calibrate again");
  return (along * d - t).head<2>();
}

Eigen::Vector2d pixel_of_flat(const View& view, const Eigen::Vector2d& place) {
  if (!view.lens) return place / view.metres_per_pixel;
  if (!view.pose)
    return pixel_of(
        *view.lens,
        Eigen::Vector2d((place / view.metres_per_pixel - view.lens->principal).cwiseQuotient(view.lens->focal)));
  const Eigen::Vector3d seen =
      matrix_of(*view.pose) * Eigen::Vector3d(place.x(), place.y(), 0) + view.pose->translation;
  hydro::require(seen.z() > 0, "the place ({:.4g}, {:.4g}) m of the plane of motion lies behind the camera", place.x(),
                 place.y());
  return pixel_of(*view.lens, Eigen::Vector2d(seen.head<2>() / seen.z()));
}

/// From x right, y down (or up, as the track counts) to the scene's directions.
Eigen::Matrix2d upright(const View& view) {
  const Eigen::Matrix2d turned = Eigen::Rotation2Dd(view.rotation).toRotationMatrix();
  return Eigen::Vector2d(view.leftwards ? -1 : 1, 1).asDiagonal() * turned *
         Eigen::Vector2d(1, view.y_down ? -1 : 1).asDiagonal();
}

}  // namespace

Eigen::Vector2d point_of(const View& view, const Eigen::Vector2d& pixel) {
  return view.pivot_at + upright(view) * (flat(view, pixel) - flat(view, view.pivot));
}

Eigen::Vector2d pixel_of(const View& view, const Eigen::Vector2d& point) {
  return pixel_of_flat(view, flat(view, view.pivot) + upright(view).transpose() * (point - view.pivot_at));
}

Eigen::Matrix2d point_slope(const View& view, const Eigen::Vector2d& pixel) {  // (V4)
  constexpr double step = 1e-3;
  Eigen::Matrix2d out;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d move = step * Eigen::Vector2d::Unit(k);
    out.col(k) = (point_of(view, pixel + move) - point_of(view, pixel - move)) / (2 * step);
  }
  return out;
}

Eye eye_of(const View& view, int along, double across_at) {  // (V21)
  hydro::require(view.lens && view.pose,
                 "a camera is in space where a board in the plane of motion told its pose: calibrate with --plane");
  const Eigen::Matrix3d board = matrix_of(*view.pose);
  const auto seen = [&](const Eigen::Vector2d& in_plane) -> Eigen::Vector3d {
    return board.leftCols<2>() * (upright(view).transpose() * in_plane);
  };
  const Eigen::Vector3d right = seen({1, 0}), up = seen({0, 1});
  Eye out{*view.lens, {}, {}};
  if (along == 0)
    out.rotation << right, up.cross(right), up;
  else
    out.rotation << right.cross(up), right, up;
  out.translation = board.leftCols<2>() * flat(view, view.pivot) + view.pose->translation - seen(view.pivot_at) -
                    across_at * out.rotation.col(1 - along);
  return out;
}

}  // namespace fit::camera
