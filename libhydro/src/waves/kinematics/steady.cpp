#include "hydro/waves/kinematics/steady.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "steady_common.hpp"

namespace hydro::waves {
namespace {

double mean_flow_velocity(const SteadyWaveInput& input) {
  return std::visit([](const auto& flow) { return flow.velocity; }, input.mean_flow);
}

// Largest departure from (W54) and (W55) over half a wave, at points that fall between those of any solver.
void measure_residuals(SteadyWave& wave, const WaveFrame& frame) {
  const std::size_t N = frame.potential.size();
  const std::size_t points = 10 * N + 41;
  const double h = wave.water.depth.metres(), g = wave.water.gravity;
  for (std::size_t m = 0; m <= points; ++m) {
    const double X = std::numbers::pi * static_cast<double>(m) / static_cast<double>(points);
    double eta = 0, psi = 0, u = 0, w = 0;
    for (std::size_t j = 1; j <= frame.elevation.size(); ++j)
      eta += frame.elevation[j - 1] * std::cos(static_cast<double>(j) * X);
    for (std::size_t j = 1; j <= N; ++j) {
      const double jk = static_cast<double>(j) * frame.k, B = frame.potential[j - 1];
      const DepthProfile p = depth_profile(jk, h, eta);
      const double c = std::cos(static_cast<double>(j) * X), s = std::sin(static_cast<double>(j) * X);
      psi += B * p.sinh * c;
      u += jk * B * p.cosh * c;
      w += jk * B * p.sinh * s;
    }
    const double kinematic = std::abs(psi - frame.U * eta + frame.flux) / (frame.U * wave.height);
    const double dynamic =
        std::abs(-frame.U * u + 0.5 * (u * u + w * w) + g * eta - frame.bernoulli) / (g * wave.height);
    wave.kinematic_residual = std::max(wave.kinematic_residual, kinematic);
    wave.dynamic_residual = std::max(wave.dynamic_residual, dynamic);
  }
}

double sum_with_signs(const std::vector<double>& coefficients, double sign) {
  double sum = 0, factor = sign;
  for (const double value : coefficients) {
    sum += factor * value;
    factor *= sign;
  }
  return sum;
}

}  // namespace

Wavelength Wavelength::from_metres(double length) {
  require(std::isfinite(length) && length > 0, "a wavelength must be finite and positive, got {} m", length);
  return Wavelength(length);
}

void check(const SteadyWaveInput& input) {
  require(std::isfinite(input.height_m) && input.height_m > 0, "a wave height must be finite and positive, got {} m",
          input.height_m);
  require(std::isfinite(input.water.gravity) && input.water.gravity > 0,
          "gravity must be finite and positive, got {} m/s^2", input.water.gravity);
  require(std::isfinite(mean_flow_velocity(input)), "the mean flow must be finite, got {} m/s",
          mean_flow_velocity(input));
  if (std::holds_alternative<TransportVelocity>(input.mean_flow) && input.water.depth.is_infinite())
    throw InputError("the transport velocity of a wave is a mean over the depth, which is infinite here", {},
                     "give the Eulerian current, or a finite depth");
}

double linear_wavenumber(const SteadyWaveInput& input) {
  if (const auto* length = std::get_if<Wavelength>(&input.length)) return 2 * std::numbers::pi / length->metres();
  const double omega = std::get<AngularFrequency>(input.length).rad_per_s();
  const double U = mean_flow_velocity(input);
  if (U == 0) return wavenumber(omega, input.water);
  return doppler(omega, Angle::from_radians(0), Current::uniform({U, 0}), input.water).k;
}

double phase_velocity(const WaveFrame& frame, const SteadyWaveInput& input) {
  if (const auto* current = std::get_if<EulerianCurrent>(&input.mean_flow)) return frame.U + current->velocity;
  const double h = input.water.depth.metres();
  return frame.U + frame.flux / h + std::get<TransportVelocity>(input.mean_flow).velocity;
}

SteadyWave finish(WaveFrame frame, const SteadyWaveInput& input) {
  const double c = phase_velocity(frame, input);
  require(c > 0, "a mean flow of {} m/s stops a wave that runs at {:.4g} m/s through still water",
          mean_flow_velocity(input), frame.U);
  const double h = input.water.depth.metres();
  const double current = c - frame.U;
  SteadyWave wave{.water = input.water,
                  .height = input.height_m,
                  .k = frame.k,
                  .omega = frame.k * c,
                  .phase_velocity = c,
                  .eulerian_current = current,
                  .transport_velocity = current - frame.flux / h,
                  .wave_flux = -frame.flux,
                  .bernoulli = frame.bernoulli,
                  .elevation = {},
                  .potential = {},
                  .kinematic_residual = 0,
                  .dynamic_residual = 0};
  measure_residuals(wave, frame);
  wave.elevation = std::move(frame.elevation);
  wave.potential = std::move(frame.potential);
  return wave;
}

double SteadyWave::crest() const { return sum_with_signs(elevation, 1); }
double SteadyWave::trough() const { return sum_with_signs(elevation, -1); }

HarmonicField SteadyWave::field(Angle heading, double phase) const {
  const double cos_beta = std::cos(heading.radians()), sin_beta = std::sin(heading.radians());
  std::vector<Harmonic> harmonics;
  for (std::size_t n = 0; n < std::max(elevation.size(), potential.size()); ++n) {
    const auto j = static_cast<double>(n + 1);
    const std::complex<double> turn = std::polar(1.0, j * phase);
    harmonics.push_back({.omega = j * omega,
                         .kx = j * k * cos_beta,
                         .ky = j * k * sin_beta,
                         .elevation = n < elevation.size() ? elevation[n] * turn : 0.0,
                         // u = Re(−ijkΦ …) is jkB at a crest, so Φ = iB.
                         .potential = n < potential.size() ? std::complex<double>(0, potential[n]) * turn : 0.0});
  }
  Current current = eulerian_current == 0
                        ? Current::none()
                        : Current::uniform({eulerian_current * cos_beta, eulerian_current * sin_beta});
  HarmonicField::Options options{};
  options.stretching = Stretching::none;
  options.pressure = PressureLaw::full;
  options.bernoulli_constant = bernoulli;
  return {std::move(harmonics), water, options, std::move(current)};
}

}  // namespace hydro::waves
