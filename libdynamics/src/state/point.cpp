#include "dynamics/state/point.hpp"

#include "dynamics/spatial/rotation.hpp"

namespace dynamics {

using Eigen::Vector3d;

std::optional<int> body_of(const Point& point) {
  const auto* on_body = std::get_if<PointOnBody>(&point);
  return on_body != nullptr ? std::optional(on_body->body) : std::nullopt;
}

Vector3d arm_of(const PointOnBody& point, const State& state) {
  return state.pose[static_cast<std::size_t>(point.body)].attitude * point.arm;
}

Vector3d place_of(const PointOnBody& point, const State& state) {
  return state.pose[static_cast<std::size_t>(point.body)].centre + arm_of(point, state);
}

Vector3d velocity_of(const PointOnBody& point, const State& state) {
  const Vector6 twist = state.twist(point.body);
  return twist.head<3>() + twist.tail<3>().cross(arm_of(point, state));
}

Vector3d acceleration_of(const PointOnBody& point, const State& state, const Eigen::VectorXd& acceleration) {
  const Vector3d arm = arm_of(point, state), omega = state.twist(point.body).tail<3>();
  const Vector6 a = acceleration.segment<6>(6 * point.body);
  return a.head<3>() + a.tail<3>().cross(arm) + omega.cross(omega.cross(arm));
}

Eigen::Matrix<double, 3, 6> place_by_displacement(const Vector3d& arm) {
  Eigen::Matrix<double, 3, 6> out;
  out << Eigen::Matrix3d::Identity(), -cross_matrix(arm);
  return out;
}

Frame frame_of(const std::optional<int>& body, const State& state) {
  if (!body) return {};
  const Pose& pose = state.pose[static_cast<std::size_t>(*body)];
  return {pose.centre, pose.attitude.toRotationMatrix()};
}

}  // namespace dynamics
