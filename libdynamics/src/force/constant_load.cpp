#include "dynamics/force/constant_load.hpp"

#include "dynamics/spatial/rotation.hpp"

namespace dynamics {
namespace {

Eigen::Vector3d arm_now(const ConstantLoad& e, const State& state) {
  return state.pose[static_cast<std::size_t>(e.body)].attitude * e.arm;
}

Vector6 load_of(const ConstantLoad& e, const State& state) {
  Vector6 load;
  load << e.force, e.moment + arm_now(e, state).cross(e.force);
  return load;
}

}  // namespace

void ConstantLoadKind::add_load(const Instant& now, LoadSink& out) const {
  for (const ConstantLoad& e : elements_) out.add(e.body, load_of(e, now.state));
}

void ConstantLoadKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for (const ConstantLoad& e : elements_) {
    Matrix6 by_q = Matrix6::Zero();
    by_q.bottomRightCorner<3, 3>() = cross_matrix(e.force) * cross_matrix(arm_now(e, now.state));
    out.add(e.body, e.body, by_q, Matrix6::Zero());
  }
}

EnergyFlow ConstantLoadKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (const ConstantLoad& e : elements_) flow.supplied += load_of(e, now.state).dot(now.state.twist(e.body));
  return flow;
}

}  // namespace dynamics
