#pragma once
/// \file  One condition of a joint: its value, gradient and curvature (D13)-(D15). For JointSet and for tests.
#include "dynamics/joint/joint.hpp"

namespace dynamics {

using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Where the two bodies of a condition are.
struct ConditionEnds {
  Eigen::Vector3d first_centre, second_centre;  ///< global
  Eigen::Matrix3d first, second;                ///< attitudes; identity for the ground
};
ConditionEnds ends_of(const Condition& condition, const State& state);

/// The joint's frame at rest, columns x (the axis), y, z. \throws hydro::InputError for an axis without direction
Eigen::Matrix3d frame_of(const Joint& joint);

double value(const PointCondition& c, const ConditionEnds& at);
double value(const AxesCondition& c, const ConditionEnds& at);

Gradient gradient(const PointCondition& c, const ConditionEnds& at);
Gradient gradient(const AxesCondition& c, const ConditionEnds& at);

/// How the gradient (first body, second body) changes with translation and small global rotation of both, (12, 12).
Matrix12 curvature(const PointCondition& c, const ConditionEnds& at);
Matrix12 curvature(const AxesCondition& c, const ConditionEnds& at);

}  // namespace dynamics
