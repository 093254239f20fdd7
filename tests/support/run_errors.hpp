#pragma once
/// \file  How far the signals of a run are off those of a reference, and up to when the reference can tell.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "froude/result.hpp"

namespace support {

/// Of the first samples of a signal.
struct Spread {
  double rms = 0, deviation = 0, lowest = 0, highest = 0;
};
inline Spread spread(const std::vector<double>& values, std::size_t count) {
  if (count == 0) return {};
  const auto end = values.begin() + static_cast<std::ptrdiff_t>(count);
  double sum = 0, squares = 0;
  std::for_each(values.begin(), end, [&](double x) { sum += x; });
  const double n = static_cast<double>(count), mean = sum / n;
  std::for_each(values.begin(), end, [&](double x) { squares += (x - mean) * (x - mean); });
  const auto [low, high] = std::minmax_element(values.begin(), end);
  return {std::sqrt(squares / n + mean * mean), std::sqrt(squares / n), *low, *high};
}

/// What errors of a signal are relative to.
struct Size {
  double rms, deviation, extreme;
};
/// Of each signal, as accuracy is promised (theory/accuracy.md): its rms, its standard deviation and the farther of its
/// ends, but no less than a thousandth of the largest rms of its unit. Below 1e-9, in SI or of the largest load or
/// energy, stands what rounding leaves of what symmetry forbids.
inline std::vector<Size> sizes(const froude::Run& run) {
  constexpr double least = 1e-3, rounding = 1e-9;
  const auto is_load = [](const froude::Signal& s) { return s.units.find_first_of("NJW") != std::string::npos; };
  std::vector<Spread> spreads;
  std::map<std::string, double> largest;
  double largest_load = 0;
  for (const auto& signal : run.signals) {
    spreads.push_back(spread(signal.values, signal.values.size()));
    largest[signal.units] = std::max(largest[signal.units], spreads.back().rms);
    if (is_load(signal)) largest_load = std::max(largest_load, spreads.back().rms);
  }
  std::vector<Size> out;
  for (std::size_t i = 0; i < spreads.size(); ++i) {
    const auto& signal = run.signals[i];
    const double floor = std::max(least * largest[signal.units], rounding * (is_load(signal) ? largest_load : 1.0));
    const Spread& s = spreads[i];
    out.push_back({std::max(s.rms, floor), std::max(s.deviation, floor),
                   std::max({std::abs(s.lowest), std::abs(s.highest), floor})});
  }
  return out;
}

/// The largest of what accuracy bounds, of the first `count` samples: rms of what both differ by, and differences of
/// their standard deviations and of their ends.
inline double relative_error(const std::vector<double>& a, const std::vector<double>& b, const Size& size,
                             std::size_t count) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += std::pow(a[i] - b[i], 2);
  if (sum == 0) return 0;
  const Spread x = spread(a, count), y = spread(b, count);
  return std::max({std::sqrt(sum / static_cast<double>(count)) / size.rms,
                   std::abs(x.deviation - y.deviation) / size.deviation, std::abs(x.lowest - y.lowest) / size.extreme,
                   std::abs(x.highest - y.highest) / size.extreme});
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
