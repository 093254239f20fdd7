#include "dynamics/joint/constraints.hpp"

#include <cmath>
#include <numbers>

#include "dynamics/joint/coordinate.hpp"
#include "dynamics/spatial/rotation.hpp"

namespace dynamics {
namespace {

/// Arms, direction and the way from the first origin to the second point, along global axes.
struct Points {
  Eigen::Vector3d n, first_arm, second_arm, reach;

  Points(const PointConstraint& c, const ConstraintEnds& at)
      : n(c.turns ? Eigen::Vector3d(at.first.axes * c.direction) : c.direction),
        first_arm(at.first.axes * c.first_arm),
        second_arm(at.second.axes * c.second_arm),
        reach(at.second.origin + second_arm - at.first.origin) {}
};

}  // namespace

ConstraintEnds ends_of(const Constraint& constraint, const State& state) {
  return {frame_of(constraint.first, state), frame_of(constraint.second, state), state.time};
}

double value(const PointConstraint& c, const ConstraintEnds& at) {
  const Points p(c, at);
  return p.n.dot(p.reach - p.first_arm);
}

double value(const AxesConstraint& c, const ConstraintEnds& at) {
  return (at.first.axes * c.first_axis).dot(at.second.axes * c.second_axis);
}

// δ(n·d): both points move, and n turns with the first body (D13).
Gradient gradient(const PointConstraint& c, const ConstraintEnds& at) {
  const Points p(c, at);
  Gradient out;
  out.first << -p.n, p.n.cross(c.turns ? p.reach : p.first_arm);
  out.second << p.n, p.second_arm.cross(p.n);
  return out;
}

Gradient gradient(const AxesConstraint& c, const ConstraintEnds& at) {
  const Eigen::Vector3d turn = (at.first.axes * c.first_axis).cross(at.second.axes * c.second_axis);
  Gradient out;
  out.first << Eigen::Vector3d::Zero(), turn;
  out.second << Eigen::Vector3d::Zero(), -turn;
  return out;
}

// Rows and columns: x₁, θ₁, x₂, θ₂ (D15).
Matrix12 curvature(const PointConstraint& c, const ConstraintEnds& at) {
  const Points p(c, at);
  const Eigen::Matrix3d n = cross_matrix(p.n), second_arm = cross_matrix(p.second_arm);
  Matrix12 H = Matrix12::Zero();
  H.block<3, 3>(9, 9) = n * second_arm;
  if (!c.turns) {
    H.block<3, 3>(3, 3) = -n * cross_matrix(p.first_arm);
    return H;
  }
  H.block<3, 3>(0, 3) = n;
  H.block<3, 3>(3, 0) = -n;
  H.block<3, 3>(3, 3) = cross_matrix(p.reach) * n;
  H.block<3, 3>(3, 6) = n;
  H.block<3, 3>(3, 9) = -n * second_arm;
  H.block<3, 3>(6, 3) = -n;
  H.block<3, 3>(9, 3) = -second_arm * n;
  return H;
}

Matrix12 curvature(const AxesConstraint& c, const ConstraintEnds& at) {
  const Eigen::Matrix3d u = cross_matrix(at.first.axes * c.first_axis),
                        v = cross_matrix(at.second.axes * c.second_axis);
  Matrix12 H = Matrix12::Zero();
  H.block<3, 3>(3, 3) = v * u;
  H.block<3, 3>(3, 9) = -u * v;
  H.block<3, 3>(9, 3) = -v * u;
  H.block<3, 3>(9, 9) = u * v;
  return H;
}

namespace {

/// d²r/dt² of a vector that turns with a body.
Eigen::Vector3d centripetal(const Eigen::Vector3d& omega, const Eigen::Vector3d& r) {
  return omega.cross(omega.cross(r));
}

}  // namespace

double convective(const PointConstraint& c, const ConstraintEnds& at, const Vector12& v) {
  const Points p(c, at);
  const Eigen::Vector3d w1 = v.segment<3>(3), w2 = v.segment<3>(9);
  const double second = p.n.dot(centripetal(w2, p.second_arm));
  if (!c.turns) return second - p.n.dot(centripetal(w1, p.first_arm));
  const Eigen::Vector3d apart = v.segment<3>(6) + w2.cross(p.second_arm) - v.head<3>();
  return second + 2 * w1.cross(p.n).dot(apart) + centripetal(w1, p.n).dot(p.reach);
}

double convective(const AxesConstraint& c, const ConstraintEnds& at, const Vector12& v) {
  const Eigen::Vector3d w1 = v.segment<3>(3), w2 = v.segment<3>(9), first = at.first.axes * c.first_axis,
                        second = at.second.axes * c.second_axis;
  return centripetal(w1, first).dot(second) + 2 * w1.cross(first).dot(w2.cross(second)) +
         first.dot(centripetal(w2, second));
}

ClosestPoints closest_points(const GapConstraint& c, const ConstraintEnds& at) {
  return closest_points(moved(c.first, at.first.axes, at.first.origin),
                        moved(c.second, at.second.axes, at.second.origin));
}

Gradient apart(const Eigen::Vector3d& n, const Eigen::Vector3d& on_first, const Eigen::Vector3d& on_second,
               const ConstraintEnds& at) {
  Gradient out;
  out.first << -n, n.cross(on_first - at.first.origin);
  out.second << n, (on_second - at.second.origin).cross(n);
  return out;
}

double value(const GapConstraint& c, const ConstraintEnds& at) { return closest_points(c, at).gap; }

// The points are those of the shortest way: how they wander over the shapes changes its length by nothing (D23).
Gradient gradient(const GapConstraint& c, const ConstraintEnds& at) {
  const ClosestPoints m = closest_points(c, at);
  return apart(m.normal, m.on_first, m.on_second, at);
}

double value(const StickConstraint&, const ConstraintEnds&) { return 0; }

Gradient gradient(const StickConstraint& c, const ConstraintEnds& at) {
  const ClosestPoints m = closest_points(c.shapes, at);
  return apart(c.direction, m.on_first, m.on_second, at);
}

namespace {

template <class ContactConstraint>
Matrix12 curvature_by_differences(const ContactConstraint& c, const ConstraintEnds& at) {
  constexpr double by = 1e-5;  // m and rad: rounding and curvature of higher order are both 1e-10 there
  const auto displaced = [&](int k, double way) {
    ConstraintEnds out = at;
    const Eigen::Vector3d move = way * Eigen::Vector3d::Unit(k % 3);
    if (k / 3 == 0) out.first.origin += move;
    if (k / 3 == 1) out.first.axes = rotation_exp(move).toRotationMatrix() * at.first.axes;
    if (k / 3 == 2) out.second.origin += move;
    if (k / 3 == 3) out.second.axes = rotation_exp(move).toRotationMatrix() * at.second.axes;
    return joined(gradient(c, out));
  };
  Matrix12 H;
  for (int k = 0; k < 12; ++k) H.col(k) = (displaced(k, by) - displaced(k, -by)) / (2 * by);
  return H;
}

}  // namespace

Matrix12 curvature(const GapConstraint& c, const ConstraintEnds& at) { return curvature_by_differences(c, at); }
Matrix12 curvature(const StickConstraint& c, const ConstraintEnds& at) { return curvature_by_differences(c, at); }

// (D31)
double value(const PrescribedConstraint& c, const ConstraintEnds& at) {
  const double off = c.coordinate->value(at) - c.motion(at.time).coordinate;
  return c.coordinate->turns() ? std::remainder(off, 2 * std::numbers::pi) : off;
}

Gradient gradient(const PrescribedConstraint& c, const ConstraintEnds& at) { return c.coordinate->gradient(at); }
Matrix12 curvature(const PrescribedConstraint& c, const ConstraintEnds& at) { return c.coordinate->curvature(at); }

}  // namespace dynamics
