#pragma once
/// \file  How far the second body of a slider has gone along its axis, or of a hinge has turned about it: one number
///        with gradient and curvature, made of the constraints of joints. (D53)
#include "dynamics/joint/constraints.hpp"

namespace dynamics {

/// Zero at rest. The angle of a hinge is the nearest to the one that a State has counted last under the joint's place
/// among the model's joints (D133); without such a place it lies within half a turn, −π … π.
class JointCoordinate {
 public:
  /// `joint`: a slider or hinge, as JointSet takes it; `counted_as`: its place there.
  JointCoordinate(const std::vector<RigidBody>& bodies, const Joint& joint, std::optional<int> counted_as = {});
  JointCoordinate(const Joint& joint, const JointArms& arms, std::optional<int> counted_as = {});

  int first() const { return first_; }
  const std::optional<int>& second() const { return second_; }
  double value(const ConstraintEnds& at) const;  ///< m or rad; of hinges within half a turn
  Gradient gradient(const ConstraintEnds& at) const;
  Matrix12 curvature(const ConstraintEnds& at) const;
  double value(const State& state) const;
  Gradient gradient(const State& state) const { return gradient(ends(state)); }
  Matrix12 curvature(const State& state) const { return curvature(ends(state)); }
  double rate(const State& state) const;  ///< m/s or rad/s
  /// Of a hinge: angles come back after a turn.
  bool turns() const { return turns_; }
  /// False of a hinge whose turns no State counts: its angle jumps after half a turn.
  bool is_continuous() const { return !turns_ || counted_as_; }
  /// A constraint that holds the coordinate where it is in `state`, where the joint is closed with gradient() as its
  /// gradient; of no joint.
  Constraint holding(const State& state) const;

 private:
  ConstraintEnds ends(const State& state) const {
    return {frame_of(first_, state), frame_of(second_, state), state.time};
  }

  int first_;
  std::optional<int> second_;
  bool turns_;
  std::optional<int> counted_as_;
  PointConstraint along_;         // of sliders
  AxesConstraint cosine_, sine_;  // of hinges
};

}  // namespace dynamics
