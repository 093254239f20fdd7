#pragma once
/// \file  The cylinder that stands on the sea bed, in closed form (C9). Not installed.
#include "hydro/cylinders/vertical_modes.hpp"
#include "scatterer.hpp"

namespace hydro::cylinders {

/// Evanescent modes that bottom_mounted() needs at K = ω²/g.
int bottom_mounted_terms(double radius, double depth, double K);

/// Azimuthal orders 0 … orders − 1, `channels` vertical modes with the wave. Heave does not move water: zeros.
Scatterer bottom_mounted(double radius, const VerticalModes& modes, int orders, int channels);

}  // namespace hydro::cylinders
