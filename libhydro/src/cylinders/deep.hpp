#pragma once
/// \file  Infinitely deep water as water of a finite depth (C14). Not installed.
#include <vector>

#include "hydro/cylinders/layout.hpp"

namespace hydro::cylinders {

/// `water` itself if its depth is finite; else with a depth so large that A, B and X are within 1e-4.
/// \throws InputError if the frequency (rad/s; +∞ allowed) is so low that no such depth can be solved
Water effective_water(const std::vector<CylinderBody>& bodies, const Water& water, double omega);
/// The same of cylinders, or circles about hulls, `sizes` radii and draughts deep at least: the bed is felt by sizes⁻³.
Water effective_water(const std::vector<Cylinder>& cylinders, const Water& water, double omega, double sizes);

}  // namespace hydro::cylinders
