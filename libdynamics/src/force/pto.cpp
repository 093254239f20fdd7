#include "dynamics/force/pto.hpp"

namespace dynamics {

PtoKind::PtoKind(std::vector<Pto> elements)
    : CoordinateForceKind(std::move(elements),
                          {.effect = "pto",
                           .method = "spring, damper, limit and end stops on the coordinate of a joint",
                           .thing = "the power take-off"}) {}

PtoState pto_state(const Pto& pto, const State& state) {
  const detail::CoordinateMotion m = detail::motion_of(pto.coordinate, state, pto.sign);
  return {m.x, m.rate, pto.law.at(m.x, m.rate).force};
}

}  // namespace dynamics
