#pragma once
/// \file  Checks of what spreading functions are asked. Not installed.
#include "hydro/base/types.hpp"

namespace hydro::waves {

void require_frequency(double omega);
/// θ for a share: between −π and π, or refused.
double angle_in_turn(Angle from_mean);
/// θ for a density: brought between −π and π.
double wrapped(Angle from_mean);

}  // namespace hydro::waves
