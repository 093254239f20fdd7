#include "fit/box.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"

namespace fit {

double quantile_of(std::vector<double> values, double q) {
  hydro::require(!values.empty() && q >= 0 && q <= 1, "a quantile needs values and a share between 0 and 1, got {}", q);
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  if (below + 1 >= values.size()) return values.back();
  return values[below] + (at - static_cast<double>(below)) * (values[below + 1] - values[below]);
}

// Tukey's fences: 0.7 % of normal samples lie beyond them.
Box box_of(std::vector<double> samples) {
  constexpr double fence = 1.5;
  hydro::require(!samples.empty(), "a box needs samples");
  for (const double s : samples) hydro::require(std::isfinite(s), "a box needs finite samples, got {}", s);
  std::sort(samples.begin(), samples.end());
  Box out{};
  out.lower_quartile = quantile_of(samples, 0.25);
  out.median = quantile_of(samples, 0.5);
  out.upper_quartile = quantile_of(samples, 0.75);
  const double reach = fence * (out.upper_quartile - out.lower_quartile);
  const auto begin = std::lower_bound(samples.begin(), samples.end(), out.lower_quartile - reach),
             end = std::upper_bound(samples.begin(), samples.end(), out.upper_quartile + reach);
  out.low = *begin;
  out.high = *std::prev(end);
  out.outliers.assign(samples.begin(), begin);
  out.outliers.insert(out.outliers.end(), end, samples.end());
  return out;
}

}  // namespace fit
