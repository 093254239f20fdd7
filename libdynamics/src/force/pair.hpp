#pragma once
/// \file  Private: kinematics of two points on two bodies, and how a force between them loads both and varies. (D5)
#include <Eigen/Core>

#include "dynamics/force/connector.hpp"
#include "dynamics/spatial/rotation.hpp"

namespace dynamics::detail {

/// Rows by the twelve displacements or velocities of (first, second): x₁, θ₁, x₂, θ₂.
using Matrix3x12 = Eigen::Matrix<double, 3, 12>;

/// Where an end is and how it moves, global axes. `arm` points from the centre of gravity to the end.
struct EndPoint {
  Eigen::Vector3d position, velocity, arm, omega;
  Eigen::Matrix3d rotation;
};

inline EndPoint end_point(const PointOnBody& end, const State& state) {
  const Frame frame = frame_of(end.body, state);
  const Eigen::Vector3d arm = frame.axes * end.arm, omega = state.twist(end.body).tail<3>();
  return {frame.origin + arm, state.twist(end.body).head<3>() + omega.cross(arm), arm, omega, frame.axes};
}

/// Of the ground, which has no arm: nothing is asked about its moment.
inline EndPoint end_point(const PointOnGround& end, const State&) {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  return {end.place, none, none, none, Eigen::Matrix3d::Identity()};
}

inline EndPoint end_point(const Point& end, const State& state) {
  return std::visit([&](const auto& e) { return end_point(e, state); }, end);
}

/// Derivative of the second end's position minus the first's, by displacement (and of its velocity, by velocity).
inline Matrix3x12 relative_position_derivative(const EndPoint& a, const EndPoint& b) {
  Matrix3x12 m;
  m << -Eigen::Matrix3d::Identity(), cross_matrix(a.arm), Eigen::Matrix3d::Identity(), -cross_matrix(b.arm);
  return m;
}

/// Derivative of the relative velocity by displacement: the arms turn while the bodies do.
inline Matrix3x12 relative_velocity_derivative(const EndPoint& a, const EndPoint& b) {
  Matrix3x12 m = Matrix3x12::Zero();
  m.middleCols<3>(3) = cross_matrix(a.omega) * cross_matrix(a.arm);
  m.middleCols<3>(9) = -cross_matrix(b.omega) * cross_matrix(b.arm);
  return m;
}

/// A force on the first body through `first_arm` and its opposite on the second through `second_arm`, plus a moment on
/// the first and its opposite on the second; with derivatives where a Jacobian is wanted.
struct PairLoad {
  Eigen::Vector3d force, first_arm, second_arm;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  Matrix3x12 force_by_q = Matrix3x12::Zero(), force_by_v = Matrix3x12::Zero();
  Matrix3x12 moment_by_q = Matrix3x12::Zero(), moment_by_v = Matrix3x12::Zero();
  Matrix3x12 first_arm_by_q = Matrix3x12::Zero(), second_arm_by_q = Matrix3x12::Zero();
};

inline void couple(const Ends& ends, BlockPattern& pattern) {
  if (const auto second = body_of(ends.second)) pattern.couple(ends.first.body, *second);
}

inline void add_load(const Ends& ends, const PairLoad& p, LoadSink& out) {
  Vector6 load;
  load << p.force, p.moment + p.first_arm.cross(p.force);
  out.add(ends.first.body, load);
  const auto* second = std::get_if<PointOnBody>(&ends.second);
  if (second == nullptr) return;
  load << -p.force, -p.moment - p.second_arm.cross(p.force);
  out.add(second->body, load);
}

inline void add_jacobian(const Ends& ends, const PairLoad& p, JacobianSink& out) {
  const Eigen::Matrix3d F = cross_matrix(p.force);
  Matrix12 by_q, by_v;
  by_q << p.force_by_q, p.moment_by_q - F * p.first_arm_by_q + cross_matrix(p.first_arm) * p.force_by_q, -p.force_by_q,
      -p.moment_by_q + F * p.second_arm_by_q - cross_matrix(p.second_arm) * p.force_by_q;
  by_v << p.force_by_v, p.moment_by_v + cross_matrix(p.first_arm) * p.force_by_v, -p.force_by_v,
      -p.moment_by_v - cross_matrix(p.second_arm) * p.force_by_v;
  out.add_pair(ends.first.body, body_of(ends.second), by_q, by_v);
}

inline Variation variation_of(const Ends& ends, const RowOfTwo& by_q, const RowOfTwo& by_v = RowOfTwo::Zero()) {
  return variation_of_two(ends.first.body, body_of(ends.second), by_q, by_v);
}

/// Derivative of an arm fixed to the first (0) or second (1) body by displacement.
inline Matrix3x12 arm_derivative(int which, const Eigen::Vector3d& arm) {
  Matrix3x12 m = Matrix3x12::Zero();
  m.middleCols<3>(6 * which + 3) = -cross_matrix(arm);
  return m;
}

}  // namespace dynamics::detail
