#include "hydro/signal/zero_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "hydro/base/error.hpp"

namespace hydro::signal {
namespace {

void check(std::span<const double> time_s, std::span<const double> values) {
  require(time_s.size() == values.size(), "{} times but {} values", time_s.size(), values.size());
  require(values.size() >= 2, "a record needs at least two samples, got {}", values.size());
  const auto back = std::adjacent_find(time_s.begin(), time_s.end(), std::greater_equal<>());
  require(back == time_s.end(), "time must increase, but does not after sample {}", back - time_s.begin() + 1);
  const auto bad = std::find_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
  require(bad == values.end(), "sample {} of the record is not a finite number", bad - values.begin() + 1);
}

}  // namespace

Trend trend_of(std::span<const double> time_s, std::span<const double> values) {
  check(time_s, values);
  const double n = static_cast<double>(values.size());
  Trend out{.mean = std::accumulate(values.begin(), values.end(), 0.0) / n,
            .middle_s = std::accumulate(time_s.begin(), time_s.end(), 0.0) / n,
            .slope = 0,
            .share = 0};
  double tt = 0, tx = 0, xx = 0;
  for (std::size_t j = 0; j < values.size(); ++j) {
    const double t = time_s[j] - out.middle_s, x = values[j] - out.mean;
    tt += t * t;
    tx += t * x;
    xx += x * x;
  }
  out.slope = tx / tt;
  out.share = xx > 0 ? out.slope * tx / xx : 0;
  return out;
}

std::vector<SingleWave> single_waves(std::span<const double> time_s, std::span<const double> values) {  // (S11)
  const Trend trend = trend_of(time_s, values);
  std::vector<SingleWave> waves;
  constexpr auto none = static_cast<std::size_t>(-1);
  std::size_t below = none;  // the last sample under the level, as long as none above it has followed
  SingleWave now{};
  bool inside = false;
  for (std::size_t j = 0; j < values.size(); ++j) {
    const double x = values[j] - trend.level(time_s[j]);
    if (x > 0 && below != none) {
      const double before = values[below] - trend.level(time_s[below]);
      const double crossing = time_s[below] + (time_s[j] - time_s[below]) * before / (before - x);
      if (inside) {
        now.period = crossing - now.start_s;
        waves.push_back(now);
      }
      now = {.start_s = crossing, .period = 0, .crest = 0, .trough = 0};
      inside = true;
      below = none;
    }
    if (x < 0) below = j;
    now.crest = std::max(now.crest, x);
    now.trough = std::min(now.trough, x);
  }
  return waves;
}

// A sample is off the crest by up to half a step either way: the mean of the cosine over that.
double missed_of_crests(std::span<const double> time_s, std::span<const double> values) {
  const std::vector<SingleWave> waves = single_waves(time_s, values);
  if (waves.size() < 3) return 0;
  const double all = waves.back().start_s + waves.back().period - waves.front().start_s,
               step = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1),
               half = std::numbers::pi * step * static_cast<double>(waves.size()) / all;
  return 1 - std::sin(half) / half;
}

WaveStatistics wave_statistics(std::span<const SingleWave> waves) {
  require(waves.size() >= 3, "the record holds {} complete waves; the highest third needs at least 3", waves.size());
  std::vector<SingleWave> sorted(waves.begin(), waves.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.height() > b.height(); });
  const auto mean = [&](std::size_t count, auto what) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += what(sorted[i]);
    return sum / static_cast<double>(count);
  };
  const auto height = [](const SingleWave& w) { return w.height(); };
  const auto period = [](const SingleWave& w) { return w.period; };
  const std::size_t n = sorted.size();
  return {n, mean(n, height), mean(n / 3, height), sorted.front().height(), mean(n, period), mean(n / 3, period)};
}

}  // namespace hydro::signal
