#pragma once
/// \file  `froude validate`: which cases are run, where their files are, and how the result is told.
#include <vector>

#include "froude/validate_arguments.hpp"
#include "harness/case.hpp"

namespace froude::validation {

/// Returns 0 if every one of `cases` that is wanted and could run is within its limits, else 1.
int validate(const std::vector<Case>& cases, const ValidateArguments& arguments, const Console& console);

/// Tells name and question of each case that is wanted, and which reference data it needs that are absent; runs
/// nothing. \throws hydro::InputError if a README.md is missing or asks no question
void list(const std::vector<Case>& cases, const ValidateArguments& arguments, const Console& console);

}  // namespace froude::validation
