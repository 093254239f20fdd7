#include "dynamics/force/restoring.hpp"

#include <fmt/format.h>

#include "dynamics/spatial/rotation.hpp"

namespace dynamics {
namespace {

Vector6 displacement(const Pose& pose, const Eigen::Vector3d& rest_centre) {
  Vector6 d;
  d << pose.centre - rest_centre, rotation_log(pose.attitude);
  return d;
}

}  // namespace

Vector6 restoring_load(const Restoring& element, const Vector6& displacement, const Vector6& velocity) {
  Vector6 generalised = element.stiffness * displacement;
  generalised.tail<3>() -= element.moment;
  const Eigen::Vector3d phi = displacement.tail<3>(), m = generalised.tail<3>();
  generalised.tail<3>() = left_jacobian_inverse(phi).transpose() * m;
  return -generalised - element.damping * velocity;
}

RestoringKind::RestoringKind(std::string effect, const std::vector<RigidBody>& bodies, std::vector<Restoring> elements)
    : effect_(std::move(effect)), elements_(std::move(elements)) {
  for (const Restoring& e : elements_) rest_centre_.push_back(bodies[static_cast<std::size_t>(e.body)].rest_centre());
}

void RestoringKind::add_load(const Instant& now, LoadSink& out) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Restoring& e = elements_[i];
    const Pose& pose = now.state.pose[static_cast<std::size_t>(e.body)];
    Vector6 load = restoring_load(e, displacement(pose, rest_centre_[i]), now.state.twist(e.body));
    load.z() += e.lift;
    out.add(e.body, load);
  }
}

void RestoringKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Restoring& e = elements_[i];
    const Vector6 d = displacement(now.state.pose[static_cast<std::size_t>(e.body)], rest_centre_[i]);
    const Eigen::Vector3d phi = d.tail<3>(), m = (e.stiffness * d).tail<3>() - e.moment;
    Matrix6 G = Matrix6::Identity();
    G.bottomRightCorner<3, 3>() = left_jacobian_inverse(phi);
    Matrix6 K = -G.transpose() * e.stiffness * G;
    K.bottomRightCorner<3, 3>() -= left_jacobian_inverse_transpose_derivative(phi, m) * G.bottomRightCorner<3, 3>();
    out.add(e.body, e.body, K, -e.damping);
  }
}

std::string RestoringKind::breaks_off(const State& before, const State& after) const {
  for (const Restoring& e : elements_) {
    if (e.stiffness.rightCols<3>().isZero(0) && e.moment.isZero(0)) continue;
    const auto body = static_cast<std::size_t>(e.body);
    if (jumps(rotation_log(before.pose[body].attitude), rotation_log(after.pose[body].attitude)))
      return fmt::format("a body of \"{}\" has turned by more than half a turn from rest, where that law ends",
                         effect_);
  }
  return {};
}

EnergyFlow RestoringKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Restoring& e = elements_[i];
    const Vector6 d = displacement(now.state.pose[static_cast<std::size_t>(e.body)], rest_centre_[i]);
    const Vector6 v = now.state.twist(e.body);
    flow.stored += 0.5 * d.dot(e.stiffness * d) - e.lift * d.z() - e.moment.dot(d.tail<3>());
    flow.dissipated += v.dot(e.damping * v);
  }
  return flow;
}

}  // namespace dynamics
