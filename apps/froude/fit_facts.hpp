#pragma once
/// \file  What a fit tells programs, for commands that show fits without being `froude fit`.
#include "froude/report.hpp"

namespace fit {
struct Report;
}

namespace froude {

/// The tree that `froude fit --json` prints, without what was asked. `confidence`: of the intervals, 0 … 1.
Json facts_of_fit(const ::fit::Report& fit, double confidence);

}  // namespace froude
