#include "fit/resample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "hydro/base/error.hpp"

namespace fit {
namespace {

constexpr double resampling_decibels = 60, kaiser_beta = 0.1102 * (resampling_decibels - 8.7);

/// Of the window, at −1 … 1; 0 outside.
double kaiser(double r) {
  if (std::abs(r) >= 1) return 0;
  return std::cyl_bessel_i(0.0, kaiser_beta * std::sqrt(1 - r * r)) / std::cyl_bessel_i(0.0, kaiser_beta);
}

}  // namespace

Resampler::Resampler(double step_s, double new_step_s) : step_(step_s), ratio_(new_step_s / step_s) {
  hydro::require(step_s > 0 && new_step_s > 0 && std::isfinite(step_s) && std::isfinite(new_step_s),
                 "sampling steps must be positive, got {} s and {} s", step_s, new_step_s);
  slower_hz_ = 1 / std::max(step_s, new_step_s);
  // Kaiser's rule for a transition of 0.2 of the slower rate, in samples to either side.
  reach_ = (resampling_decibels - 7.95) / (2 * 14.36 * 0.2 * slower_hz_ * step_s);
  half_width_ = static_cast<std::size_t>(std::ceil(reach_));
}

// The middle of the transition is at 0.4 of the slower rate. The weights of every instant add up to one, so that a
// constant stays what it is.
std::vector<double> Resampler::weights(double fraction) const {  // (F48)
  std::vector<double> w;
  for (auto i = 1 - static_cast<std::ptrdiff_t>(half_width_); i <= static_cast<std::ptrdiff_t>(half_width_); ++i) {
    const double u = static_cast<double>(i) - fraction, x = 2 * std::numbers::pi * 0.4 * slower_hz_ * step_ * u;
    w.push_back((std::abs(x) < 1e-12 ? 1.0 : std::sin(x) / x) * kaiser(u / reach_));
  }
  const double sum = std::accumulate(w.begin(), w.end(), 0.0);
  for (double& v : w) v /= sum;
  return w;
}

double Resampler::gain(double omega) const {
  const auto w = weights(0);
  double sum = 0;
  for (std::size_t i = 0; i < w.size(); ++i)
    sum += w[i] * std::cos(omega * step_ * (static_cast<double>(i) + 1 - static_cast<double>(half_width_)));
  return sum;
}

std::vector<double> Resampler::apply(std::span<const double> values) const {
  const double room = static_cast<double>(values.size()) - 1 - 2 * static_cast<double>(half_width_);
  hydro::require(room >= ratio_,
                 "a record of {} samples is too short for another rate: {} samples at each end are given up",
                 values.size(), half_width_);
  std::vector<double> out(static_cast<std::size_t>(std::floor(room / ratio_ + 1e-9)) + 1), w;
  double last = -1;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const double at = static_cast<double>(half_width_) + ratio_ * static_cast<double>(k);
    const double whole = std::floor(at + 1e-9);  // instants that fall on a sample but for rounding share its weights
    const double fraction = std::max(0.0, at - whole);
    if (std::abs(fraction - last) > 1e-9) {
      w = weights(fraction);
      last = fraction;
    }
    const auto from = static_cast<std::size_t>(whole) + 1 - half_width_;
    const std::size_t count = std::min(w.size(), values.size() - from);  // a weight beyond the last sample is zero
    out[k] = std::inner_product(w.begin(), w.begin() + static_cast<std::ptrdiff_t>(count),
                                values.begin() + static_cast<std::ptrdiff_t>(from), 0.0);
  }
  return out;
}

}  // namespace fit
