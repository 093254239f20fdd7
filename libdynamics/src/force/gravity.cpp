#include "dynamics/force/gravity.hpp"

namespace dynamics {

GravityKind::GravityKind(const std::vector<RigidBody>& bodies, double gravity) {
  for (const RigidBody& body : bodies) weight_.push_back(body.mass() * gravity);
}

void GravityKind::add_load(const Instant&, LoadSink& out) const {
  for (std::size_t i = 0; i < weight_.size(); ++i) out.add_mode(6 * static_cast<int>(i) + 2, -weight_[i]);
}

EnergyFlow GravityKind::energy(const Instant& now) const {
  EnergyFlow out;
  for (std::size_t i = 0; i < weight_.size(); ++i) out.stored += weight_[i] * now.state.pose[i].centre.z();
  return out;
}

}  // namespace dynamics
