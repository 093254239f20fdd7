#include "fit/calibration.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"

namespace fit {
namespace {

void check(std::span<const LoadCycle> cycles) {
  for (std::size_t c = 0; c < cycles.size(); ++c) {
    hydro::require(cycles[c].force.size() == cycles[c].voltage.size(), "cycle {} has {} forces but {} voltages", c + 1,
                   cycles[c].force.size(), cycles[c].voltage.size());
    for (std::size_t i = 0; i < cycles[c].force.size(); ++i)
      hydro::require(std::isfinite(cycles[c].force[i]) && std::isfinite(cycles[c].voltage[i]),
                     "step {} of cycle {} is not finite", i + 1, c + 1);
  }
}

struct Hysteresis {
  double largest = 0;  // V
  std::size_t pairs = 0;
};

// (F15)
void add_cycle(const LoadCycle& cycle, std::size_t number, Hysteresis& h) {
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto top = std::max_element(cycle.force.begin(), cycle.force.end(), smaller);
  hydro::require(
      std::is_sorted(cycle.force.begin(), top, smaller) &&
          std::is_sorted(std::make_reverse_iterator(cycle.force.end()), std::make_reverse_iterator(top), smaller),
      "the loads of cycle {} do not go up and then down", number);
  const auto peak = static_cast<std::size_t>(top - cycle.force.begin());
  for (std::size_t up = 0; up < peak; ++up)
    for (std::size_t down = peak + 1; down < cycle.force.size(); ++down) {
      if (std::abs(cycle.force[up] - cycle.force[down]) > 1e-6 * std::abs(*top)) continue;
      h.largest = std::max(h.largest, std::abs(cycle.voltage[up] - cycle.voltage[down]));
      ++h.pairs;
    }
}

}  // namespace

Calibration calibrate(std::span<const LoadCycle> cycles, double confidence) {  // (F14)
  check(cycles);
  std::vector<double> f, v;
  Hysteresis hysteresis;
  for (std::size_t c = 0; c < cycles.size(); ++c) {
    f.insert(f.end(), cycles[c].force.begin(), cycles[c].force.end());
    v.insert(v.end(), cycles[c].voltage.begin(), cycles[c].voltage.end());
    if (!cycles[c].force.empty()) add_cycle(cycles[c], c + 1, hysteresis);
  }
  const auto n = static_cast<double>(f.size());
  hydro::require(f.size() >= 3, "a calibration line needs at least three points, got {}", f.size());
  double f_mean = 0, v_mean = 0, sff = 0, sfv = 0, rss = 0, worst = 0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    f_mean += f[i] / n;
    v_mean += v[i] / n;
  }
  for (std::size_t i = 0; i < f.size(); ++i) {
    sff += (f[i] - f_mean) * (f[i] - f_mean);
    sfv += (f[i] - f_mean) * (v[i] - v_mean);
  }
  hydro::require(sff > 0, "a calibration line needs at least two different loads");
  hydro::require(hysteresis.pairs > 0, "no load occurs on the way up and on the way down: the hysteresis is unknown");
  Calibration line{};
  line.slope = sfv / sff;
  line.offset = v_mean - line.slope * f_mean;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const double residual = v[i] - line.offset - line.slope * f[i];
    rss += residual * residual;
    worst = std::max(worst, std::abs(residual));
  }
  line.residual_deviation = std::sqrt(rss / (n - 2));
  line.slope_error = line.residual_deviation / std::sqrt(sff);
  line.offset_error = line.residual_deviation * std::sqrt(1 / n + f_mean * f_mean / sff);
  const double half = line.slope_error * hydro::signal::student_t_quantile((1 + confidence) / 2, n - 2);
  line.slope_interval = {line.slope - half, line.slope + half};
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  line.range = *high - *low;
  hydro::require(line.range > 0, "the voltage does not change with the load");
  line.nonlinearity = worst / line.range;
  line.hysteresis = hysteresis.largest / line.range;
  line.pairs = hysteresis.pairs;
  return line;
}

}  // namespace fit
