#pragma once
/// \file  What theory promises about the solution, measured. Not installed.
#include <vector>

#include "hydro/cylinders/solve.hpp"
#include "model.hpp"

namespace hydro::cylinders {

/// `finer[i]` is the frequency `doubled[i]` of `results` with doubled resolution.
SelfCheck self_check(const std::vector<OneFrequency>& results, const std::vector<OneFrequency>& finer,
                     const std::vector<std::size_t>& doubled);

}  // namespace hydro::cylinders
