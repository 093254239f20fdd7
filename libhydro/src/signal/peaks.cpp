#include "hydro/signal/peaks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/signal/zero_crossings.hpp"

namespace hydro::signal {
namespace {

/// b_r = (1/n) Σ_j x_(j) (j−1)…(j−r)/((n−1)…(n−r)) of sorted values, r = 0, 1: without bias.
struct WeightedMoments {
  double b0 = 0, b1 = 0;
};
WeightedMoments weighted_moments(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  const auto n = static_cast<double>(x.size());
  WeightedMoments out;
  for (std::size_t j = 0; j < x.size(); ++j) {
    out.b0 += x[j] / n;
    out.b1 += x[j] * static_cast<double>(j) / (n - 1) / n;
  }
  return out;
}

/// Of so many peaks in the duration that they stay below with this probability, none above the threshold: +∞.
double exceedances_per_largest(double rate_hz, double duration_s, double probability) {
  require(duration_s > 0 && probability > 0 && probability < 1,
          "a duration and a probability within 0 and 1 are needed");
  return rate_hz * duration_s / -std::log(probability);
}

Interval quantiles(std::vector<double> draws, double confidence) {
  require(confidence > 0 && confidence < 1, "a confidence is within 0 and 1, got {}", confidence);
  std::sort(draws.begin(), draws.end());
  const auto at = [&](double share) {
    return draws[static_cast<std::size_t>(
        std::clamp(share * static_cast<double>(draws.size()), 0.0, static_cast<double>(draws.size()) - 1))];
  };
  return {at((1 - confidence) / 2), at((1 + confidence) / 2)};
}

/// Estimates of records that follow a fit: `count` values by the inverse of its distribution, fitted anew.
template <class Value, class Estimate>
Interval bootstrap(std::size_t count, std::uint64_t seed, double confidence, const Value& value,
                   const Estimate& estimate) {
  constexpr std::size_t draws = 1000;
  constexpr std::uint64_t stream = 0x6c617267;  // "larg"
  const RandomStream random(seed, stream);
  std::vector<double> out;
  for (std::size_t d = 0; d < draws; ++d) {
    std::vector<double> x;
    for (std::size_t i = 0; i < count; ++i) x.push_back(value(random.uniform(d * count + i)));
    out.push_back(estimate(x));
  }
  return quantiles(std::move(out), confidence);
}

/// σ, ξ by moments of what is above the threshold: F = 1 − (1 + ξy/σ)^{−1/ξ} has b₀ = σ/(1 − ξ), b₀ − b₁ =
/// σ/(2(2 − ξ)).
ParetoTail tail_of(const std::vector<double>& above, double threshold, double rate_hz) {
  const WeightedMoments m = weighted_moments(above);
  const double a1 = m.b0 - m.b1;
  return {.threshold = threshold,
          .scale = 2 * m.b0 * a1 / (m.b0 - 2 * a1),
          .shape = 2 - m.b0 / (m.b0 - 2 * a1),
          .rate_hz = rate_hz};
}

BlockMaxima gumbel_of(const std::vector<double>& maxima, double block_s) {
  const WeightedMoments m = weighted_moments(maxima);
  const double scale = (2 * m.b1 - m.b0) / std::numbers::ln2;
  return {.location = m.b0 - std::numbers::egamma * scale, .scale = scale, .block_s = block_s};
}

}  // namespace

std::vector<double> crests(std::span<const double> time_s, std::span<const double> values) {
  const Trend trend = trend_of(time_s, values);
  std::vector<double> out;
  for (const SingleWave& wave : single_waves(time_s, values)) out.push_back(wave.crest + trend.level(wave.start_s));
  return out;
}

namespace {
constexpr double no_shape = 1e-9;  // below, powers of the shape lose their digits, and the law is exponential

/// What one in n exceedances is above.
double exceedance(const ParetoTail& t, double n) {
  return t.scale * (std::abs(t.shape) < no_shape ? std::log(n) : (std::pow(n, t.shape) - 1) / t.shape);
}
}  // namespace

// (S22)
double ParetoTail::share_above(double level) const {
  const double y = (level - threshold) / scale;
  if (y <= 0) return 1;
  if (std::abs(shape) < no_shape) return std::exp(-y);
  const double base = 1 + shape * y;
  return base > 0 ? std::pow(base, -1 / shape) : 0;
}

double ParetoTail::largest_not_exceeded(double duration_s, double probability) const {
  const double n = exceedances_per_largest(rate_hz, duration_s, probability);
  if (n < 1) return -std::numeric_limits<double>::infinity();
  return threshold + exceedance(*this, n);
}

ParetoTail fit_tail(std::span<const double> peaks, double threshold, double duration_s) {
  require(duration_s > 0, "a duration must be positive, got {} s", duration_s);
  std::vector<double> above;
  for (const double p : peaks)
    if (p > threshold) above.push_back(p - threshold);
  constexpr std::size_t least = 10;  // with fewer the shape scatters by more than its range
  require(above.size() >= least, "{} peaks are above {:.6g}, and a tail needs {}", above.size(), threshold, least);
  const auto [low, high] = std::minmax_element(above.begin(), above.end());
  require(*high > *low, "all peaks above {:.6g} are alike: they have no tail", threshold);
  return tail_of(above, threshold, static_cast<double>(above.size()) / duration_s);
}

// (S23)
double BlockMaxima::largest_not_exceeded(double duration_s, double probability) const {
  return location + scale * std::log(exceedances_per_largest(1 / block_s, duration_s, probability));
}

std::vector<double> block_maxima(std::span<const double> time_s, std::span<const double> values, double block_s) {
  require(block_s > 0, "a block must be longer than nothing, got {} s", block_s);
  trend_of(time_s, values);  // looks the record through
  const double step = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
  const auto blocks = static_cast<std::size_t>((time_s.back() - time_s.front() + step) / block_s + 1e-9);
  std::vector<double> highest(blocks, -std::numeric_limits<double>::infinity()), out;
  std::vector<double> samples(blocks, 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto block = static_cast<std::size_t>((time_s[i] - time_s.front()) / block_s + 1e-9);
    if (block >= blocks) break;
    highest[block] = std::max(highest[block], values[i]);
    ++samples[block];
  }
  const double whole = *std::max_element(samples.begin(), samples.end());
  for (std::size_t b = 0; b < blocks; ++b)
    if (samples[b] > whole / 2) out.push_back(highest[b]);
  return out;
}

BlockMaxima fit_maxima(std::span<const double> maxima, double block_s) {
  constexpr std::size_t least = 5;
  require(maxima.size() >= least, "{} blocks have a maximum, and {} are needed: shorter blocks, or a longer record",
          maxima.size(), least);
  const auto [low, high] = std::minmax_element(maxima.begin(), maxima.end());
  require(*high > *low, "all maxima are alike: they follow no law");
  return gumbel_of({maxima.begin(), maxima.end()}, block_s);
}

Interval interval_of(const ParetoTail& tail, std::size_t peaks, double duration_s, double probability,
                     double confidence, std::uint64_t seed) {
  const auto drawn = [&](double u) { return exceedance(tail, 1 / (1 - u)); };
  return bootstrap(peaks, seed, confidence, drawn, [&](const std::vector<double>& above) {
    return tail_of(above, tail.threshold, tail.rate_hz).largest_not_exceeded(duration_s, probability);
  });
}

Interval interval_of(const BlockMaxima& fit, std::size_t blocks, double duration_s, double probability,
                     double confidence, std::uint64_t seed) {
  const auto maximum = [&](double u) {
    return fit.location - fit.scale * std::log(-std::log(std::max(u, std::numeric_limits<double>::min())));
  };
  return bootstrap(blocks, seed, confidence, maximum, [&](const std::vector<double>& maxima) {
    return gumbel_of(maxima, fit.block_s).largest_not_exceeded(duration_s, probability);
  });
}

}  // namespace hydro::signal
