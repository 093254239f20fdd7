#include "potential/control_surface.hpp"

#include <cmath>
#include <numbers>

#include "waves/gauss_legendre.hpp"

namespace hydro::potential {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Calls add(s, weight) at Gauss's points of [0, 1], cut into pieces of which none is longer than `longest` / `length`.
template <class Add>
void each_point(double length, double longest, const Add& add) {
  static const waves::GaussLegendre<4> rule;
  const int pieces = static_cast<int>(std::ceil(length / longest));
  for (int piece = 0; piece < pieces; ++piece)
    for (std::size_t i = 0; i < rule.point.size(); ++i)
      add((piece + (1 + rule.point[i]) / 2) / pieces, length * rule.weight[i] / (2 * pieces));
}

}  // namespace

std::vector<ControlPoint> circle(const Vector2d& centre, double radius, int count) {
  std::vector<ControlPoint> out;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count;
    const Vector2d normal(std::cos(angle), std::sin(angle));
    out.push_back({centre + radius * normal, normal, 2 * pi * radius / count});
  }
  return out;
}

std::vector<ControlPoint> line_about(const std::vector<Vector2d>& polygon, double distance, double longest) {
  std::vector<ControlPoint> out;
  const std::size_t corners = polygon.size();
  const auto normal_of = [&](std::size_t edge) {
    const Vector2d along = (polygon[(edge + 1) % corners] - polygon[edge % corners]).normalized();
    return Vector2d(along.y(), -along.x());
  };
  for (std::size_t i = 0; i < corners; ++i) {
    const Vector2d &from = polygon[i], &to = polygon[(i + 1) % corners];
    const Vector2d normal = normal_of(i), next = normal_of(i + 1);
    each_point((to - from).norm(), longest, [&](double s, double weight) {
      out.push_back({from + s * (to - from) + distance * normal, normal, weight});
    });
    // Anticlockwise about the corner; back along a plate it is half a turn.
    const double turn = std::abs(std::atan2(cross(normal, next), normal.dot(next)));
    each_point(distance * turn, longest, [&](double s, double weight) {
      const Vector2d here = std::cos(s * turn) * normal + std::sin(s * turn) * Vector2d(-normal.y(), normal.x());
      out.push_back({to + distance * here, here, weight});
    });
  }
  return out;
}

Eigen::Vector3d load_through(const ControlPoint& point, const Vector2d& about, double density,
                             const Eigen::Vector2cd& slope, double normal_part) {
  const std::complex<double> out = slope.x() * point.normal.x() + slope.y() * point.normal.y();
  const Vector2d force = point.length * (normal_part * point.normal - density / 2 * (std::conj(out) * slope).real());
  return {force.x(), force.y(), cross(point.at - about, force)};
}

}  // namespace hydro::potential
