#pragma once
/// \file  How far the second body of a slider has gone along its axis, or of a hinge has turned about it: one number
/// with
///        gradient and curvature, made of the conditions of joints. (D53)
#include "dynamics/joint/conditions.hpp"

namespace dynamics {

/// Zero at rest. The angle of a hinge is the nearest to the one that a State has counted last under the joint's place
/// among the model's joints (D133); without such a place it lies within half a turn, −π … π.
class Travel {
 public:
  /// `joint`: a slider or hinge, as JointSet takes it; `counted_as`: its place there.
  Travel(const std::vector<RigidBody>& bodies, const Joint& joint, std::optional<int> counted_as = {});
  /// Arms from the bodies' centres to the joint's place, body axes; of the ground: the global place.
  Travel(const Joint& joint, const Eigen::Vector3d& first_arm, const Eigen::Vector3d& second_arm,
         std::optional<int> counted_as = {});

  int first() const { return first_; }
  const std::optional<int>& second() const { return second_; }
  double value(const ConditionEnds& at) const;  ///< m or rad; of hinges within half a turn
  Gradient gradient(const ConditionEnds& at) const;
  Matrix12 curvature(const ConditionEnds& at) const;
  double value(const State& state) const;
  Gradient gradient(const State& state) const { return gradient(ends(state)); }
  Matrix12 curvature(const State& state) const { return curvature(ends(state)); }
  double rate(const State& state) const;  ///< m/s or rad/s
  /// Of a hinge: angles come back after a turn.
  bool turns() const { return turns_; }
  /// False of a hinge whose turns no State counts: its angle jumps after half a turn.
  bool is_continuous() const { return !turns_ || counted_as_; }
  /// A condition that holds the travel where it is in `state`, where the joint is closed with gradient() as its
  /// gradient; of no joint.
  Condition holding(const State& state) const;

 private:
  ConditionEnds ends(const State& state) const { return ends_of({0, first_, second_, along_}, state); }

  int first_;
  std::optional<int> second_;
  bool turns_;
  std::optional<int> counted_as_;
  PointCondition along_;         // of sliders
  AxesCondition cosine_, sine_;  // of hinges
};

}  // namespace dynamics
