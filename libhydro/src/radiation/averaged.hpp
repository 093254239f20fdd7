#pragma once
/// \file  Private: damping as a sum over steps sees it.
#include "hydro/radiation/kernel.hpp"

namespace hydro::radiation {

/// Places at which B sinc² bends less than this share of its largest value are left out: a tenth of what straight
/// pieces between the others are off.
constexpr double averaged_share = 1e-6;

/// B sinc²(ωh/2), whose cosine transform is the kernel's average over a step to either side (R24); with places added
/// where the given ones lie too far apart for the sine.
DampingTable averaged_over_steps(const DampingTable& damping, double step);

}  // namespace hydro::radiation
