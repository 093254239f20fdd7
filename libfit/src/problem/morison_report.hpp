#pragma once
/// \file  How the fit of Morison's equation is told. Private to libfit.
#include "fit/problem/morison.hpp"

namespace fit::morison {

Report told(const Options& options, const std::vector<FittedRun>& runs, const std::vector<CoefficientLaw>& laws);

}  // namespace fit::morison
