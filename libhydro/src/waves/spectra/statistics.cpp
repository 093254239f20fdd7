#include "hydro/waves/spectra/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "waves/gauss_legendre.hpp"

namespace hydro::waves {
namespace {

using std::numbers::pi;

void require_waves(double hs_m, double waves) {
  require(std::isfinite(hs_m) && hs_m > 0, "significant wave height must be finite and positive, got {} m", hs_m);
  require(std::isfinite(waves) && waves >= 1, "the number of waves must be finite and at least 1, got {}", waves);
}

}  // namespace

// (W47)
SeaNumbers sea_numbers(const Spectrum& spectrum, const Water& water) {
  const double hs = spectrum.hs(), tz = spectrum.tz(), k = wavenumber(spectrum.peak_omega(), water);
  const double length = 2 * pi / k;
  return {.peak_wavelength_m = length,
          .peak_steepness = hs / length,
          .crossing_steepness = 2 * pi * hs / (water.gravity * tz * tz),
          .relative_depth = k * water.depth.metres(),
          .ursell = ursell_number(hs, length, water.depth)};
}

double ursell_number(double height_m, double wavelength_m, const WaterDepth& depth) {
  require(std::isfinite(height_m) && height_m > 0, "a wave height must be finite and positive, got {} m", height_m);
  require(std::isfinite(wavelength_m) && wavelength_m > 0, "a wavelength must be finite and positive, got {} m",
          wavelength_m);
  const double ratio = wavelength_m / depth.metres();
  return height_m / depth.metres() * ratio * ratio;
}

// (W48). Both differences are at least zero (Schwarz); rounding may say otherwise for a single frequency.
double narrowness(const Spectrum& spectrum) {
  const double m1 = spectrum.moment(1);
  return std::sqrt(std::max(0.0, spectrum.moment(0) * spectrum.moment(2) / (m1 * m1) - 1));
}

double broadness(const Spectrum& spectrum, double omega_max) {
  require(std::isfinite(omega_max) && omega_max > 0,
          "the upper end of the band must be finite and positive, got {} rad/s", omega_max);
  const double m0 = spectrum.band_moment(0, 0, omega_max), m2 = spectrum.band_moment(2, 0, omega_max);
  require(m0 > 0, "the spectrum has no energy below {} rad/s", omega_max);
  return std::sqrt(std::max(0.0, 1 - m2 * m2 / (m0 * spectrum.band_moment(4, 0, omega_max))));
}

double number_of_waves(const Spectrum& spectrum, double duration_s) {
  require(std::isfinite(duration_s) && duration_s > 0, "a duration must be finite and positive, got {} s", duration_s);
  return duration_s / spectrum.tz();
}

// (W49): the peak of the density of the highest, which is where n e^{−2h²/Hs²} (4h²/Hs² − …) turns; √(½ ln n) is the
// height that is exceeded once on average, and the peak but for 1/ln n.
double most_probable_highest(double hs_m, double waves) {
  require_waves(hs_m, waves);
  // d/dx of ln[x e^{−2x²} (1 − e^{−2x²})^{n−1}] = 0 with q = e^{−2x²}: 1/(4x²) − 1 + (n − 1) q/(1 − q) = 0, which falls
  // with x.
  const auto slope = [&](double x) {
    const double q = std::exp(-2 * x * x);
    return 1 / (4 * x * x) - 1 + (waves - 1) * q / -std::expm1(-2 * x * x);
  };
  double low = 0.5, high = 0.5 + std::sqrt(0.5 * std::log(waves)) + 1;  // n = 1: x = ½ exactly
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (slope(middle) > 0 ? low : high) = middle;
  }
  return hs_m * 0.5 * (low + high);
}

// (W49): ∫ P(highest > h) dh.
double expected_highest(double hs_m, double waves) {
  require_waves(hs_m, waves);
  static const GaussLegendre<16> rule;
  const double end = std::sqrt(0.5 * std::log(waves)) + 5;  // there n e^{−2x²} < e^{−50}
  const int panels = static_cast<int>(std::ceil(end / 0.1));
  double sum = 0;
  for (int i = 0; i < panels; ++i)
    sum += rule.integrate([&](double x) { return -std::expm1(waves * std::log1p(-std::exp(-2 * x * x))); },
                          end * i / panels, end * (i + 1) / panels);
  return hs_m * sum;
}

double highest_not_exceeded(double hs_m, double waves, double probability) {
  require_waves(hs_m, waves);
  require(probability > 0 && probability < 1, "a probability must lie between 0 and 1, got {}", probability);
  return hs_m * std::sqrt(-0.5 * std::log(-std::expm1(std::log(probability) / waves)));
}

}  // namespace hydro::waves
