#include "fit/steady.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "fit/correlated.hpp"
#include "hydro/base/error.hpp"

namespace fit {
namespace {

constexpr std::size_t least_samples = 64;

void check(std::span<const double> values, std::size_t least) {
  hydro::require(values.size() >= least, "a steady part needs {} samples at least, got {}", least, values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    hydro::require(std::isfinite(values[i]), "sample {} is not finite", i + 1);
}

/// Means over blocks; samples after the last whole block are left out.
std::vector<double> means_over(std::span<const double> values, std::size_t block) {
  std::vector<double> out(values.size() / block);
  for (std::size_t b = 0; b < out.size(); ++b) {
    const auto part = values.subspan(b * block, block);
    out[b] = std::accumulate(part.begin(), part.end(), 0.0) / static_cast<double>(block);
  }
  return out;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The first stretch above a tenth of the largest value that comes above half of it.
Stretch first_motion(std::span<const double> v, double top) {
  const auto fast =
      static_cast<std::size_t>(std::find_if(v.begin(), v.end(), [&](double x) { return x > top / 2; }) - v.begin());
  Stretch out{fast, fast + 1};
  while (out.from > 0 && v[out.from - 1] > top / 10) --out.from;
  while (out.to < v.size() && v[out.to] > top / 10) ++out.to;
  return out;
}

/// The longest stretch of `within` in which values stay about `level`.
Stretch longest_about(std::span<const double> v, Stretch within, double level, double tolerance) {
  Stretch best{within.from, within.from};
  std::size_t from = within.from;
  for (std::size_t i = within.from; i < within.to; ++i) {
    if (std::abs(v[i] - level) > tolerance * level) from = i + 1;
    if (i + 1 - from > best.size() && i + 1 > from) best = {from, i + 1};
  }
  return best;
}

/// In blocks so coarse that an autoregression of order 20 reaches over a twentieth.
CoefficientCovariance covariance_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& left) {
  const auto block = static_cast<int>(std::max<Eigen::Index>(1, left.size() / 400));
  return correlated_covariance(columns, left, block, LongMemory::widen);
}

/// A line from −1/2 to 1/2 beside the mean, which it leaves as it is. What is left beside it knows nothing of the
/// drift, so that the drift does not pass for a long memory.
void add_drift(const Eigen::VectorXd& about_mean, SteadyMean& out) {
  const Eigen::Index n = about_mean.size();
  Eigen::MatrixXd columns(n, 2);
  columns.col(0).setOnes();
  columns.col(1) = Eigen::VectorXd::LinSpaced(n, -0.5, 0.5);
  out.drift = columns.col(1).dot(about_mean) / columns.col(1).squaredNorm();
  const Eigen::VectorXd left = about_mean - out.drift * columns.col(1);
  if (left.squaredNorm() > 1e-24 * about_mean.squaredNorm())
    out.drift_error = std::sqrt(covariance_of(columns, left).covariance(1, 1));
}

Eigen::VectorXd less_mean(std::span<const double> values, double mean) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values)).array() - mean;
}

double mean_over(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

Tow find_tow(std::span<const double> speed, double tolerance) {  // (F90)
  check(speed, least_samples);
  hydro::require(tolerance > 0 && tolerance < 1, "a tolerance of speed must lie between 0 and 1, got {}", tolerance);
  const std::size_t block = std::max<std::size_t>(1, speed.size() / 500);
  const std::vector<double> v = means_over(speed, block);
  const double top = *std::max_element(v.begin(), v.end());
  hydro::require(top > 0, "the speed is nowhere positive: the largest mean over {} samples is {:.4g} m/s", block, top);
  const Stretch motion = first_motion(v, top);
  std::vector<double> fast;
  for (std::size_t i = motion.from; i < motion.to; ++i)
    if (v[i] > top / 2) fast.push_back(v[i]);
  double level = median_of(fast);
  Stretch even = longest_about(v, motion, level, tolerance);
  hydro::require(even.size() > 0, "the speed is nowhere within {:g} % of its median {:.4g} m/s", 100 * tolerance,
                 level);
  level =
      median_of({v.begin() + static_cast<std::ptrdiff_t>(even.from), v.begin() + static_cast<std::ptrdiff_t>(even.to)});
  even = longest_about(v, motion, level, tolerance);
  // The block in which the speed leaves its level lies partly on it.
  if (even.from > motion.from && even.size() > 2) ++even.from;
  if (even.to < motion.to && even.size() > 2) --even.to;
  hydro::require(even.size() * block >= least_samples,
                 "the speed stays within {:g} % of {:.4g} m/s for {} samples at most, and a steady part needs {}",
                 100 * tolerance, level, even.size() * block, least_samples);
  const bool again =
      std::any_of(v.begin() + static_cast<std::ptrdiff_t>(motion.to), v.end(), [&](double x) { return x > top / 2; });
  return {.motion = {motion.from * block, motion.to * block},
          .even_speed = {even.from * block, even.to * block},
          .speed = level,
          .moves_again = again};
}

std::optional<std::size_t> settled_from(std::span<const double> values) {  // (F91)
  check(values, 16);
  const std::size_t block = std::max<std::size_t>(1, values.size() / 200);
  const std::vector<double> v = means_over(values, block);
  const double middle = mean_over(v);  // squares of a large mean would drown the scatter
  double all = 0;
  for (const double x : v) all += (x - middle) * (x - middle);
  const double rounding = 1e-12 * all / static_cast<double>(v.size() * v.size());
  double sum = 0, squares = 0, least = std::numeric_limits<double>::infinity();
  std::size_t best = 0;
  const std::size_t half = v.size() / 2;
  for (std::size_t i = v.size(); i-- > 0;) {
    sum += v[i] - middle;
    squares += (v[i] - middle) * (v[i] - middle);
    if (i > half) continue;
    const auto left = static_cast<double>(v.size() - i);
    const double error = std::max(0.0, squares - sum * sum / left) / (left * left);
    if (error <= least + rounding) best = i;  // of equals the longer
    least = std::min(least, error);
  }
  if (best == half) return {};
  return best * block;
}

double SteadyMean::coefficient_of_variation() const { return deviation / std::abs(value); }

SteadyMean steady_mean(std::span<const double> values) {  // (F92)
  check(values, least_samples);
  SteadyMean out{};
  out.value = mean_over(values);
  const Eigen::VectorXd left = less_mean(values, out.value);
  const auto n = static_cast<double>(values.size());
  out.deviation = std::sqrt(left.squaredNorm() / (n - 1));
  if (left.squaredNorm() <= 1e-28 * n * out.value * out.value) {  // rounding alone
    out.effective_samples = n;
    out.dof = n - 1;
    return out;
  }
  const CoefficientCovariance u = covariance_of(Eigen::VectorXd::Ones(left.size()), left);
  out.error = std::sqrt(u.covariance(0, 0));
  out.effective_samples = u.effective_samples[0];
  out.dof = u.dof;
  add_drift(left, out);
  return out;
}

}  // namespace fit
