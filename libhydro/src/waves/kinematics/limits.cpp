#include "hydro/waves/kinematics/limits.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "steady_common.hpp"

namespace hydro::waves {

std::string_view name(WaveRegion region) {
  constexpr std::array<std::string_view, 7> names{"linear",
                                                  "Stokes second order",
                                                  "Stokes third order",
                                                  "Stokes fifth order",
                                                  "cnoidal (stream function)",
                                                  "near breaking (stream function)",
                                                  "breaking"};
  return names[static_cast<std::size_t>(region)];
}

double highest_wave(double wavelength, const WaterDepth& depth) {
  require(std::isfinite(wavelength) && wavelength > 0, "a wavelength must be finite and positive, got {} m",
          wavelength);
  // (W60), divided through by (λ/h)³ so that it holds for infinite depth too.
  const double d = depth.is_infinite() ? std::numeric_limits<double>::infinity() : depth.metres() / wavelength;
  if (d > 1e3) return 0.141063 * wavelength;  // both quotients agree to 1e-3 of their last printed digit
  return depth.metres() * ((0.141063 * d + 0.0095721) * d + 0.0077829) /
         (((d + 0.0788340) * d + 0.0317567) * d + 0.0093407);
}

namespace {

// (W61): the first harmonic that a theory leaves out, as a share of the wave's own amplitude, must stay below this.
constexpr double left_out = 0.01;

WaveRegion region_of(const WaveLimits& wave, double height, double kh) {
  if (height > wave.highest) return WaveRegion::breaking;
  const double epsilon = std::numbers::pi * wave.steepness;
  const double e = std::exp(-2 * kh);
  const double S = 2 * e / (1 + e * e), T = std::tanh(kh), G = 2 * T * T / (1 + T * T);
  const double second = epsilon * (1 + 2 * S) / (2 * T * G);
  if (second < left_out) return WaveRegion::linear;
  if (wave.ursell > 26) return WaveRegion::cnoidal;
  const double third = epsilon * epsilon * 3 * (1 + S * (3 + S * (3 + 2 * S))) / (8 * G * G * G);
  if (third < left_out) return WaveRegion::stokes_second;
  const double fourth = std::pow(epsilon, 3) * (24 + S * (92 + S * (122 + S * (66 + S * (67 + 34 * S))))) /
                        (24 * T * (3 + 2 * S) * std::pow(G, 4));
  if (fourth < left_out) return WaveRegion::stokes_third;
  // B55 ε⁴ alone does not tell when the fifth order fails near breaking; four fifths of the highest wave does.
  return height < 0.8 * wave.highest ? WaveRegion::stokes_fifth : WaveRegion::near_breaking;
}

void collect_warnings(WaveLimits& wave, double height) {
  const auto warn = [&](bool passed, std::string text) {
    if (passed) wave.warnings.push_back(std::move(text));
  };
  warn(wave.ursell > 26, fmt::format("Ursell number H λ²/h³ = {:.4g} is above 26: Stokes' series do not hold, use the "
                                     "stream function",
                                     wave.ursell));
  warn(wave.relative_height > 0.78,
       fmt::format("H/h = {:.4g} is above 0.78: a wave this high breaks on the bed", wave.relative_height));
  warn(wave.steepness > 0.142, fmt::format("H/λ = {:.4g} is above 0.142: a wave this steep breaks", wave.steepness));
  warn(height > wave.miche,
       fmt::format("H = {:.4g} m is above Miche's limit 0.142 λ tanh kh = {:.4g} m", height, wave.miche));
  warn(height > wave.highest, fmt::format("H = {:.4g} m is above the highest steady wave of {:.4g} m length, {:.4g} m",
                                          height, wave.wavelength, wave.highest));
}

}  // namespace

WaveLimits wave_limits(const SteadyWaveInput& input) {
  check(input);
  const double k = linear_wavenumber(input), length = 2 * std::numbers::pi / k;
  const double h = input.water.depth.metres(), H = input.height_m;
  const double relative_depth = h / length;
  WaveLimits wave{.region = WaveRegion::linear,
                  .depth_regime = waves::depth_regime(2 * std::numbers::pi * relative_depth),
                  .wavelength = length,
                  .steepness = H / length,
                  .relative_height = H / h,
                  .relative_depth = relative_depth,
                  .ursell = H / h * (length / h) * (length / h),
                  .highest = highest_wave(length, input.water.depth),
                  .miche = 0.142 * length * std::tanh(k * h),
                  .warnings = {}};
  wave.region = region_of(wave, H, k * h);
  collect_warnings(wave, H);
  return wave;
}

}  // namespace hydro::waves
