#include "fit/filter.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "convolve.hpp"
#include "hydro/base/error.hpp"

namespace fit {
namespace {

using std::numbers::pi;
constexpr double forgotten = 1e-4;  // of the memory, at the samples next to those given up

void check_frequency(const char* what, double hz, double step_s) {
  hydro::require(std::isfinite(step_s) && step_s > 0, "the sampling step must be positive, got {} s", step_s);
  if (!(hz > 0 && hz < 0.5 / step_s))
    throw hydro::InputError(
        fmt::format("{} must lie between 0 and half the sampling rate, {:.4g} Hz; got {:.4g}", what, 0.5 / step_s, hz),
        {}, "name another frequency, or take a record with more samples a second");
}

}  // namespace

// Direct form II transposed, started as if the first value had stood for ever.
void ZeroPhaseFilter::Section::run(std::vector<double>& values) const {
  const double level = (b0 + b1 + b2) / (1 + a1 + a2) * values.front();
  double s1 = level - b0 * values.front(), s2 = b2 * values.front() - a2 * level;
  for (double& x : values) {
    const double y = b0 * x + s1;
    s1 = b1 * x - a1 * y + s2;
    s2 = b2 * x - a2 * y;
    x = y;
  }
}

// The slowest pole decides how long the start of a record is felt.
void ZeroPhaseFilter::settle_sections() {  // (F16)
  double slowest = 0;
  for (const Section& s : sections_) {
    const std::complex<double> root = std::sqrt(std::complex<double>(s.a1 * s.a1 / 4 - s.a2));
    slowest = std::max({slowest, std::abs(-s.a1 / 2 + root), std::abs(-s.a1 / 2 - root)});
  }
  settling_ = static_cast<std::size_t>(std::ceil(std::log(forgotten) / std::log(slowest)));
}

/// 1/(s² + qs + 1) with s = (z − 1)/(z + 1)/k.
void ZeroPhaseFilter::add_pair(double q, double k) {
  const double unit = 1 + q * k + k * k;
  sections_.push_back(
      {k * k / unit, 2 * k * k / unit, k * k / unit, 2 * (k * k - 1) / unit, (1 - q * k + k * k) / unit});
}

/// 1/(s + 1) likewise.
void ZeroPhaseFilter::add_first_order(double k) {
  sections_.push_back({k / (1 + k), k / (1 + k), 0, (k - 1) / (k + 1), 0});
}

ZeroPhaseFilter ZeroPhaseFilter::butterworth(int order, double cutoff_hz, double step_s) {  // (F17)
  hydro::require(order >= 1 && order <= 10, "a Butterworth filter has an order from 1 to 10, got {}", order);
  check_frequency("the cutoff of a low pass", cutoff_hz, step_s);
  ZeroPhaseFilter f(fmt::format("Butterworth low pass of order {}, {:.4g} Hz, forward and backward", order, cutoff_hz),
                    step_s);
  const double k = std::tan(pi * cutoff_hz * step_s);
  for (int pair = 0; pair < order / 2; ++pair) f.add_pair(2 * std::sin(pi * (2 * pair + 1) / (2 * order)), k);
  if (order % 2 == 1) f.add_first_order(k);
  f.settle_sections();
  return f;
}

// Poles on an ellipse. Of even order the gain is 1 at its troughs, so that that of a mean is; of odd order at its
// crests.
ZeroPhaseFilter ZeroPhaseFilter::chebyshev(int order, double ripple, double cutoff_hz, double step_s) {  // (F18)
  hydro::require(order >= 2 && order <= 10, "a Chebyshev filter has an order from 2 to 10, got {}", order);
  hydro::require(ripple >= 1e-6 && ripple <= 0.1, "the ripple of a Chebyshev filter lies between 1e-6 and 0.1, got {}",
                 ripple);
  check_frequency("the cutoff of a low pass", cutoff_hz, step_s);
  ZeroPhaseFilter f(
      fmt::format("Chebyshev low pass of order {} with a ripple of {:.3g}, {:.4g} Hz, forward and backward", order,
                  ripple, cutoff_hz),
      step_s);
  const bool even = order % 2 == 0;
  const double square = even ? ripple : ripple / (1 - ripple), at_zero = even ? 1 + square : 1;  // ε² and N
  const double half = std::cosh(std::acosh(std::sqrt((2 * at_zero - 1) / square)) / order);      // x_c
  const double a = std::asinh(1 / std::sqrt(square)) / order, k = std::tan(pi * cutoff_hz * step_s) / half;
  for (int pair = 0; pair < order / 2; ++pair) {
    const double angle = pi * (2 * pair + 1) / (2 * order);
    const double decay = std::sinh(a) * std::sin(angle), size = std::hypot(decay, std::cosh(a) * std::cos(angle));
    f.add_pair(2 * decay / size, k * size);
  }
  if (!even) f.add_first_order(k * std::sinh(a));
  f.settle_sections();
  return f;
}

ZeroPhaseFilter ZeroPhaseFilter::gaussian(double cutoff_hz, double step_s) {  // (F18)
  check_frequency("the cutoff of a low pass", cutoff_hz, step_s);
  constexpr double highest = 0.2;  // of the sampling rate: above, it folds back more than 1e-4
  hydro::require(cutoff_hz < highest / step_s,
                 "the cutoff of a Gaussian filter must lie below {} times the sampling rate, {:.4g} Hz; got {:.4g}",
                 highest, highest / step_s, cutoff_hz);
  const double sigma = std::sqrt(std::numbers::ln2 / 2) / (pi * cutoff_hz * step_s);  // samples
  constexpr double tails = 4.5;                                                       // σ: 7e-6 of the bell lie beyond
  const auto m = static_cast<int>(std::ceil(tails * sigma));
  ZeroPhaseFilter f(fmt::format("Gaussian low pass of {} weights, {:.4g} Hz", 2 * m + 1, cutoff_hz), step_s);
  for (int j = -m; j <= m; ++j) f.weights_.push_back(std::exp(-j * j / (2 * sigma * sigma)));
  const double sum = std::accumulate(f.weights_.begin(), f.weights_.end(), 0.0);
  for (double& w : f.weights_) w /= sum;
  f.settling_ = static_cast<std::size_t>(m);
  return f;
}

ZeroPhaseFilter ZeroPhaseFilter::finite(double cutoff_hz, double step_s) {  // (F18)
  check_frequency("the cutoff of a low pass", cutoff_hz, step_s);
  constexpr double decibels = 60;
  const double beta = 0.1102 * (decibels - 8.7);  // Kaiser's rules, over a transition as wide as the cutoff
  const auto m = static_cast<int>(std::ceil((decibels - 7.95) / (14.36 * 2 * cutoff_hz * step_s)));
  ZeroPhaseFilter f(fmt::format("symmetric low pass of {} weights, {:.4g} Hz", 2 * m + 1, cutoff_hz), step_s);
  for (int j = -m; j <= m; ++j) {
    const double x = 2 * pi * cutoff_hz * step_s * j, r = static_cast<double>(j) / m;
    const double window = std::cyl_bessel_i(0.0, beta * std::sqrt(1 - r * r)) / std::cyl_bessel_i(0.0, beta);
    f.weights_.push_back((j == 0 ? 1.0 : std::sin(x) / x) * window);
  }
  const double sum = std::accumulate(f.weights_.begin(), f.weights_.end(), 0.0);
  for (double& w : f.weights_) w /= sum;
  f.settling_ = static_cast<std::size_t>(m);
  return f;
}

ZeroPhaseFilter ZeroPhaseFilter::notch(double centre_hz, double width_hz, double step_s) {  // (F18)
  check_frequency("the centre of a notch", centre_hz, step_s);
  hydro::require(width_hz > 0 && width_hz < centre_hz,
                 "the width of a notch must lie between 0 and its centre, {:.4g} Hz; got {:.4g}", centre_hz, width_hz);
  ZeroPhaseFilter f(fmt::format("notch at {:.4g} Hz, {:.3g} Hz wide, forward and backward", centre_hz, width_hz),
                    step_s);
  const double omega = 2 * pi * centre_hz * step_s, half = std::tan(pi * width_hz * step_s), unit = 1 + half;
  const double c = std::cos(omega);
  f.sections_.push_back({1 / unit, -2 * c / unit, 1 / unit, -2 * c / unit, (1 - half) / unit});
  f.settle_sections();
  return f;
}

ZeroPhaseFilter ZeroPhaseFilter::moving_average(int samples, double step_s) {  // (F18)
  hydro::require(samples >= 3 && samples % 2 == 1,
                 "a moving average without delay takes an odd number of samples from 3 on, got {}", samples);
  ZeroPhaseFilter f(fmt::format("moving average over {} samples", samples), step_s);
  f.weights_.assign(static_cast<std::size_t>(samples), 1.0 / samples);
  f.settling_ = static_cast<std::size_t>(samples / 2);
  return f;
}

double ZeroPhaseFilter::gain(double omega) const {
  const auto z = [&](double power) { return std::polar(1.0, -power * omega * step_); };
  double gain = 1;
  for (const Section& s : sections_)
    gain *= std::norm((s.b0 + s.b1 * z(1) + s.b2 * z(2)) / (1.0 + s.a1 * z(1) + s.a2 * z(2)));
  if (weights_.empty()) return gain;
  double sum = 0;
  for (std::size_t j = 0; j < weights_.size(); ++j)
    sum += weights_[j] * std::cos(omega * step_ * (static_cast<double>(j) - static_cast<double>(settling_)));
  return sum;
}

double ZeroPhaseFilter::bandwidth_hz() const {
  constexpr int points = 4096;
  for (int i = 1; i <= points; ++i)
    if (std::abs(gain(pi / step_ * i / points) - 1) > 0.01) {
      double low = pi / step_ * (i - 1) / points, high = pi / step_ * i / points;
      for (int k = 0; k < 40; ++k) {
        const double middle = (low + high) / 2;
        (std::abs(gain(middle) - 1) > 0.01 ? high : low) = middle;
      }
      return low / (2 * pi);
    }
  return 0.5 / step_;
}

std::vector<double> ZeroPhaseFilter::apply(std::span<const double> values) const {  // (F16)
  hydro::require(values.size() > 2 * settling_,
                 "the {} gives up {} samples at each end, and the record has {}: nothing would be left", name_,
                 settling_, values.size());
  if (!weights_.empty()) return sliding_sum(values, weights_);
  std::vector<double> out(values.begin(), values.end());
  for (int pass = 0; pass < 2; ++pass) {
    for (const Section& s : sections_) s.run(out);
    std::reverse(out.begin(), out.end());
  }
  const auto cut = static_cast<std::ptrdiff_t>(settling_);
  return {out.begin() + cut, out.end() - cut};
}

}  // namespace fit
