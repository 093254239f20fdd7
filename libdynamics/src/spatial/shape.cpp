#include "dynamics/spatial/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

using Eigen::Vector3d;

Shape moved_shape(const Ball& s, const Eigen::Matrix3d& R, const Vector3d& d) {
  return Ball{R * s.centre + d, s.radius};
}
Shape moved_shape(const Rod& s, const Eigen::Matrix3d& R, const Vector3d& d) {
  return Rod{R * s.from + d, R * s.to + d, s.radius};
}
Shape moved_shape(const HalfSpace& s, const Eigen::Matrix3d& R, const Vector3d& d) {
  return HalfSpace{R * s.point + d, R * s.outward};
}
Shape moved_shape(const Box& s, const Eigen::Matrix3d& R, const Vector3d& d) {
  return Box{R * s.centre + d, s.half, R * s.axes};
}

constexpr double endless = std::numeric_limits<double>::infinity();

double half_thickness_of(const Ball& s) { return s.radius; }
double half_thickness_of(const Rod& s) { return s.radius; }
double half_thickness_of(const HalfSpace&) { return endless; }
double half_thickness_of(const Box& s) { return s.half.minCoeff(); }

double reach_of(const Ball& s) { return s.centre.norm() + s.radius; }
double reach_of(const Rod& s) { return std::max(s.from.norm(), s.to.norm()) + s.radius; }
double reach_of(const HalfSpace&) { return endless; }
double reach_of(const Box& s) { return s.centre.norm() + s.half.norm(); }

ClosestPoints reversed(ClosestPoints m) {
  std::swap(m.on_first, m.on_second);
  m.normal = -m.normal;
  return m;
}

/// Of two balls whose centres may coincide: then any way is as long.
ClosestPoints between(const Vector3d& a, double radius_a, const Vector3d& b, double radius_b) {
  const Vector3d way = b - a;
  const double length = way.norm();
  const Vector3d n = length > 0 ? Vector3d(way / length) : Vector3d::UnitZ();
  return {length - radius_a - radius_b, n, a + radius_a * n, b - radius_b * n};
}

ClosestPoints between(const HalfSpace& plane, const Ball& ball) {
  const double height = plane.outward.dot(ball.centre - plane.point);
  return {height - ball.radius, plane.outward, ball.centre - height * plane.outward,
          ball.centre - ball.radius * plane.outward};
}

ClosestPoints between(const Box& box, const Ball& ball) {
  const Vector3d local = box.axes.transpose() * (ball.centre - box.centre);
  const Vector3d nearest = local.cwiseMax(-box.half).cwiseMin(box.half);
  if (nearest != local) return between(box.centre + box.axes * nearest, 0, ball.centre, ball.radius);
  Eigen::Index face = 0;
  const double depth = (box.half - local.cwiseAbs()).minCoeff(&face);
  const Vector3d n = (local[face] < 0 ? -1 : 1) * box.axes.col(face);
  return {-depth - ball.radius, n, ball.centre + depth * n, ball.centre - ball.radius * n};
}

/// Shares of the way along each of two segments at which they are closest (D22).
std::pair<double, double> closest(const Rod& a, const Rod& b) {
  const Vector3d u = a.to - a.from, v = b.to - b.from, w = b.from - a.from;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const auto inside = [](double x) { return std::clamp(x, 0.0, 1.0); };
  const double cross = uu * vv - uv * uv;
  constexpr double parallel = 1e-12;
  double s = 0.5;
  if (cross > parallel * uu * vv) {
    s = inside((vv * u.dot(w) - uv * v.dot(w)) / cross);
  } else if (uu > 0 && vv > 0) {  // parallel: the middle of where they lie beside each other
    const double one = u.dot(w) / uu, other = u.dot(w + v) / uu;
    s = (inside(one) + inside(other)) / 2;
  }
  const double t = vv > 0 ? inside((s * uv - v.dot(w)) / vv) : 0;
  s = uu > 0 ? inside((t * uv + u.dot(w)) / uu) : 0;
  return {s, t};
}

ClosestPoints between(const Rod& a, const Rod& b) {
  const auto [s, t] = closest(a, b);
  return between(a.from + s * (a.to - a.from), a.radius, b.from + t * (b.to - b.from), b.radius);
}

}  // namespace

Shape moved(const Shape& shape, const Eigen::Matrix3d& turn, const Vector3d& way) {
  return std::visit([&](const auto& s) { return moved_shape(s, turn, way); }, shape);
}

double half_thickness(const Shape& shape) {
  return std::visit([](const auto& s) { return half_thickness_of(s); }, shape);
}

double reach(const Shape& shape) {
  return std::visit([](const auto& s) { return reach_of(s); }, shape);
}

ClosestPoints closest_points(const Shape& first, const Shape& second) {
  const auto as_rod = [](const Shape& s) -> std::optional<Rod> {
    if (const auto* rod = std::get_if<Rod>(&s)) return *rod;
    if (const auto* ball = std::get_if<Ball>(&s)) return Rod{ball->centre, ball->centre, ball->radius};
    return {};
  };
  const auto rod = as_rod(first), other = as_rod(second);
  if (rod && other) return between(*rod, *other);
  if (const auto* ball = std::get_if<Ball>(&second)) {
    if (const auto* plane = std::get_if<HalfSpace>(&first)) return between(*plane, *ball);
    return between(std::get<Box>(first), *ball);
  }
  hydro::require(std::holds_alternative<Ball>(first), "planes and boxes are in contact with balls only");
  return reversed(closest_points(second, first));
}

}  // namespace dynamics
