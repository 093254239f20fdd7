#pragma once
/// \file  How the fit of decays is told. Private to libfit.
#include "fit/problem/decay.hpp"

namespace fit::decay {

/// What is told of all runs, of those fitted together, and of each coefficient over runs fitted alone.
Report told(const Problem& problem, const std::vector<FittedRun>& runs, const std::optional<FittedRun>& together);

}  // namespace fit::decay
