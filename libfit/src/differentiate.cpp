#include "fit/differentiate.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <numeric>

#include "convolve.hpp"
#include "golden_section.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/harmonics.hpp"
#include "hydro/signal/welch.hpp"

namespace fit {
namespace {

constexpr int degree = 4;
constexpr double allowed_gain_error = 0.01;
constexpr double two_pi = 2 * std::numbers::pi;

double main_frequency(std::span<const double> values, double step_s) {
  hydro::require(values.size() >= 64, "a motion needs at least 64 samples to be differentiated, got {}", values.size());
  const auto w = hydro::signal::welch(values, step_s, {.segment = values.size() / 2 * 2, .overlap = 0});
  const auto peak = hydro::signal::peak(w.spectrum, hydro::signal::whole(w.spectrum));
  const double periods = peak.frequency_hz * step_s * static_cast<double>(values.size());
  hydro::require(periods > 1.99, "the record holds {:.2g} periods of its main motion; two are needed", periods);
  return peak.frequency_hz;
}

[[noreturn]] void refuse_sampling(double hz, double step_s) {
  throw hydro::InputError(
      fmt::format("motion up to {:.4g} Hz cannot be differentiated to 1 % at {:.4g} samples per second", hz,
                  1 / step_s),
      {}, "sample at least fifteen times as fast as the highest frequency that matters");
}

// The longest window whose error stays within bounds up to a frequency. The error grows with ωm, so bisection would
// do; a scan is short enough and cannot be misled.
LocalPolynomial longest_window(int order, double step_s, double bandwidth_hz, std::size_t samples) {
  const double omega = two_pi * bandwidth_hz;
  const int longest = static_cast<int>(samples / 8);
  int best = 0;
  for (int m = 3; m <= longest; ++m) {
    if (std::abs(LocalPolynomial(order, m, step_s).gain(omega) - 1) > allowed_gain_error) break;
    best = m;
  }
  if (best == 0) refuse_sampling(bandwidth_hz, step_s);
  return {order, best, step_s};
}

double bandwidth_of(const DerivativeWeights& filter, double step_s) {
  const double unit = 1e-3 * two_pi / (2 * filter.half_width() * step_s);
  double omega = unit;
  while (omega < std::numbers::pi / step_s && std::abs(filter.gain(omega) - 1) <= allowed_gain_error) omega += unit;
  return (omega - unit) / two_pi;
}

}  // namespace

DerivativeWeights::DerivativeWeights(int order, int half_width, double step_s)
    : order_(order), half_width_(half_width), step_(step_s) {
  hydro::require(order >= 0 && order <= 2, "derivatives of order 0, 1 and 2 are known, got {}", order);
  hydro::require(std::isfinite(step_s) && step_s > 0, "the sampling step must be positive, got {} s", step_s);
}

LocalPolynomial::LocalPolynomial(int order, int half_width, double step_s)
    : DerivativeWeights(order, half_width, step_s) {  // (F5)
  hydro::require(half_width >= 3, "a window of degree 4 needs at least 3 samples on each side, got {}", half_width);
  // In u = t/(mΔt), |u| <= 1: powers of u stay of order one however long the window.
  Eigen::MatrixXd powers(2 * half_width + 1, degree + 1);
  for (int j = -half_width; j <= half_width; ++j)
    for (int k = 0; k <= degree; ++k) powers(j + half_width, k) = std::pow(static_cast<double>(j) / half_width, k);
  Eigen::VectorXd pick = Eigen::VectorXd::Zero(degree + 1);
  pick[order] = (order == 2 ? 2.0 : 1.0) / std::pow(half_width * step_s, order);
  // w = P (PᵀP)⁻¹ pick by QR: P = QR gives w = Q R⁻ᵀ pick.
  const hydro::dense::HouseholderQr qr(powers);
  const Eigen::VectorXd w = qr.thin_Q() * qr.R().transpose().triangularView<Eigen::Lower>().solve(pick);
  weights_.assign(w.data(), w.data() + w.size());
}

namespace {

/// Of quintic B-splines with knots at the samples, w = ωΔt: values and derivatives at the samples, and the penalty.
/// (F44)
double spline_values(double w) { return (66 + 52 * std::cos(w) + 2 * std::cos(2 * w)) / 120; }
double spline_derivatives(int order, double w) {
  if (order == 0) return spline_values(w);
  if (order == 1) return (10 * std::sin(w) + std::sin(2 * w)) / 12;
  return (2 * std::cos(w) + std::cos(2 * w) - 3) / 3;
}
double spline_penalty(double w) { return std::pow(2 * std::sin(w / 2), 6); }

/// Weights die out as e^{−|j|/(2λ^{1/6})}: to 1e-8 so far.
int spline_half_width(double stiffness) {
  return static_cast<int>(std::ceil(2 * std::log(1e8) * std::max(1.0, std::pow(stiffness, 1.0 / 6))));
}

}  // namespace

SmoothingSpline::SmoothingSpline(int order, double stiffness, double step_s)
    : DerivativeWeights(order, spline_half_width(stiffness), step_s) {  // (F44)
  hydro::require(stiffness > 0 && stiffness < 1e15, "a spline's stiffness must lie between 0 and 1e15, got {}",
                 stiffness);
  // The mean over frequencies of a smooth periodic function: trapezia are exact but for weights beyond the sum.
  const int m = half_width_, n = 2 * m;
  weights_.assign(static_cast<std::size_t>(2 * m + 1), 0);
  for (int k = 0; k <= n; ++k) {
    const double w = std::numbers::pi * k / n, share = (k == 0 || k == n ? 0.5 : 1.0) / n;
    const double response = share * spline_derivatives(order, w) / (spline_values(w) + stiffness * spline_penalty(w)) /
                            std::pow(step_s, order);
    for (int j = 0; j <= m; ++j) {
      const double part = response * (order == 1 ? std::sin(w * j) : std::cos(w * j));
      weights_[static_cast<std::size_t>(m + j)] += part;
      if (j > 0) weights_[static_cast<std::size_t>(m - j)] += order == 1 ? -part : part;
    }
  }
  // What is cut off goes into the middle: a constant comes out as it should.
  weights_[static_cast<std::size_t>(m)] +=
      (order == 0 ? 1.0 : 0.0) - std::accumulate(weights_.begin(), weights_.end(), 0.0);
}

double SmoothingSpline::stiffness(int order, double omega, double error, double step_s) {
  const double w = omega * step_s;
  hydro::require(w > 0 && w < std::numbers::pi && error > 0 && error < 1,
                 "a frequency of {:.4g} rad/s cannot be told at steps of {} s", omega, step_s);
  const double truth = order == 0 ? 1 : order == 1 ? w : -w * w;
  const double out = (spline_derivatives(order, w) / (truth * (1 - error)) - spline_values(w)) / spline_penalty(w);
  if (!(out > 0)) refuse_sampling(omega / two_pi, step_s);
  return out;
}

double DerivativeWeights::gain(double omega) const {  // (F6)
  double sum = 0;
  for (int j = -half_width_; j <= half_width_; ++j) {
    const double phase = omega * j * step_;
    sum += weights_[static_cast<std::size_t>(j + half_width_)] * (order_ == 1 ? std::sin(phase) : std::cos(phase));
  }
  if (order_ == 0) return sum;
  if (omega == 0) return 1;
  return order_ == 1 ? sum / omega : -sum / (omega * omega);
}

double DerivativeWeights::noise_gain() const {
  return std::sqrt(std::inner_product(weights_.begin(), weights_.end(), weights_.begin(), 0.0));
}

std::vector<double> DerivativeWeights::apply(std::span<const double> values) const {
  return sliding_sum(values, weights_);
}

double noise_in(std::span<const double> values, const DerivativeWeights& smooth) {
  // What is left of noise e is (1 − W) e, of variance 1 − 2w₀ + Σw².
  const auto smoothed = smooth.apply(values);
  const auto m = static_cast<std::size_t>(smooth.half_width());
  double sum = 0;
  for (std::size_t j = 0; j < smoothed.size(); ++j) sum += std::pow(values[j + m] - smoothed[j], 2);
  const double kept = 1 - 2 * smooth.middle() + std::pow(smooth.noise_gain(), 2);
  return std::sqrt(sum / static_cast<double>(smoothed.size()) / kept);
}

LocalPolynomial smoother_of(std::span<const double> values, double step_s) {
  constexpr int shortest = 3;
  double hz = 0;
  try {
    hz = main_frequency(values, step_s);
  } catch (const hydro::InputError&) {  // fewer than two periods: there is little to smooth over
    return {0, shortest, step_s};
  }
  if (std::abs(LocalPolynomial(0, shortest, step_s).gain(two_pi * 5 * hz) - 1) > allowed_gain_error)
    return {0, shortest, step_s};
  return longest_window(0, step_s, 5 * hz, values.size());
}

namespace {

/// What is left to tell of a motion once weights of each order are there.
template <class Weights>
Motion told(std::span<const double> values, double step_s, double f, bool from_velocity, const Weights& order) {
  const auto smooth = order(0), first = order(1);
  const auto last = from_velocity ? first : order(2);
  const auto m = static_cast<std::size_t>(last.half_width());
  const double noise = noise_in(values, smooth);
  Motion out{
      .first = m,
      .velocity = {values.begin() + static_cast<std::ptrdiff_t>(m), values.end() - static_cast<std::ptrdiff_t>(m)},
      .acceleration = last.apply(values),
      .main_period_s = 1 / f,
      .half_width = last.half_width(),
      .bandwidth_hz = bandwidth_of(last, step_s),
      .gain_error_main = std::abs(last.gain(two_pi * f) - 1),
      .gain_error_fifth = std::abs(last.gain(5 * two_pi * f) - 1),
      .noise_velocity = noise,
      .noise_acceleration = noise * last.noise_gain(),
      .noise = noise,
      .weights = {smooth, last}};
  if (from_velocity) return out;
  out.weights = {smooth, first, last};
  out.velocity = first.apply(values);
  out.noise_velocity = noise * first.noise_gain();
  return out;
}

Motion by_spline(std::span<const double> values, double step_s, double f, double bandwidth_hz, bool from_velocity) {
  const double stiffness =
      SmoothingSpline::stiffness(from_velocity ? 1 : 2, two_pi * bandwidth_hz, allowed_gain_error, step_s);
  const auto m = static_cast<std::size_t>(spline_half_width(stiffness));
  hydro::require(values.size() >= 4 * m,
                 "a smoothing spline for {:.4g} Hz gives up {} samples at each end, and the record has {}: widen "
                 "derivative_bandwidth, or take a local polynomial",
                 bandwidth_hz, m, values.size());
  return told(values, step_s, f, from_velocity, [&](int order) { return SmoothingSpline(order, stiffness, step_s); });
}

/// The frequency near f of which a record holds most with its harmonics, by golden section; the record is long enough
/// for one minimum within half a period of the whole of it.
double refined(const std::function<double(double)>& left, double f, double duration) {
  return least_by_golden_section(left, f - 0.5 / duration, f + 0.5 / duration, 1e-7 * f);
}

/// The series' derivative of this order, and the deviation of it for noise of 1 in each of the samples. (F45)
std::vector<double> derived(const hydro::signal::Harmonics& h, const std::vector<double>& omega, int order,
                            const std::vector<double>& time) {
  std::vector<double> out(time.size(), order == 0 ? h.mean : 0);
  for (std::size_t k = 0; k < omega.size(); ++k) {
    const std::complex<double> amplitude = h.amplitude[k] * std::pow(std::complex<double>(0, omega[k]), order);
    for (std::size_t j = 0; j < time.size(); ++j) out[j] += (amplitude * std::polar(1.0, omega[k] * time[j])).real();
  }
  return out;
}
double series_noise(const std::vector<double>& omega, int order, std::size_t samples) {
  double sum = order == 0 ? 0.5 : 0;
  for (const double w : omega) sum += std::pow(w, 2 * order);
  return std::sqrt(2 * sum / static_cast<double>(samples));
}

/// At two samples a period a harmonic and its mirror beyond the Nyquist frequency are the same numbers, and near it
/// noise decides between them: (F45) takes three.
void require_resolved(double highest_hz, double step_s) {
  constexpr double least = 3;
  const double samples = 1 / (highest_hz * step_s);
  if (samples >= least * (1 - 1e-9)) return;
  throw hydro::InputError(
      fmt::format(
          "the highest harmonic of the series, {:.4g} Hz, has {:.3g} samples a period; {} are needed to tell it "
          "from what is faster",
          highest_hz, samples, least),
      {}, fmt::format("narrow derivative_bandwidth to {:.4g} Hz at most, or sample faster", 1 / (least * step_s)));
}

Motion by_series(std::span<const double> values, double step_s, double f, double bandwidth_hz, bool from_velocity) {
  std::vector<double> time(values.size());
  for (std::size_t j = 0; j < time.size(); ++j) time[j] = static_cast<double>(j) * step_s;
  const int count = static_cast<int>(std::floor(bandwidth_hz / f * (1 + 1e-3) + 1e-3));
  hydro::require(count >= 1, "a series up to {:.4g} Hz has no harmonic of {:.4g} Hz", bandwidth_hz, f);
  require_resolved(count * f, step_s);
  const auto harmonics = [&](double hz) {
    std::vector<double> out;
    for (int k = 1; k <= count; ++k) out.push_back(two_pi * hz * k);
    return out;
  };
  const auto series = [&](double hz) { return hydro::signal::fit_harmonics(time, values, harmonics(hz)); };
  f = refined([&](double hz) { return series(hz).residual_rms; }, f, time.back());
  const auto omega = harmonics(f);
  const auto found = series(f);
  double rms = 0;
  for (const double v : values) rms += std::pow(v - found.mean, 2) / static_cast<double>(values.size());
  const double left = found.residual_rms / std::sqrt(rms);
  hydro::require(left <= 0.1,
                 "the motion does not repeat: {:.3g} % of it is in none of the {} harmonics of {:.4g} Hz. Cut starting "
                 "and stopping off, widen derivative_bandwidth, or take another derivative_method",
                 100 * left, count, f);
  const int last = from_velocity ? 1 : 2;
  return {.first = 0,
          .velocity = derived(found, omega, last - 1, time),
          .acceleration = derived(found, omega, last, time),
          .main_period_s = 1 / f,
          .half_width = 0,
          .bandwidth_hz = count * f,
          .gain_error_main = 0,
          .gain_error_fifth = count < 5 ? 1.0 : 0.0,
          .noise_velocity = found.residual_rms * series_noise(omega, last - 1, values.size()),
          .noise_acceleration = found.residual_rms * series_noise(omega, last, values.size()),
          .left = left};
}

Motion derive(std::span<const double> values, double step_s, double bandwidth_hz, Derivative method,
              bool from_velocity) {
  const double f = main_frequency(values, step_s);
  const double bandwidth = bandwidth_hz > 0 ? bandwidth_hz : 5 * f;
  if (method == Derivative::fourier_series) return by_series(values, step_s, f, bandwidth, from_velocity);
  if (method == Derivative::smoothing_spline) return by_spline(values, step_s, f, bandwidth, from_velocity);
  const int m = longest_window(from_velocity ? 1 : 2, step_s, bandwidth, values.size()).half_width();
  return told(values, step_s, f, from_velocity, [&](int order) { return LocalPolynomial(order, m, step_s); });
}

}  // namespace

Motion from_position(std::span<const double> position_m, double step_s, double bandwidth_hz, Derivative method) {
  return derive(position_m, step_s, bandwidth_hz, method, false);
}

Motion from_velocity(std::span<const double> velocity_m_s, double step_s, double bandwidth_hz, Derivative method) {
  return derive(velocity_m_s, step_s, bandwidth_hz, method, true);
}

}  // namespace fit
