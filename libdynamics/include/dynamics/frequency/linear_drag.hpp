#pragma once
/// \file  Drag in a response of one frequency: linear, losing as much energy as quadratic drag. (Q5)
#include <Eigen/Core>

#include <vector>

#include "dynamics/force/drag.hpp"
#include "dynamics/frequency/rao.hpp"

namespace dynamics::frequency {

/// β = mean |w|³ / mean |w|² over a period of w = Re(ŵ e^{iωt}), m/s: drag F = c β w loses per period what c |w| w
/// loses. 8/(3π) |ŵ| along a line, the constant speed on a circle; 0 for ŵ = 0. Error: below 1e-5. (Q5)
double energy_equivalent_speed(const Eigen::Vector3cd& w);

/// Waves of given height: each frequency by itself.
struct DragWaves {
  hydro::Water water;
  double heading = 0;             ///< rad
  std::vector<double> amplitude;  ///< of each frequency, m, positive
};

/// (Q5): loads of pieces, linear in motions and waves: turned with their bodies where these are still, in the water
/// that is where they are as placed, as DragKind has it. `pieces` without current.
/// \throws hydro::NumericsError naming the frequency where no coefficient settles, or no response exists
LinearDrag linearised_drag(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                           const std::vector<double>& omega, const std::vector<DragPiece>& pieces,
                           const DragWaves& waves);

}  // namespace dynamics::frequency
