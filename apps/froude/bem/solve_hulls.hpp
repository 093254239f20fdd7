#pragma once
/// \file  What is told of hulls that were solved.
#include "froude/coefficient_files.hpp"
#include "froude/commands.hpp"
#include "hydro/panels/solve.hpp"

namespace froude {

/// Writes the coefficients, and tells the files with the self-check and the panels.
void write_hulls(const hydro::panels::Solution& solution, CoefficientFormat format, const Path& output,
                 const Console& console);

}  // namespace froude
