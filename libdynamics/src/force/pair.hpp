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

inline EndPoint end_point(const State& state, std::optional<int> body, const Eigen::Vector3d& arm_in_body) {
  if (!body)
    return {arm_in_body, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
            Eigen::Matrix3d::Identity()};
  const Pose& pose = state.pose[static_cast<std::size_t>(*body)];
  const Eigen::Matrix3d R = pose.attitude.toRotationMatrix();
  const Eigen::Vector3d arm = R * arm_in_body, omega = state.twist(*body).tail<3>();
  return {pose.centre + arm, state.twist(*body).head<3>() + omega.cross(arm), arm, omega, R};
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

inline void add_load(const Ends& ends, const PairLoad& p, LoadSink& out) {
  Vector6 load;
  load << p.force, p.moment + p.first_arm.cross(p.force);
  out.add(ends.first, load);
  if (!ends.second) return;
  load << -p.force, -p.moment - p.second_arm.cross(p.force);
  out.add(*ends.second, load);
}

inline void add_jacobian(const Ends& ends, const PairLoad& p, JacobianSink& out) {
  const Eigen::Matrix3d F = cross_matrix(p.force);
  Eigen::Matrix<double, 12, 12> by_q, by_v;
  by_q << p.force_by_q, p.moment_by_q - F * p.first_arm_by_q + cross_matrix(p.first_arm) * p.force_by_q, -p.force_by_q,
      -p.moment_by_q + F * p.second_arm_by_q - cross_matrix(p.second_arm) * p.force_by_q;
  by_v << p.force_by_v, p.moment_by_v + cross_matrix(p.first_arm) * p.force_by_v, -p.force_by_v,
      -p.moment_by_v - cross_matrix(p.second_arm) * p.force_by_v;
  const int count = ends.second ? 2 : 1;
  const int body[2] = {ends.first, ends.second.value_or(-1)};
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      out.add(body[i], body[j], by_q.block<6, 6>(6 * i, 6 * j), by_v.block<6, 6>(6 * i, 6 * j));
}

/// The variation of a number that changes by these rows with the displacements and velocities of (first, second).
inline Variation variation_of(const Ends& ends, const Eigen::Matrix<double, 1, 12>& by_q,
                              const Eigen::Matrix<double, 1, 12>& by_v) {
  Variation out{.parts = {{.body = ends.first, .by_motion = by_q.head<6>(), .by_velocity = by_v.head<6>()}}};
  if (ends.second)
    out.parts.push_back({.body = *ends.second, .by_motion = by_q.tail<6>(), .by_velocity = by_v.tail<6>()});
  return out;
}

/// Derivative of an arm fixed to the first (0) or second (1) body by displacement.
inline Matrix3x12 arm_derivative(int which, const Eigen::Vector3d& arm) {
  Matrix3x12 m = Matrix3x12::Zero();
  m.middleCols<3>(6 * which + 3) = -cross_matrix(arm);
  return m;
}

}  // namespace dynamics::detail
