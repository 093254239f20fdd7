#pragma once
/// \file  Towing from what was recorded. Private to libfit.
#include "fit/problem/towing.hpp"

namespace fit::towing {

/// solve() of a problem with records.
Solution solve_records(const Problem& problem);

}  // namespace fit::towing
