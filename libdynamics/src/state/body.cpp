#include "dynamics/state/body.hpp"

#include <cmath>

#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

RigidBody::RigidBody(Properties properties) : p_(std::move(properties)) {
  hydro::require(std::isfinite(p_.mass) && p_.mass > 0, "body \"{}\": the mass must be positive, got {} kg", p_.name,
                 p_.mass);
  hydro::require(p_.inertia.allFinite() && p_.inertia.isApprox(p_.inertia.transpose(), 1e-12),
                 "body \"{}\": the inertia must be a symmetric matrix of finite numbers", p_.name);
  Eigen::Matrix3d turning = p_.inertia;
  for (int i = 0; i < 3; ++i)
    if (!is_free(3 + i)) {
      turning.row(i).setZero();
      turning.col(i).setZero();
      turning(i, i) = 1;
    }
  const Eigen::Vector3d principal = hydro::dense::symmetric_eigenvalues(turning);
  hydro::require(principal.minCoeff() > 0,
                 "body \"{}\": the inertia is not positive definite, principal moments {:.6g}, {:.6g}, {:.6g} kg m²",
                 p_.name, principal[0], principal[1], principal[2]);
}

Vector6 Pose::displacement(const Eigen::Vector3d& rest_centre) const {
  Vector6 d;
  d << centre - rest_centre, rotation_log(attitude);
  return d;
}

Eigen::Vector3d Pose::roll_pitch_yaw() const { return dynamics::roll_pitch_yaw(attitude, counted); }

Vec3<World> Pose::point(const RigidBody& body, const Vec3<BodyAxes>& from_origin) const {
  const Rotation<World, BodyAxes> R{attitude.toRotationMatrix()};
  return Vec3<World>{centre} + R * (from_origin - body.properties().centre_of_gravity);
}

void move(const State& from, const Eigen::VectorXd& displacement, State& to) {
  to = from;
  for (std::size_t i = 0; i < to.pose.size(); ++i) {
    const auto row = 6 * static_cast<Eigen::Index>(i);
    Pose& pose = to.pose[i];
    pose.centre += displacement.segment<3>(row);
    pose.attitude = (rotation_exp(displacement.segment<3>(row + 3)) * pose.attitude).normalized();
  }
}

State moved(const State& state, const Eigen::VectorXd& displacement) {
  State out;
  move(state, displacement, out);
  return out;
}

State rest_state(const std::vector<RigidBody>& bodies) {
  State state;
  for (const RigidBody& body : bodies) state.pose.push_back({.centre = body.rest_centre()});
  state.velocity = Eigen::VectorXd::Zero(6 * static_cast<Eigen::Index>(bodies.size()));
  return state;
}

Matrix6 shift_from_centre(const Eigen::Vector3d& offset) {
  Matrix6 T = Matrix6::Identity();
  T.topRightCorner<3, 3>() = -cross_matrix(offset);
  return T;
}

}  // namespace dynamics
