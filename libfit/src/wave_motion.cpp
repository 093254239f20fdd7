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

/// One sinusoid through the whole record.
WaterMotion regular_motion(std::span<const double> elevation, double step, const ProbeToBody& probe,
                           double rough_period) {  // (F57)
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
  for (const double t : time) {
    const Complex now = omega * there * std::polar(1.0, omega * t);
    motion.velocity.push_back(p.along * now.real());
    motion.rise.push_back(-p.up * now.imag());
    motion.acceleration.push_back(-omega * p.along * now.imag());
  }
  return motion;
}

}  // namespace

WaterMotion water_motion(std::span<const double> elevation, double step, const ProbeToBody& probe) {  // (F40)
  const double bottom = probe.water.depth.is_infinite() ? -1e300 : -probe.water.depth.metres();
  hydro::require(probe.level < 0 && probe.level > bottom,
                 "the body's level must lie between surface and bottom, got {} m", probe.level);
  hydro::require(elevation.size() >= 64, "a surface record needs 64 samples at least, got {}", elevation.size());
  const std::size_t n = elevation.size();
  WaterMotion motion{};
  motion.main_period_s = main_period(elevation, step);
  const auto period = static_cast<std::size_t>(std::ceil(motion.main_period_s / step));
  hydro::require(n >= 5 * period, "the surface record holds {:.2g} main periods; five are needed",
                 static_cast<double>(n) / static_cast<double>(period));
  if (probe.regular) return regular_motion(elevation, step, probe, motion.main_period_s);
  auto spectrum = hydro::signal::real_fft(tapered(elevation, period));
  std::vector<Complex> u(spectrum.size()), w(spectrum.size()), a(spectrum.size());
  for (std::size_t i = 1; i < spectrum.size(); ++i) {
    const double omega = two_pi * static_cast<double>(i) / (static_cast<double>(n) * step), hz = omega / two_pi;
    const double k = hydro::waves::wavenumber(omega, probe.water);
    const Profiles p = profiles(k, probe.level, probe.water);
    if (probe.highest_hz > 0 ? hz > probe.highest_hz : p.along < 1e-3) break;
    motion.highest_hz = hz;
    const Complex there = spectrum[i] / static_cast<double>(n) * std::polar(1.0, -k * probe.ahead);
    u[i] = omega * p.along * there;
    w[i] = Complex(0, omega) * p.up * there;
    a[i] = Complex(0, omega) * u[i];
  }
  motion.first = period + period / 2;
  const auto inside = [&](const std::vector<Complex>& half) {
    const auto all = hydro::signal::inverse_real_fft(half, n);
    const auto cut = static_cast<std::ptrdiff_t>(motion.first);
    return std::vector<double>(all.begin() + cut, all.end() - cut);
  };
  motion.velocity = inside(u);
  motion.rise = inside(w);
  motion.acceleration = inside(a);
  return motion;
}

}  // namespace fit
