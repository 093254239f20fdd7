#pragma once
/// \file  What plans of experiments of several kinds share: made noise, and the search for a length that is enough.
///        (F99), docs/theory/fit.md.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace fit {

/// Noise whose autocorrelation is e^{−t/memory}; white where the memory is 0.
inline std::vector<double> noise_with_memory(std::size_t n, double deviation, double memory, double step,
                                             const hydro::RandomStream& random) {
  const double phi = memory > 0 ? std::exp(-step / memory) : 0, drive = std::sqrt(1 - phi * phi);
  std::vector<double> out(n);
  for (std::size_t i = 0; i < n; ++i)
    out[i] = i == 0 ? deviation * random.normal(0) : phi * out[i - 1] + drive * deviation * random.normal(i);
  return out;
}

inline void check_noise(double deviation, double memory) {
  hydro::require(deviation > 0 && std::isfinite(deviation),
                 "the noise of the force must be positive, got {} N: without it any record is long enough", deviation);
  hydro::require(memory >= 0 && std::isfinite(memory), "the memory of the noise must not be negative, got {} s",
                 memory);
}

inline double median_of_widths(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What lengths tell on the way to one that is enough, in their order; the last is, unless that would take more than
/// `most`. Doubles from `first` on, then goes between the last two, to a tenth. (F99)
template <class Tell, class Enough, class Length>
auto lengths_until(int first, int most, const Tell& tell, const Enough& enough, const Length& length) {
  std::vector<decltype(tell(first))> out;
  int too_short = first - 1;
  for (int n = first; n <= most; n = std::min(2 * n, std::max(most, n + 1))) {
    out.push_back(tell(n));
    if (enough(out.back())) break;
    too_short = n;
  }
  if (!enough(out.back())) return out;
  int least = length(out.back());
  while (least - too_short > std::max(1, least / 10)) {
    const int between = (least + too_short) / 2;
    out.push_back(tell(between));
    (enough(out.back()) ? least : too_short) = between;
  }
  std::sort(out.begin(), out.end(), [&](const auto& a, const auto& b) { return length(a) < length(b); });
  std::erase_if(out, [&](const auto& l) { return length(l) > least; });
  return out;
}

}  // namespace fit
