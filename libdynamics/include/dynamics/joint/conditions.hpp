#pragma once
/// \file  One condition of a joint or contact: its value, gradient and curvature (D13)-(D15), (D23). For JointSet and
/// for
///        tests.
#include "dynamics/joint/joint.hpp"

namespace dynamics {

using Matrix12 = Eigen::Matrix<double, 12, 12>;

/// Where the two bodies of a condition are.
struct ConditionEnds {
  Eigen::Vector3d first_centre, second_centre;  ///< global
  Eigen::Matrix3d first, second;                ///< attitudes; identity for the ground
  double time;                                  ///< s
};
ConditionEnds ends_of(const Condition& condition, const State& state);

/// The joint's frame at rest, columns x (the axis), y, z. \throws hydro::InputError for an axis without direction
Eigen::Matrix3d frame_of(const Joint& joint);

double value(const PointCondition& c, const ConditionEnds& at);
double value(const AxesCondition& c, const ConditionEnds& at);
double value(const GapCondition& c, const ConditionEnds& at);
double value(const StickCondition& c, const ConditionEnds& at);  ///< none: 0
double value(const LeadCondition& c, const ConditionEnds& at);   ///< of a hinge: within half a turn

Gradient gradient(const PointCondition& c, const ConditionEnds& at);
Gradient gradient(const AxesCondition& c, const ConditionEnds& at);
Gradient gradient(const GapCondition& c, const ConditionEnds& at);
Gradient gradient(const StickCondition& c, const ConditionEnds& at);
Gradient gradient(const LeadCondition& c, const ConditionEnds& at);

/// How the gradient (first body, second body) changes with translation and small global rotation of both, (12, 12).
Matrix12 curvature(const PointCondition& c, const ConditionEnds& at);
Matrix12 curvature(const AxesCondition& c, const ConditionEnds& at);
Matrix12 curvature(const GapCondition& c, const ConditionEnds& at);    ///< by differences, to 1e-8 relative
Matrix12 curvature(const StickCondition& c, const ConditionEnds& at);  ///< the same
Matrix12 curvature(const LeadCondition& c, const ConditionEnds& at);

/// The shapes of a gap where their bodies are, and the shortest way between them.
Meeting meeting(const GapCondition& c, const ConditionEnds& at);
/// How two points move apart along n: the gradient of n·(second − first) with n held, for points of either body.
Gradient apart(const Eigen::Vector3d& n, const Eigen::Vector3d& on_first, const Eigen::Vector3d& on_second,
               const ConditionEnds& at);

}  // namespace dynamics
