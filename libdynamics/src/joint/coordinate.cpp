#include "dynamics/joint/coordinate.hpp"

#include <cmath>

#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

JointCoordinate::JointCoordinate(const Joint& joint, const JointArms& arms, std::optional<int> counted_as)
    : first_(joint.first), second_(joint.second), turns_(joint.kind == JointKind::hinge), counted_as_(counted_as) {
  hydro::ensure(turns_ || joint.kind == JointKind::slider, "coordinate of a joint that is neither slider nor hinge");
  const Eigen::Matrix3d frame = frame_of(joint);
  along_ = {arms.first, arms.second, frame.col(0), true};
  cosine_ = {frame.col(1), frame.col(1)};
  sine_ = {frame.col(2), frame.col(1)};
}

JointCoordinate::JointCoordinate(const std::vector<RigidBody>& bodies, const Joint& joint,
                                 std::optional<int> counted_as)
    : JointCoordinate(joint, arms_at_rest(bodies, joint), counted_as) {}

double JointCoordinate::value(const ConstraintEnds& at) const {
  if (!turns_) return dynamics::value(along_, at);
  return std::atan2(dynamics::value(sine_, at), dynamics::value(cosine_, at));
}

// (D133)
double JointCoordinate::value(const State& state) const {
  const double within = value(ends(state));
  if (!turns_ || !counted_as_) return within;
  const auto j = static_cast<std::size_t>(*counted_as_);
  return nearest_turn(within, j < state.hinge_angle.size() ? state.hinge_angle[j] : 0);
}

Gradient JointCoordinate::gradient(const ConstraintEnds& at) const {
  if (!turns_) return dynamics::gradient(along_, at);
  const double c = dynamics::value(cosine_, at), s = dynamics::value(sine_, at), r2 = c * c + s * s;
  const Gradient dc = dynamics::gradient(cosine_, at), ds = dynamics::gradient(sine_, at);
  return {(c * ds.first - s * dc.first) / r2, (c * ds.second - s * dc.second) / r2};
}

// (D53)
Matrix12 JointCoordinate::curvature(const ConstraintEnds& at) const {
  if (!turns_) return dynamics::curvature(along_, at);
  const double c = dynamics::value(cosine_, at), s = dynamics::value(sine_, at), r2 = c * c + s * s;
  const Vector12 dc = joined(dynamics::gradient(cosine_, at)), ds = joined(dynamics::gradient(sine_, at));
  const Matrix12 numerator = c * dynamics::curvature(sine_, at) - s * dynamics::curvature(cosine_, at) +
                             ds * dc.transpose() - dc * ds.transpose();
  return numerator / r2 - (c * ds - s * dc) * (2 * c * dc + 2 * s * ds).transpose() / (r2 * r2);
}

double JointCoordinate::rate(const State& state) const {
  const Gradient g = gradient(state);
  return g.first.dot(state.twist(first_)) + (second_ ? g.second.dot(state.twist(*second_)) : 0);
}

// A hinge: y of the first body stays across what is its z now. A slider: the point of the second body that has come to
// the first's place stays in the plane across the axis.
Constraint JointCoordinate::holding(const State& state) const {
  const ConstraintEnds at = ends(state);
  constexpr int of_no_joint = -1;
  if (turns_)
    return {of_no_joint, first_, second_,
            AxesConstraint{-cosine_.first_axis, at.second.axes.transpose() * (at.first.axes * sine_.first_axis)}};
  PointConstraint here = along_;
  here.second_arm -= at.second.axes.transpose() * (at.first.axes * along_.direction) * dynamics::value(along_, at);
  return {of_no_joint, first_, second_, here};
}

}  // namespace dynamics
