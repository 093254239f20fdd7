#include "hydro/waves/spectra/statistics.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/base/random.hpp"
#include "hydro/waves/spectra/spectra.hpp"

namespace hydro::waves::statistics_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double pi = std::numbers::pi;

TEST(SeaNumbers, AreThoseOfTheHandbook) {
  const Jonswap spectrum(8.2, 11.7, 3.3);
  const SeaNumbers deep = sea_numbers(spectrum, {.gravity = 9.81});
  EXPECT_NEAR(deep.peak_wavelength_m, 9.81 * 11.7 * 11.7 / (2 * pi), 1e-11);
  EXPECT_NEAR(deep.peak_steepness, 8.2 / deep.peak_wavelength_m, 1e-15);
  EXPECT_NEAR(deep.crossing_steepness, 2 * pi * 8.2 / (9.81 * spectrum.tz() * spectrum.tz()), 1e-14);
  EXPECT_EQ(deep.ursell, 0);
  EXPECT_TRUE(std::isinf(deep.relative_depth));
  // ω² = gk tanh kh at the peak.
  const SeaNumbers shelf = sea_numbers(spectrum, {.gravity = 9.81, .depth = WaterDepth::from_metres(30)});
  const double omega = 2 * pi / 11.7, k = shelf.relative_depth / 30;
  EXPECT_NEAR(9.81 * k * std::tanh(shelf.relative_depth), omega * omega, 1e-13);
  EXPECT_NEAR(shelf.ursell, 8.2 * std::pow(2 * pi / k, 2) / 27000, 1e-12);
  EXPECT_EQ(depth_regime(shelf.relative_depth), DepthRegime::intermediate);
}

TEST(DepthRegime, ChangesAtHalfAndATwentiethOfAWavelength) {
  EXPECT_EQ(depth_regime(3.15), DepthRegime::deep);
  EXPECT_EQ(depth_regime(3.13), DepthRegime::intermediate);
  EXPECT_EQ(depth_regime(0.315), DepthRegime::intermediate);
  EXPECT_EQ(depth_regime(0.313), DepthRegime::shallow);
  EXPECT_EQ(depth_regime(std::numeric_limits<double>::infinity()), DepthRegime::deep);
}

TEST(SpectralWidth, IsThatOfKnownShapes) {
  // (W48) of Pierson–Moskowitz: m_0 m_2/m_1² = √π/Γ(3/4)², ν = 0.4247.
  const double nu = std::sqrt(std::sqrt(pi) / std::pow(std::tgamma(0.75), 2) - 1);
  EXPECT_NEAR(narrowness(pierson_moskowitz(2, 8)), nu, 1e-12);
  // A narrow hump: ν = σ/ω_p, ε = 2 σ/ω_p to second order.
  const double omega = 2 * pi / 12;
  const GaussianSwell swell(1, 12, 0.01 * omega);
  EXPECT_NEAR(narrowness(swell), 0.01, 1e-9);
  EXPECT_NEAR(broadness(swell, 10), 0.02, 1e-5);
  // With a tail ω^−5 it grows towards 1 with the limit.
  const Jonswap wind(2, 8, 1);
  EXPECT_LT(broadness(wind, 3), broadness(wind, 30));
  EXPECT_LT(broadness(wind, 30), 1);
}

TEST(HighestWave, HasRayleighsMeanForOneWave) {
  EXPECT_NEAR(expected_highest(4, 1), 4 * std::sqrt(pi / 8), 1e-12);
  EXPECT_NEAR(most_probable_highest(4, 1), 2, 1e-12);                                     // Rayleigh's mode
  EXPECT_NEAR(highest_not_exceeded(4, 1, 0.5), 4 * std::sqrt(0.5 * std::log(2)), 1e-13);  // and median
  // Two waves: E = 2 E_1 − E_1/√2.
  EXPECT_NEAR(expected_highest(4, 2), 4 * std::sqrt(pi / 8) * (2 - std::sqrt(0.5)), 1e-12);
}

TEST(HighestWave, FollowsItsAsymptoteForMany) {
  for (const double n : {1e3, 1e5}) {
    const double mode = std::sqrt(0.5 * std::log(n));
    EXPECT_NEAR(most_probable_highest(1, n) / mode, 1, 1 / (std::log(n) * std::log(n)));
    // Longuet-Higgins 1952: √(½ ln n) (1 + γ_E/(2 ln n)), the next term is of order ln^−2.
    EXPECT_NEAR(expected_highest(1, n) / mode, 1 + 0.5772156649 / (2 * std::log(n)), 1 / (std::log(n) * std::log(n)));
  }
}

TEST(HighestWave, IsWhatDrawingGives) {
  const RandomStream stream(7, 1);
  const int trials = 4000, waves = 50;
  double sum = 0, below = 0;
  const double median = highest_not_exceeded(2, waves, 0.5);
  for (int t = 0; t < trials; ++t) {
    double highest = 0;
    for (int i = 0; i < waves; ++i)
      highest = std::max(highest,
                         2 * std::sqrt(-0.5 * std::log1p(-stream.uniform(static_cast<std::uint64_t>(t * waves + i)))));
    sum += highest;
    below += highest < median;
  }
  // The highest scatters by 0.3 m; four standard errors of the mean, and of a share of a half.
  EXPECT_NEAR(sum / trials, expected_highest(2, waves), 4 * 0.35 / std::sqrt(trials));
  EXPECT_NEAR(below / trials, 0.5, 4 * 0.5 / std::sqrt(trials));
}

TEST(SeaStatistics, RefuseWhatIsNoSea) {
  EXPECT_THAT([] { expected_highest(0, 10); }, ThrowsMessage<InputError>(HasSubstr("got 0 m")));
  EXPECT_THROW(expected_highest(1, 0.5), InputError);
  EXPECT_THROW(most_probable_highest(1, std::nan("")), InputError);
  EXPECT_THROW(highest_not_exceeded(1, 10, 1), InputError);
  EXPECT_THROW(ursell_number(0, 10, WaterDepth::infinite()), InputError);
  EXPECT_THROW(depth_regime(0), InputError);
  EXPECT_THROW(broadness(Jonswap(1, 8, 1), 0), InputError);
  EXPECT_THROW(broadness(Jonswap(1, 8, 1), 0.001), InputError);
  EXPECT_THROW(number_of_waves(Jonswap(1, 8, 1), -1), InputError);
  EXPECT_NEAR(number_of_waves(bretschneider(1, ZeroCrossingPeriod{5}), 3600), 720, 1e-9);
}

}  // namespace
}  // namespace hydro::waves::statistics_test
