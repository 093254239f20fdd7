#include "hydro/waves/dispersion.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace hydro::waves::dispersion_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Water water_of_depth(double h) { return {.density = 1025, .gravity = 9.81, .depth = WaterDepth::from_metres(h)}; }

// The law itself, in long double, so that its own rounding does not hide ours: ω²/(g k tanh kh) − 1.
double residual(double omega, double k, double h) {
  const long double w = omega, kk = k;
  return static_cast<double>(w * w / (9.81 * kk * std::tanh(kk * static_cast<long double>(h))) - 1.0L);
}

TEST(Dispersion, HoldsFromVeryLongToVeryShortWaves) {
  for (const double h : {0.7, 14.0, 4000.0})
    for (double log_kh = -6; log_kh <= 3; log_kh += 0.0137) {
      const double wanted_k = std::pow(10, log_kh) / h;
      const double omega = std::sqrt(9.81 * wanted_k * std::tanh(wanted_k * h));
      const double k = wavenumber(omega, water_of_depth(h));
      EXPECT_LT(std::abs(residual(omega, k, h)), 1e-15)
          << "kh = " << k * h;  // (W1); one rounding of k counts at most twice
    }
}

TEST(Dispersion, ExplicitStartIsWithinItsStatedError) {
  // (W2), written out again: what the three Newton steps start from.
  constexpr double beta = 2.4908;
  double worst = 0;
  for (double log_kh = -6; log_kh <= 3; log_kh += 0.001) {
    const double kh = std::pow(10, log_kh), X = kh * std::tanh(kh);
    worst = std::max(worst, std::abs(X * std::pow(-std::expm1(-std::pow(X, beta / 2)), -1 / beta) / kh - 1));
  }
  EXPECT_LT(worst, 0.008);  // printed in dispersion.hpp
  EXPECT_GT(worst, 0.005);  // and not much better, so the statement stays honest
}

TEST(Dispersion, IsExactInInfinitelyDeepWater) {
  const Water deep{.density = 1025, .gravity = 9.81, .depth = WaterDepth::infinite()};
  EXPECT_DOUBLE_EQ(wavenumber(1.3, deep), 1.3 * 1.3 / 9.81);
  EXPECT_DOUBLE_EQ(angular_frequency(0.2, deep), std::sqrt(9.81 * 0.2));
  EXPECT_DOUBLE_EQ(group_velocity(1.3, deep), phase_velocity(1.3, deep) / 2);
  EXPECT_DOUBLE_EQ(wavenumber(1.3, water_of_depth(1e5)), wavenumber(1.3, deep));
}

TEST(Dispersion, TendsToTheShallowWaterSpeedForBothVelocities) {
  const Water shallow = water_of_depth(2.0);
  const double omega = 1e-4, c = std::sqrt(9.81 * 2.0);  // kh = 4.5e-5; c_p/c − 1 = −(kh)²/6, c_g/c − 1 = −(kh)²/2
  EXPECT_NEAR(phase_velocity(omega, shallow) / c, 1.0, 1e-9);
  EXPECT_NEAR(group_velocity(omega, shallow) / c, 1.0, 1.1e-9);
}

TEST(Dispersion, FrequencyOfAWavenumberIsItsInverse) {
  for (const double h : {0.1, 3.0, 250.0})
    for (const double omega : {0.01, 0.3, 1.0, 7.0}) {
      const Water water = water_of_depth(h);
      EXPECT_NEAR(angular_frequency(wavenumber(omega, water), water) / omega, 1.0, 1e-15) << h << " " << omega;
    }
}

TEST(Dispersion, GroupVelocityIsTheSlopeOfFrequencyOverWavenumber) {
  for (const double h : {0.5, 5.0, 50.0})
    for (const double omega : {0.2, 0.8, 2.5}) {
      const Water water = water_of_depth(h);
      const double k = wavenumber(omega, water), d = 1e-3 * k;
      const auto w = [&](double kk) { return angular_frequency(kk, water); };
      // (W4) against a five-point difference: error (d/k)⁴ ~ 1e-12 plus rounding 1e-16/1e-3.
      const double slope = (8 * (w(k + d) - w(k - d)) - (w(k + 2 * d) - w(k - 2 * d))) / (12 * d);
      EXPECT_NEAR(group_velocity(omega, water) / slope, 1.0, 5e-12) << "h = " << h << ", omega = " << omega;
    }
}

TEST(Dispersion, KnowsThatATankIsNotDeepSea) {
  // A tank of 14 m (full scale) shortens a wave of 8 s from 99.9 m to 79.98 m, one of 5 s to 38.25 m: known to the
  // digits given.
  const double two_pi = 2 * std::numbers::pi;
  EXPECT_NEAR(two_pi / wavenumber(two_pi / 8, water_of_depth(14)), 79.98, 0.005);
  EXPECT_NEAR(two_pi / wavenumber(two_pi / 5, water_of_depth(14)), 38.25, 0.005);
}

TEST(Dispersion, RefusesWhatIsNoWave) {
  const Water water = water_of_depth(10);
  EXPECT_THAT([&] { wavenumber(0, water); }, ThrowsMessage<InputError>(HasSubstr("finite and positive, got 0 rad/s")));
  EXPECT_THROW(wavenumber(-1, water), InputError);
  EXPECT_THROW(wavenumber(std::nan(""), water), InputError);
  EXPECT_THROW(angular_frequency(-0.1, water), InputError);
  EXPECT_THROW(water_of_depth(0), InputError);
  EXPECT_THROW(water_of_depth(-3), InputError);
  EXPECT_THAT([] { wavenumber(1, {.gravity = -9.81}); }, ThrowsMessage<InputError>(HasSubstr("gravity")));
}

}  // namespace
}  // namespace hydro::waves::dispersion_test
