#include "dynamics/force/force_kind.hpp"

namespace dynamics {

double power_of_changing_mass(const ForceKind& kind, const State& state) {
  constexpr double dt = 1e-5;  // s: far below any wave's period, far above round-off
  // Room, kept from call to call: kinds of force are shared between threads and have none.
  thread_local State there;
  thread_local Eigen::VectorXd way, momentum;
  const auto twice_energy = [&](double ahead) {
    way = ahead * state.velocity;
    move(state, way, there);
    there.time += ahead;
    momentum.setZero(state.velocity.size());
    MassSink sink(state.velocity, momentum);
    kind.add_mass(there, sink);
    return momentum.dot(state.velocity);
  };
  return (twice_energy(dt) - twice_energy(-dt)) / (4 * dt);
}

}  // namespace dynamics
