#pragma once
/// \file  How far the signals of a run are off those of a reference, and up to when the reference can tell.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "froude/result.hpp"

namespace support {

/// What errors of signals are relative to, as accuracy is promised (theory/accuracy.md): each one's rms, but no less
/// than a thousandth of the largest of its unit. Below 1e-9, in SI or of the largest load or energy, stands what
/// rounding leaves of what symmetry forbids.
inline std::vector<double> sizes(const froude::Run& run) {
  constexpr double least = 1e-3, rounding = 1e-9;
  const auto is_load = [](const froude::Signal& s) { return s.units.find_first_of("NJW") != std::string::npos; };
  std::vector<double> out;
  std::map<std::string, double> largest;
  double largest_load = 0;
  for (const auto& signal : run.signals) {
    double sum = 0;
    for (const double x : signal.values) sum += x * x;
    out.push_back(std::sqrt(sum / static_cast<double>(signal.values.size())));
    largest[signal.units] = std::max(largest[signal.units], out.back());
    if (is_load(signal)) largest_load = std::max(largest_load, out.back());
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto& signal = run.signals[i];
    out[i] = std::max({out[i], least * largest[signal.units], rounding * (is_load(signal) ? largest_load : 1.0)});
  }
  return out;
}

/// Root mean square difference of the first `count` samples, over `size`.
inline double relative_error(const std::vector<double>& a, const std::vector<double>& b, double size,
                             std::size_t count) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += std::pow(a[i] - b[i], 2);
  return sum == 0 ? 0 : std::sqrt(sum / static_cast<double>(count)) / size;
}

/// Up to which sample, counted from the first, the two differ by no more than `limit` of `size`, rms.
inline std::size_t agreed(const std::vector<double>& a, const std::vector<double>& b, double size, double limit) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    sum += std::pow(a[i] - b[i], 2);
    if (sum <= std::pow(limit * size, 2) * static_cast<double>(i + 1)) count = i + 1;
  }
  return count;
}

}  // namespace support
