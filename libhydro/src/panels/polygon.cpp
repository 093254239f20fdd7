#include "polygon.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace hydro::panels {
namespace {

using Eigen::Vector3d;

/// ln((r2 + l2)/(r1 + l1)) in the form that does not cancel: (r + l)(r − l) is the same at both ends.
double edge_logarithm(double r1, double l1, double r2, double l2) {
  return l1 + l2 < 0 ? std::log((r1 - l1) / (r2 - l2)) : std::log((r2 + l2) / (r1 + l1));
}

}  // namespace

Polygon polygon(std::vector<Vector3d> corners) {
  Polygon p{
      .corners = std::move(corners), .centre = Vector3d::Zero(), .normal = Vector3d::Zero(), .area = 0, .size = 0};
  Vector3d twice = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < p.corners.size(); ++i)
    twice += (p.corners[i] - p.corners[0]).cross(p.corners[i + 1] - p.corners[0]);
  p.area = twice.norm() / 2;
  p.normal = twice / twice.norm();
  for (std::size_t i = 1; i + 1 < p.corners.size(); ++i) {
    const Vector3d &a = p.corners[0], &b = p.corners[i], &c = p.corners[i + 1];
    p.centre += (b - a).cross(c - a).dot(p.normal) / 2 * (a + b + c) / 3;
  }
  p.centre /= p.area;
  for (const Vector3d& a : p.corners)
    for (const Vector3d& b : p.corners) p.size = std::max(p.size, (a - b).norm());
  return p;
}

Rankine rankine(const Polygon& polygon, const Vector3d& P) {
  const double height = polygon.normal.dot(P - polygon.centre), above = std::abs(height);
  const double tiny = 1e-14 * polygon.size;
  double source = 0, angle = 0;
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const Vector3d a = polygon.corners[i] - P, b = polygon.corners[(i + 1) % polygon.corners.size()] - P;
    const Vector3d along = (b - a).normalized();
    const double d = a.dot(along.cross(polygon.normal)), l1 = a.dot(along), l2 = b.dot(along);
    const double off = d * d + above * above;
    if (off < tiny * tiny) continue;  // P on the line of the edge: d ln vanishes
    const double r1 = a.norm(), r2 = b.norm();
    source += d * edge_logarithm(r1, l1, r2, l2);
    if (above > tiny) angle += std::atan2(d * l2, off + above * r2) - std::atan2(d * l1, off + above * r1);
  }
  return {source - above * angle, height > 0 ? angle : -angle};
}

}  // namespace hydro::panels
