#include "fit/camera/lens.hpp"

#include <Eigen/LU>

#include <cmath>

#include "hydro/base/error.hpp"

namespace fit::camera {

Eigen::Vector2d distorted(const Lens& lens, const Eigen::Vector2d& ray) {  // (V1)
  const auto [k1, k2, k3] = lens.radial;
  const auto [p1, p2] = lens.tangential;
  const double x = ray.x(), y = ray.y(), s = ray.squaredNorm(), radial = 1 + s * (k1 + s * (k2 + s * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (s + 2 * x * x), y * radial + p1 * (s + 2 * y * y) + 2 * p2 * x * y};
}

Eigen::Matrix2d distortion_slope(const Lens& lens, const Eigen::Vector2d& ray) {
  const auto [k1, k2, k3] = lens.radial;
  const auto [p1, p2] = lens.tangential;
  const double x = ray.x(), y = ray.y(), s = ray.squaredNorm(), radial = 1 + s * (k1 + s * (k2 + s * k3)),
               steeper = 2 * (k1 + s * (2 * k2 + s * 3 * k3));  // of the radial factor, over x or y
  const double across = steeper * x * y + 2 * p1 * x + 2 * p2 * y;
  Eigen::Matrix2d out;
  out << radial + steeper * x * x + 2 * p1 * y + 6 * p2 * x, across, across,
      radial + steeper * y * y + 6 * p1 * y + 2 * p2 * x;
  return out;
}

Eigen::Vector2d pixel_of(const Lens& lens, const Eigen::Vector2d& ray) {
  return lens.principal + lens.focal.cwiseProduct(distorted(lens, ray));
}

Eigen::Vector2d ray_of(const Lens& lens, const Eigen::Vector2d& pixel) {  // (V2)
  constexpr int rounds = 30;
  constexpr double solved = 1e-12;
  const Eigen::Vector2d seen = (pixel - lens.principal).cwiseQuotient(lens.focal);
  Eigen::Vector2d ray = seen;
  for (int i = 0; i < rounds; ++i) {
    const Eigen::Vector2d missed = distorted(lens, ray) - seen;
    const Eigen::Matrix2d slope = distortion_slope(lens, ray);
    if (!(slope.determinant() > 0) || !missed.allFinite()) break;  // beyond it the picture is folded over itself
    if (missed.norm() < solved) return ray;
    ray -= slope.inverse() * missed;
  }
  throw hydro::InputError(fmt::format("the pixel ({:.6g}, {:.6g}) lies where this lens's distortion folds the picture",
                                      pixel.x(), pixel.y()),
                          {}, "calibrate with a board that also stands near the edges, or with fewer coefficients");
}

void check(const Lens& lens) {
  hydro::require((lens.focal.array() > 0).all(), "the focal lengths must be positive, got {} and {} px", lens.focal.x(),
                 lens.focal.y());
  hydro::require((lens.size.array() > 0).all(), "the size of the pictures must be positive, got {} x {} px",
                 lens.size.x(), lens.size.y());
  const double right = lens.size.x() - 1, bottom = lens.size.y() - 1;
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(right, 0), Eigen::Vector2d(0, bottom), Eigen::Vector2d(right, bottom)})
    ray_of(lens, corner);
}

}  // namespace fit::camera
