#include "fit/differentiate.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "convolve.hpp"
#include "hydro/base/error.hpp"
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
  if (best == 0)
    throw hydro::InputError(
        fmt::format("motion up to {:.4g} Hz cannot be differentiated to 1 % at {:.4g} samples per second", bandwidth_hz,
                    1 / step_s),
        {}, "sample at least fifteen times as fast as the highest frequency that matters");
  return {order, best, step_s};
}

double bandwidth_of(const LocalPolynomial& filter, double step_s) {
  const double unit = 1e-3 * two_pi / (2 * filter.half_width() * step_s);
  double omega = unit;
  while (omega < std::numbers::pi / step_s && std::abs(filter.gain(omega) - 1) <= allowed_gain_error) omega += unit;
  return (omega - unit) / two_pi;
}

// Standard deviation of white noise in the input: the smoothed record misses the part of it that 2m + 1 samples average
// out, 1 − w₀ − (w₀ − Σw²) with Σw² = w₀ for a projection, so 1 − w₀.
double noise_in(std::span<const double> values, int half_width, double step_s) {
  const LocalPolynomial smooth(0, half_width, step_s);
  const auto smoothed = smooth.apply(values);
  double sum = 0;
  for (std::size_t j = 0; j < smoothed.size(); ++j)
    sum += std::pow(values[j + static_cast<std::size_t>(half_width)] - smoothed[j], 2);
  const double kept = 1 - std::pow(smooth.noise_gain(), 2);
  return std::sqrt(sum / static_cast<double>(smoothed.size()) / kept);
}

}  // namespace

LocalPolynomial::LocalPolynomial(int order, int half_width, double step_s)
    : order_(order), half_width_(half_width), step_(step_s) {  // (F5)
  hydro::require(order >= 0 && order <= 2, "derivatives of order 0, 1 and 2 are known, got {}", order);
  hydro::require(half_width >= 3, "a window of degree 4 needs at least 3 samples on each side, got {}", half_width);
  hydro::require(std::isfinite(step_s) && step_s > 0, "the sampling step must be positive, got {} s", step_s);
  // In u = t/(mΔt), |u| <= 1: powers of u stay of order one however long the window.
  Eigen::MatrixXd powers(2 * half_width + 1, degree + 1);
  for (int j = -half_width; j <= half_width; ++j)
    for (int k = 0; k <= degree; ++k) powers(j + half_width, k) = std::pow(static_cast<double>(j) / half_width, k);
  Eigen::VectorXd pick = Eigen::VectorXd::Zero(degree + 1);
  pick[order] = (order == 2 ? 2.0 : 1.0) / std::pow(half_width * step_s, order);
  // w = P (PᵀP)⁻¹ pick by QR: P = QR gives w = Q R⁻ᵀ pick.
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(powers);
  const Eigen::MatrixXd thin = qr.householderQ() * Eigen::MatrixXd::Identity(powers.rows(), degree + 1);
  const Eigen::MatrixXd r = qr.matrixQR().topRows(degree + 1).triangularView<Eigen::Upper>();
  const Eigen::VectorXd w = thin * r.transpose().triangularView<Eigen::Lower>().solve(pick);
  weights_.assign(w.data(), w.data() + w.size());
}

double LocalPolynomial::gain(double omega) const {  // (F6)
  double sum = 0;
  for (int j = -half_width_; j <= half_width_; ++j) {
    const double phase = omega * j * step_;
    sum += weights_[static_cast<std::size_t>(j + half_width_)] * (order_ == 1 ? std::sin(phase) : std::cos(phase));
  }
  if (order_ == 0) return sum;
  if (omega == 0) return 1;
  return order_ == 1 ? sum / omega : -sum / (omega * omega);
}

double LocalPolynomial::noise_gain() const {
  return std::sqrt(std::inner_product(weights_.begin(), weights_.end(), weights_.begin(), 0.0));
}

std::vector<double> LocalPolynomial::apply(std::span<const double> values) const {
  return sliding_sum(values, weights_);
}

Motion from_position(std::span<const double> position_m, double step_s, double bandwidth_hz) {
  const double f = main_frequency(position_m, step_s);
  const LocalPolynomial second = longest_window(2, step_s, bandwidth_hz > 0 ? bandwidth_hz : 5 * f, position_m.size());
  const int m = second.half_width();
  const LocalPolynomial first(1, m, step_s);
  const double noise = noise_in(position_m, m, step_s);
  return {static_cast<std::size_t>(m),
          first.apply(position_m),
          second.apply(position_m),
          1 / f,
          m,
          bandwidth_of(second, step_s),
          std::abs(second.gain(two_pi * f) - 1),
          std::abs(second.gain(5 * two_pi * f) - 1),
          noise * first.noise_gain(),
          noise * second.noise_gain()};
}

Motion from_velocity(std::span<const double> velocity_m_s, double step_s, double bandwidth_hz) {
  const double f = main_frequency(velocity_m_s, step_s);
  const LocalPolynomial first = longest_window(1, step_s, bandwidth_hz > 0 ? bandwidth_hz : 5 * f, velocity_m_s.size());
  const auto m = static_cast<std::size_t>(first.half_width());
  const double noise = noise_in(velocity_m_s, first.half_width(), step_s);
  return {m,
          {velocity_m_s.begin() + static_cast<std::ptrdiff_t>(m), velocity_m_s.end() - static_cast<std::ptrdiff_t>(m)},
          first.apply(velocity_m_s),
          1 / f,
          first.half_width(),
          bandwidth_of(first, step_s),
          std::abs(first.gain(two_pi * f) - 1),
          std::abs(first.gain(5 * two_pi * f) - 1),
          noise,
          noise * first.noise_gain()};
}

}  // namespace fit
