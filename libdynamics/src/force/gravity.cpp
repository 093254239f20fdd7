#include "dynamics/force/gravity.hpp"

#include <numeric>

namespace dynamics {
namespace {

std::vector<int> all_of(const std::vector<RigidBody>& bodies) {
  std::vector<int> all(bodies.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

GravityKind::GravityKind(const std::vector<RigidBody>& bodies, double gravity, const std::vector<int>& with_gravity) {
  for (const int b : with_gravity) {
    const RigidBody& body = bodies[static_cast<std::size_t>(b)];
    elements_.push_back({b, body.mass() * gravity, body.rest_centre().z()});
  }
}

GravityKind::GravityKind(const std::vector<RigidBody>& bodies, double gravity)
    : GravityKind(bodies, gravity, all_of(bodies)) {}

void GravityKind::add_load(const Instant&, LoadSink& out) const {
  for (const Element& e : elements_) out.add_mode(6 * e.body + 2, -e.weight);
}

EnergyFlow GravityKind::energy(const Instant& now) const {
  EnergyFlow out;
  for (const Element& e : elements_)
    out.stored += e.weight * (now.state.pose[static_cast<std::size_t>(e.body)].centre.z() - e.rest_height);
  return out;
}

}  // namespace dynamics
