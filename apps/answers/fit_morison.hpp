#pragma once
/// \file  What is shown of a fit of kind "morison". Private to apps.
#include <string>

#include "answers/fit_kind.hpp"
#include "fit/problem/morison.hpp"

namespace froude::scene {

/// Forces of one or two runs over time; of more, the coefficients of all over KC, with their law.
Panels morison_panels(const ::fit::morison::Solution& solution);
/// One row for each run; cells of what is not identifiable are empty.
std::string morison_table(const ::fit::morison::Solution& solution);

}  // namespace froude::scene
