#pragma once
/// \file  Where bodies come to rest without waves.
#include "dynamics/model/model.hpp"

namespace dynamics {

/// A state without velocities in which the loads of all kinds that are linear at rest (weight, buoyancy, moorings,
/// springs, constant loads) balance with the joints closed, found by damped Newton from `start` (D21). Motions that
/// nothing restores and nothing drives stay where they are. The balance holds to 1e-9 of the bodies' weights; it may be
/// an unstable one, which `froude modes` tells.
///
/// \throws hydro::InputError naming the mode that is driven on and on, or the worst equation
State equilibrium(const Model& model, State start);
/// The same before a run: with loads that end later as they act at the time of `start`.
State equilibrium_before_run(const Model& model, State start);

}  // namespace dynamics
