#pragma once
/// \file  Private to sweep: fields of its CSV files.
#include <string>

#include "sweep/cases.hpp"

namespace froude::sweep {

/// In quotes where it needs them; a number with all its digits.
std::string csv_field(const std::string& text);
std::string csv_field(const Cell& cell);
/// "period [s]"
std::string csv_header(const Column& column);

}  // namespace froude::sweep
