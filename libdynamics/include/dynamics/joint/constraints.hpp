#pragma once
/// \file  One constraint of a joint or contact: its value, gradient and curvature (D13)-(D15), (D23). For JointSet and
///        for tests.
#include "dynamics/joint/joint.hpp"

namespace dynamics {

/// Where the frames are that a constraint has its numbers in.
struct ConstraintEnds {
  Frame first, second;
  double time;  ///< s
};
ConstraintEnds ends_of(const Constraint& constraint, const State& state);

/// The joint's frame at rest, columns x (the axis), y, z. \throws hydro::InputError for an axis without direction
Eigen::Matrix3d frame_of(const Joint& joint);

double value(const PointConstraint& c, const ConstraintEnds& at);
double value(const AxesConstraint& c, const ConstraintEnds& at);
double value(const GapConstraint& c, const ConstraintEnds& at);
double value(const StickConstraint& c, const ConstraintEnds& at);       ///< none: 0
double value(const PrescribedConstraint& c, const ConstraintEnds& at);  ///< of a hinge: within half a turn

Gradient gradient(const PointConstraint& c, const ConstraintEnds& at);
Gradient gradient(const AxesConstraint& c, const ConstraintEnds& at);
Gradient gradient(const GapConstraint& c, const ConstraintEnds& at);
Gradient gradient(const StickConstraint& c, const ConstraintEnds& at);
Gradient gradient(const PrescribedConstraint& c, const ConstraintEnds& at);

/// How the gradient (first body, second body) changes with translation and small global rotation of both, (12, 12).
Matrix12 curvature(const PointConstraint& c, const ConstraintEnds& at);
Matrix12 curvature(const AxesConstraint& c, const ConstraintEnds& at);
Matrix12 curvature(const GapConstraint& c, const ConstraintEnds& at);    ///< by differences, to 1e-8 relative
Matrix12 curvature(const StickConstraint& c, const ConstraintEnds& at);  ///< the same
Matrix12 curvature(const PrescribedConstraint& c, const ConstraintEnds& at);

/// vᵀ curvature v, v the twists of both bodies: the second rate of the value while these keep theirs (D16).
double convective(const PointConstraint& c, const ConstraintEnds& at, const Vector12& v);
double convective(const AxesConstraint& c, const ConstraintEnds& at, const Vector12& v);
template <class AnyConstraint>
double convective(const AnyConstraint& c, const ConstraintEnds& at, const Vector12& v) {
  return v.dot(curvature(c, at) * v);
}

/// The shapes of a gap where their bodies are, and the shortest way between them.
ClosestPoints closest_points(const GapConstraint& c, const ConstraintEnds& at);
/// How two points move apart along n: the gradient of n·(second − first) with n held, for points of either body.
Gradient apart(const Eigen::Vector3d& n, const Eigen::Vector3d& on_first, const Eigen::Vector3d& on_second,
               const ConstraintEnds& at);

}  // namespace dynamics
