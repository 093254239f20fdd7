#include "dynamics/force/force_kind.hpp"

namespace dynamics {

double power_of_changing_mass(const ForceKind& kind, const State& state) {
  constexpr double dt = 1e-5;  // s: far below any wave's period, far above round-off
  const auto twice_energy = [&](double ahead) {
    State there = moved(state, ahead * state.velocity);
    there.time += ahead;
    Eigen::VectorXd momentum = Eigen::VectorXd::Zero(state.velocity.size());
    MassSink sink(state.velocity, momentum);
    kind.add_mass(there, sink);
    return momentum.dot(state.velocity);
  };
  return (twice_energy(dt) - twice_energy(-dt)) / (4 * dt);
}

}  // namespace dynamics
