#pragma once
/// \file  What `froude bem info` says of files of motions, mean drift and quadratic loads.
#include "froude/commands.hpp"
#include "froude/report.hpp"
#include "hydro/potential/formats/responses.hpp"

namespace froude {

/// Frequencies, headings and the largest value of each mode. \throws InputError as the readers do
Report response_report(const Path& file, const hydro::potential::ReadOptions& options);

}  // namespace froude
