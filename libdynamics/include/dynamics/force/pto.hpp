#pragma once
/// \file  Power take-off and other work along the coordinate of a slider or hinge. (D52), (D53)
#include "dynamics/force/coordinate_force.hpp"
#include "dynamics/force/force_law.hpp"

namespace dynamics {

using Pto = OnCoordinate<PtoLaw>;

/// Coordinate, its rate, and the force against it, as the law counts them: m, m/s, N or rad, rad/s, N m.
struct PtoState {
  double coordinate, rate, force;
};
PtoState pto_state(const Pto& pto, const State& state);

class PtoKind final : public CoordinateForceKind<PtoLaw> {
 public:
  explicit PtoKind(std::vector<Pto> elements);
};

}  // namespace dynamics
