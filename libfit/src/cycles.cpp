#include "fit/cycles.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cubic.hpp"
#include "hydro/base/error.hpp"

namespace fit {
namespace {

double median_of(std::vector<double> v) {
  const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
  std::nth_element(v.begin(), middle, v.end());
  return *middle;
}

}  // namespace

std::vector<Cycle> find_cycles(std::span<const double> motion) {  // (F23)
  hydro::require(motion.size() >= 16, "cycles need at least 16 samples, got {}", motion.size());
  const auto [low, high] = std::minmax_element(motion.begin(), motion.end());
  hydro::require(*high > *low, "the motion is constant: there are no cycles");
  const double mean = std::accumulate(motion.begin(), motion.end(), 0.0) / static_cast<double>(motion.size());
  const double enough = 0.1 * (*high - *low) / 2;
  std::vector<Cycle> cycles;
  double start = -1, crossing = -1, top = -1e300, bottom = 1e300;
  bool was_low = false;  // below −10 % since the last crossing that counted
  for (std::size_t j = 1; j < motion.size(); ++j) {
    const double before = motion[j - 1] - mean, now = motion[j] - mean;
    top = std::max(top, now);
    bottom = std::min(bottom, now);
    if (now < -enough) was_low = true;
    if (before < 0 && now >= 0 && was_low) crossing = static_cast<double>(j) - now / (now - before);
    if (!(was_low && crossing >= 0 && now > enough)) continue;  // the last crossing before the motion is well up
    if (start >= 0) cycles.push_back({start, crossing, (top - bottom) / 2});
    start = crossing;
    crossing = -1;
    was_low = false;
    top = now;
    bottom = 1e300;
  }
  return cycles;
}

std::vector<Cycle> full_amplitude(std::span<const Cycle> cycles, double tolerance) {  // (F23)
  hydro::require(tolerance > 0 && tolerance < 1, "the tolerance of a full amplitude lies between 0 and 1, got {}",
                 tolerance);
  hydro::require(!cycles.empty(), "the record holds no whole cycle");
  std::vector<double> amplitude, length;
  for (const Cycle& c : cycles) amplitude.push_back(c.amplitude);
  std::sort(amplitude.begin(), amplitude.end());
  const double full =
      median_of({amplitude.begin() + static_cast<std::ptrdiff_t>(amplitude.size() / 2), amplitude.end()});
  for (const Cycle& c : cycles)
    if (std::abs(c.amplitude - full) <= tolerance * full) length.push_back(c.end - c.start);
  const double usual = median_of(length);
  std::size_t best_from = 0, best = 0, from = 0;
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    const bool is_full = std::abs(cycles[i].amplitude - full) <= tolerance * full &&
                         std::abs(cycles[i].end - cycles[i].start - usual) <= tolerance * usual;
    if (!is_full) from = i + 1;
    if (i + 1 - from > best) {
      best = i + 1 - from;
      best_from = from;
    }
  }
  hydro::require(best > 0, "no cycle has the full amplitude within {:.3g} %", 100 * tolerance);
  return {cycles.begin() + static_cast<std::ptrdiff_t>(best_from),
          cycles.begin() + static_cast<std::ptrdiff_t>(best_from + best)};
}

std::vector<double> on_phases(std::span<const double> values, std::span<const Cycle> cycles,
                              std::size_t points) {  // (F47)
  hydro::require(values.size() >= 4 && !cycles.empty() && points >= 8,
                 "{} samples, {} cycles and {} points of a cycle: at least 4, 1 and 8 are needed", values.size(),
                 cycles.size(), points);
  hydro::require(cycles.front().start >= 0 && cycles.back().end <= static_cast<double>(values.size() - 1),
                 "the cycles reach beyond the record");
  std::vector<double> out;
  for (const Cycle& c : cycles)
    for (std::size_t k = 0; k < points; ++k) {
      const double at = c.start + (c.end - c.start) * static_cast<double>(k) / static_cast<double>(points);
      const auto first = std::min(static_cast<std::size_t>(std::max(0.0, std::floor(at) - 1)), values.size() - 4);
      out.push_back(cubic_between(values.data() + first + 1, at - static_cast<double>(first) - 1));
    }
  return out;
}

CycleMean mean_cycle(std::span<const double> laid, std::size_t points) {  // (F47)
  hydro::require(points >= 1 && laid.size() % points == 0 && laid.size() >= 2 * points,
                 "{} values are not two whole cycles of {} points or more", laid.size(), points);
  const std::size_t cycles = laid.size() / points;
  const auto n = static_cast<double>(cycles), p = static_cast<double>(points);
  CycleMean out{std::vector<double>(points, 0.0), std::vector<double>(points, 0.0), 0};
  for (std::size_t j = 0; j < laid.size(); ++j) out.mean[j % points] += laid[j] / n;
  for (std::size_t j = 0; j < laid.size(); ++j)
    out.standard_error[j % points] += std::pow(laid[j] - out.mean[j % points], 2);
  const double level = std::accumulate(out.mean.begin(), out.mean.end(), 0.0) / p;
  double off = 0, swing = 0;
  for (std::size_t k = 0; k < points; ++k) {
    off += out.standard_error[k] / (n * p);
    swing += std::pow(out.mean[k] - level, 2) / p;
    out.standard_error[k] = std::sqrt(out.standard_error[k] / ((n - 1) * n));
  }
  hydro::require(swing > 0, "the mean cycle is constant: nothing repeats");
  out.left = std::sqrt(off / swing);
  return out;
}

}  // namespace fit
