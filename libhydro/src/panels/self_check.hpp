#pragma once
/// \file  What theory and a finer mesh say of the result. (G14), (G15) in docs/theory/panels.md. Not installed.
#include <vector>

#include "one_frequency.hpp"

namespace hydro::panels {

/// Numbers measured as in (P11), with `arm` [m] a length of the hulls. `finer` belongs to the frequencies refined[…] of
/// `results`.
SelfCheck self_check(const std::vector<OneFrequency>& results, const std::vector<OneFrequency>& finer,
                     const std::vector<std::size_t>& refined, double arm);

}  // namespace hydro::panels
