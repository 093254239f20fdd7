#pragma once
/// \file  The least of a function of one number. Private to libfit.
#include <cmath>

namespace fit {

/// Where `f`, which has one minimum between `low` and `high`, is least, to within half of `width`.
template <class F>
double least_by_golden_section(F f, double low, double high, double width) {
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double a = high - golden * (high - low), b = low + golden * (high - low), at_a = f(a), at_b = f(b);
  while (high - low > width) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      at_a = f(a = high - golden * (high - low));
    } else {
      low = a, a = b, at_a = at_b;
      at_b = f(b = low + golden * (high - low));
    }
  }
  return (low + high) / 2;
}

}  // namespace fit
