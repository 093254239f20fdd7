#include "hydro/waves/spectra/spectrum.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace hydro::waves::spectrum_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Slow and plain: Simpson's rule with 400 000 intervals in s on each side of the peak, ω = ω_p s or ω = ω_p/s. The kink
// at the peak stands on a node, and the tail ω^{n−5} becomes the polynomial s^{3−n}.
double plain_moment(const Jonswap& spectrum, int n) {
  const double omega_p = 2 * std::numbers::pi / spectrum.tp();
  const int intervals = 400'000;
  const auto simpson = [&](const std::function<double(double)>& f) {
    double sum = 0;
    for (int i = 0; i <= intervals; ++i) {
      const double s = static_cast<double>(i) / intervals;
      if (i > 0) sum += f(s) * (i == intervals ? 1 : i % 2 == 1 ? 4 : 2);  // f(0) = 0 on both sides for n <= 2
    }
    return sum / (3.0 * intervals);
  };
  const auto weighted = [&](double omega) { return std::pow(omega, n) * spectrum.density(omega); };
  return omega_p * (simpson([&](double s) { return weighted(omega_p * s); }) +
                    simpson([&](double s) { return weighted(omega_p / s) / (s * s); }));
}

TEST(Jonswap, CarriesExactlyTheEnergyOfItsSignificantHeight) {
  for (const double gamma : {1.0, 1.7, 3.3, 7.0, 20.0}) {
    const Jonswap spectrum(8.2, 11.7, gamma);
    EXPECT_NEAR(spectrum.moment(0) / (8.2 * 8.2 / 16), 1.0, 1e-14) << gamma;
    EXPECT_NEAR(spectrum.hs(), 8.2, 1e-13) << gamma;
    // Simpson on this grid is good to 1e-12 except for γ's kink in the second derivative, which is on a node.
    EXPECT_NEAR(plain_moment(spectrum, 0) / spectrum.moment(0), 1.0, 1e-11) << gamma;
  }
}

TEST(Jonswap, MomentsAgreeWithPlainQuadrature) {
  for (const double gamma : {1.0, 3.3, 20.0}) {
    const Jonswap spectrum(2.0, 7.0, gamma);
    for (const int n : {-1, 1, 2})
      EXPECT_NEAR(plain_moment(spectrum, n) / spectrum.moment(n), 1.0, 1e-10) << gamma << " " << n;
  }
}

TEST(Jonswap, IsHighestAtThePeakPeriodAndEnhancedThereByGamma) {
  const double tp = 9.0, omega_p = 2 * std::numbers::pi / tp;
  const Jonswap spectrum(3.0, tp, 3.3);
  EXPECT_DOUBLE_EQ(spectrum.tp(), tp);
  for (const double off : {-0.01, -0.001, 0.001, 0.01})
    EXPECT_LT(spectrum.density(omega_p * (1 + off)), spectrum.density(omega_p)) << off;
  // (W6): far from the peak γ^r = 1, so the ratio to γ = 1 there is the ratio of the factors in front; at the peak γ
  // times it.
  const Jonswap plain(3.0, tp, 1.0);
  const double in_front = spectrum.density(3 * omega_p) / plain.density(3 * omega_p);
  EXPECT_NEAR(spectrum.density(omega_p) / plain.density(omega_p) / in_front, 3.3, 1e-14 * 3.3);
  // One σ away on either side: γ^{e^{−1/2}}.
  for (const double u : {1 - 0.07, 1 + 0.09})
    EXPECT_NEAR(spectrum.density(u * omega_p) / plain.density(u * omega_p) / in_front, std::pow(3.3, std::exp(-0.5)),
                1e-12);
}

TEST(Jonswap, EnergyOfBandsAddsUp) {
  const Jonswap spectrum(2.5, 8.0, 3.3);
  const double omega_p = 2 * std::numbers::pi / 8.0;
  double sum = 0;
  const int bands = 1000;
  for (int i = 0; i < bands; ++i) sum += spectrum.energy(4 * omega_p * i / bands, 4 * omega_p * (i + 1) / bands);
  // Bands of 0.004 ω_p: the promise for narrow bands is 1e-12 each.
  EXPECT_NEAR((sum + spectrum.energy(4 * omega_p, infinity)) / spectrum.moment(0), 1.0, 1e-12);
  EXPECT_DOUBLE_EQ(spectrum.energy(0, infinity), spectrum.moment(0));
  EXPECT_EQ(spectrum.energy(1, 1), 0.0);
  // A narrow band holds density times width; the next term is S″ width²/24 ~ 1e-5 of it.
  EXPECT_NEAR(spectrum.energy(0.999, 1.001) / (spectrum.density(1.0) * 0.002), 1.0, 1e-4);
}

TEST(PiersonMoskowitz, HasItsMomentsInClosedForm) {
  const double hs = 4.0, tp = 10.0, omega_p = 2 * std::numbers::pi / tp;
  const Jonswap spectrum = pierson_moskowitz(hs, tp);
  const double m0 = hs * hs / 16;
  EXPECT_DOUBLE_EQ(spectrum.moment(0), m0);
  EXPECT_NEAR(spectrum.moment(1), m0 * omega_p * std::pow(1.25, 0.25) * std::tgamma(0.75), 1e-14);  // (W7)
  EXPECT_NEAR(spectrum.moment(2), m0 * omega_p * omega_p * std::sqrt(1.25 * std::numbers::pi), 1e-14);
  EXPECT_NEAR(plain_moment(spectrum, 2) / spectrum.moment(2), 1.0, 1e-10);
  EXPECT_NEAR(spectrum.tz() / tp, std::pow(1.25 * std::numbers::pi, -0.25), 1e-14);  // 0.7104 Tp
  // The classical density, 5/16 Hs² ω_p⁴ ω⁻⁵ exp(−5/4 (ω_p/ω)⁴).
  const double w = 0.8;
  EXPECT_NEAR(spectrum.density(w),
              5.0 / 16 * hs * hs * std::pow(omega_p, 4) * std::pow(w, -5) * std::exp(-1.25 * std::pow(omega_p / w, 4)),
              1e-14);
}

TEST(Spectrum, SaysThatTheFourthMomentDiverges) {
  EXPECT_THAT([] { pierson_moskowitz(2, 8).moment(4); }, ThrowsMessage<InputError>(HasSubstr("m_4")));
  // It does: each decade of the tail adds the same amount, so the sum never settles.
  const Jonswap spectrum = pierson_moskowitz(2, 8);
  EXPECT_NEAR(std::pow(1e4, 5) * spectrum.density(1e4) / (std::pow(1e3, 5) * spectrum.density(1e3)), 1.0, 1e-10);
}

TEST(Spectrum, IsZeroAtAndNearZeroFrequency) {
  const Jonswap spectrum(2, 8, 3.3);
  EXPECT_EQ(spectrum.density(0), 0.0);
  EXPECT_EQ(spectrum.density(1e-80), 0.0);
  EXPECT_EQ(spectrum.energy(0, 1e-80), 0.0);
}

TEST(Spectrum, RefusesWhatIsNoSea) {
  EXPECT_THAT([] { Jonswap(0, 8, 3.3); },
              ThrowsMessage<InputError>(HasSubstr("significant wave height must be finite and positive, got 0 m")));
  EXPECT_THROW(Jonswap(-1, 8, 3.3), InputError);
  EXPECT_THROW(Jonswap(1, 0, 3.3), InputError);
  EXPECT_THROW(Jonswap(1, infinity, 3.3), InputError);
  EXPECT_THAT([] { Jonswap(1, 8, 0.9); }, ThrowsMessage<InputError>(HasSubstr("between 1 and 20, got 0.9")));
  EXPECT_THROW(Jonswap(1, 8, 21), InputError);
  EXPECT_THROW(Jonswap(1, 8, std::nan("")), InputError);
  EXPECT_THROW(Jonswap(1, 8, 2).density(-1), InputError);
  EXPECT_THROW(Jonswap(1, 8, 2).energy(2, 1), InputError);
}

}  // namespace
}  // namespace hydro::waves::spectrum_test
