#include "fit/wave_motion.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "hydro/base/error.hpp"
#include "hydro/signal/fft.hpp"
#include "hydro/signal/harmonics.hpp"
#include "hydro/signal/welch.hpp"
#include "hydro/waves/dispersion.hpp"
#include "morison_columns.hpp"

namespace fit {
namespace {

using Complex = std::complex<double>;
constexpr double two_pi = 2 * std::numbers::pi;

/// cosh k(z + h)/sinh kh and sinh k(z + h)/sinh kh, without overflow at any depth.
struct Profiles {
  double along, up;
};
Profiles profiles(double k, double z, const hydro::Water& water) {
  if (water.depth.is_infinite()) return {std::exp(k * z), std::exp(k * z)};
  const double h = water.depth.metres(), scale = std::exp(k * z) / -std::expm1(-2 * k * h),
               rest = std::exp(-2 * k * (z + h));
  return {scale * (1 + rest), scale * (1 - rest)};
}

double main_period(std::span<const double> values, double step) {
  const auto w = hydro::signal::welch(values, step, {.segment = values.size() / 2 * 2, .overlap = 0});
  return hydro::signal::peak(w.spectrum, hydro::signal::whole(w.spectrum)).period_s();
}

/// Mean off, and both ends brought to zero over one period, so that the transform joins nothing to nothing.
std::vector<double> tapered(std::span<const double> values, std::size_t over) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  std::vector<double> out(values.begin(), values.end());
  for (double& v : out) v -= mean;
  for (std::size_t j = 0; j < over; ++j) {
    const double w =
        std::pow(std::sin(std::numbers::pi / 2 * (static_cast<double>(j) + 0.5) / static_cast<double>(over)), 2);
    out[j] *= w;
    out[out.size() - 1 - j] *= w;
  }
  return out;
}

/// Motion of the water where the body rests: amplitudes over the frequencies of the transform, and their wavenumbers.
struct WaveSeries {
  std::size_t n;
  std::vector<Complex> u, w, a;
  std::vector<double> k;
};
struct Samples {
  std::vector<double> u, w, a;
};

/// The motion at a place `x` further along the waves.
Samples samples_of(const WaveSeries& s, double x) {
  const auto there = [&](std::vector<Complex> half) {
    if (x != 0)
      for (std::size_t i = 1; i < half.size(); ++i) half[i] *= std::polar(1.0, -s.k[i] * x);
    return hydro::signal::inverse_real_fft(half, s.n);
  };
  return {there(s.u), there(s.w), there(s.a)};
}

/// The motion at x(t_j) for every sample j, by cubics between places a distance d apart; (F62).
Samples along_the_way(const WaveSeries& s, std::span<const double> x) {
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  const double highest = *std::max_element(s.k.begin(), s.k.end()), d = highest > 0 ? 0.3 / highest : 1;
  Samples out{std::vector<double>(s.n), std::vector<double>(s.n), std::vector<double>(s.n)};
  // Weights of place p at x: Lagrange's cubic through the places −1, 0, 1, 2 about the interval that holds x.
  const auto weight = [](double f, int p) {
    switch (p) {
      case -1:
        return -f * (f - 1) * (f - 2) / 6;
      case 0:
        return (f + 1) * (f - 1) * (f - 2) / 2;
      case 1:
        return -(f + 1) * f * (f - 2) / 2;
      default:
        return (f + 1) * f * (f - 1) / 6;
    }
  };
  const auto last = static_cast<int>(std::floor((*high - *low) / d)) + 2;
  for (int place = -1; place <= last; ++place) {
    const Samples here = samples_of(s, *low + d * place);
    for (std::size_t j = 0; j < s.n; ++j) {
      const double from = (x[j] - *low) / d;
      const int p = place - static_cast<int>(std::floor(from));
      if (p < -1 || p > 2) continue;
      const double q = weight(from - std::floor(from), p);
      out.u[j] += q * here.u[j];
      out.w[j] += q * here.w[j];
      out.a[j] += q * here.a[j];
    }
  }
  return out;
}

/// One sinusoid through the whole record.
WaterMotion regular_motion(std::span<const double> elevation, double step, const ProbeToBody& probe,
                           double rough_period, std::span<const double> excursion) {  // (F57)
  const std::size_t n = elevation.size();
  const double omega = two_pi * peak_frequency(elevation, step, rough_period);
  std::vector<double> time(n);
  for (std::size_t j = 0; j < n; ++j) time[j] = step * static_cast<double>(j);
  const auto surface = hydro::signal::fit_harmonics(time, elevation, std::vector{omega});
  WaterMotion motion{};
  motion.main_period_s = two_pi / omega;
  motion.highest_hz = omega / two_pi;
  motion.left = surface.residual_rms * std::numbers::sqrt2 / std::abs(surface.amplitude[0]);
  hydro::require(motion.left < 0.3,
                 "{:.2g} % of the surface are not in one sinusoid of {:.4g} s: it is no regular wave",
                 100 * motion.left, motion.main_period_s);
  const double k = hydro::waves::wavenumber(omega, probe.water);
  const Profiles p = profiles(k, probe.level, probe.water);
  const Complex there = surface.amplitude[0] * std::polar(1.0, -k * probe.ahead);
  motion.main_wavenumber = k;
  for (std::size_t j = 0; j < n; ++j) {
    const double phase = omega * time[j] - (probe.follow ? k * excursion[j] : 0);
    const Complex now = omega * there * std::polar(1.0, phase);
    motion.velocity.push_back(p.along * now.real());
    motion.rise.push_back(-p.up * now.imag());
    motion.acceleration.push_back(-omega * p.along * now.imag());
  }
  return motion;
}

}  // namespace

WaterMotion water_motion(std::span<const double> elevation, double step, const ProbeToBody& probe,
                         std::span<const double> excursion) {  // (F40)
  const double bottom = probe.water.depth.is_infinite() ? -1e300 : -probe.water.depth.metres();
  hydro::require(probe.level < 0 && probe.level > bottom,
                 "the body's level must lie between surface and bottom, got {} m", probe.level);
  hydro::require(elevation.size() >= 64, "a surface record needs 64 samples at least, got {}", elevation.size());
  const std::size_t n = elevation.size();
  hydro::require(!probe.follow || excursion.size() == n, "the surface has {} samples, the body's excursion {}", n,
                 excursion.size());
  WaterMotion motion{};
  motion.main_period_s = main_period(elevation, step);
  motion.main_wavenumber = hydro::waves::wavenumber(two_pi / motion.main_period_s, probe.water);
  const auto period = static_cast<std::size_t>(std::ceil(motion.main_period_s / step));
  hydro::require(n >= 5 * period, "the surface record holds {:.2g} main periods; five are needed",
                 static_cast<double>(n) / static_cast<double>(period));
  if (probe.regular) return regular_motion(elevation, step, probe, motion.main_period_s, excursion);
  auto spectrum = hydro::signal::real_fft(tapered(elevation, period));
  WaveSeries at_rest{n, std::vector<Complex>(spectrum.size()), std::vector<Complex>(spectrum.size()),
                     std::vector<Complex>(spectrum.size()), std::vector<double>(spectrum.size())};
  for (std::size_t i = 1; i < spectrum.size(); ++i) {
    const double omega = two_pi * static_cast<double>(i) / (static_cast<double>(n) * step), hz = omega / two_pi;
    const double k = hydro::waves::wavenumber(omega, probe.water);
    const Profiles p = profiles(k, probe.level, probe.water);
    if (probe.highest_hz > 0 ? hz > probe.highest_hz : p.along < 1e-3) break;
    motion.highest_hz = hz;
    const Complex there = spectrum[i] / static_cast<double>(n) * std::polar(1.0, -k * probe.ahead);
    at_rest.u[i] = omega * p.along * there;
    at_rest.w[i] = Complex(0, omega) * p.up * there;
    at_rest.a[i] = Complex(0, omega) * at_rest.u[i];
    at_rest.k[i] = k;
  }
  motion.first = period + period / 2;
  const Samples all = probe.follow ? along_the_way(at_rest, excursion) : samples_of(at_rest, 0);
  const auto inside = [&](const std::vector<double>& values) {
    const auto cut = static_cast<std::ptrdiff_t>(motion.first);
    return std::vector<double>(values.begin() + cut, values.end() - cut);
  };
  motion.velocity = inside(all.u);
  motion.rise = inside(all.w);
  motion.acceleration = inside(all.a);
  return motion;
}

}  // namespace fit
