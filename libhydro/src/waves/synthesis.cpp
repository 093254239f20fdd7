#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "hydro/signal/fft.hpp"
#include "hydro/waves/sea.hpp"

namespace hydro::waves {
namespace {

using Complex = std::complex<double>;
using Amplitudes = std::span<const Complex>;

void require_one_per_component(const Sea& sea, Amplitudes amplitudes) {
  require(amplitudes.size() == sea.components().size(), "{} complex amplitudes given for a sea of {} components",
          amplitudes.size(), sea.components().size());
}

void require_below_nyquist(const Sea& sea, const TimeGrid& grid) {
  require(std::isfinite(grid.dt_s) && grid.dt_s > 0, "a time step must be finite and positive, got {} s", grid.dt_s);
  for (const Component& wave : sea.components())
    if (wave.omega * grid.dt_s >= std::numbers::pi * (1 - 1e-12))
      throw InputError(fmt::format("a wave of period {} s cannot be sampled every {} s: less than two samples a period",
                                   2 * std::numbers::pi / wave.omega, grid.dt_s),
                       {}, "give a smaller time step, or a sea with a lower highest frequency");
}

// Steps in one repetition, if that is a whole number but for the rounding of dt and of the product.
std::optional<std::size_t> steps_in_repetition(const Sea& sea, double dt) {
  const double steps = std::round(sea.repetition_s() / dt);
  const double miss = std::abs(steps * dt - sea.repetition_s());
  if (steps < 1 || miss > 4 * std::numeric_limits<double>::epsilon() * sea.repetition_s()) return {};
  return static_cast<std::size_t>(steps);
}

// (W10): every component is a bin of the transform, those without one are zero.
std::vector<double> by_inverse_fft(const Sea& sea, std::size_t period, std::size_t samples, Amplitudes amplitudes) {
  std::vector<Complex> half(period / 2 + 1, 0.0);
  const auto index = sea.grid_index();
  for (std::size_t i = 0; i < index.size(); ++i) half[index[i]] = 0.5 * amplitudes[i];
  std::vector<double> series = signal::inverse_real_fft(half, period);
  series.reserve(samples);
  for (std::size_t n = period; n < samples; ++n) series.push_back(series[n - period]);
  series.resize(samples);
  return series;
}

// Turning a phasor costs one product instead of a sine and a cosine; 64 products lose 64 roundings, no more.
std::vector<double> by_phasors(const Sea& sea, const TimeGrid& grid, Amplitudes amplitudes) {
  constexpr std::size_t block = 64;
  std::vector<double> series(grid.samples, 0.0);
  for (std::size_t i = 0; i < amplitudes.size(); ++i) {
    const double omega = sea.components()[i].omega;
    const Complex turn = std::polar(1.0, omega * grid.dt_s);
    Complex phasor;
    for (std::size_t n = 0; n < grid.samples; ++n) {
      phasor = n % block == 0 ? amplitudes[i] * std::polar(1.0, omega * (static_cast<double>(n) * grid.dt_s))
                              : phasor * turn;
      series[n] += phasor.real();
    }
  }
  return series;
}

}  // namespace

std::complex<double> elevation_transfer(const Component& wave, double x_m, double y_m) {
  return std::polar(1.0, -wave.k * (x_m * std::cos(wave.heading) + y_m * std::sin(wave.heading)));
}

std::vector<std::complex<double>> response_amplitudes(const Sea& sea, const Transfer& transfer) {
  std::vector<Complex> amplitudes;
  amplitudes.reserve(sea.components().size());
  for (const Component& wave : sea.components())
    amplitudes.push_back(std::polar(wave.amplitude, wave.phase) * transfer(wave));
  return amplitudes;
}

double sum_at(const Sea& sea, Amplitudes amplitudes, double t_s) {
  require_one_per_component(sea, amplitudes);
  double sum = 0;
  for (std::size_t i = 0; i < amplitudes.size(); ++i)
    sum += (amplitudes[i] * std::polar(1.0, sea.components()[i].omega * t_s)).real();
  return sum;
}

std::vector<double> synthesise(const Sea& sea, const TimeGrid& grid, Amplitudes amplitudes) {
  require_one_per_component(sea, amplitudes);
  require_below_nyquist(sea, grid);
  if (grid.samples == 0) return {};
  if (const auto period = steps_in_repetition(sea, grid.dt_s))
    return by_inverse_fft(sea, *period, grid.samples, amplitudes);
  return by_phasors(sea, grid, amplitudes);
}

std::vector<double> synthesise(const Sea& sea, const TimeGrid& grid, const Transfer& transfer) {
  return synthesise(sea, grid, response_amplitudes(sea, transfer));
}

}  // namespace hydro::waves
