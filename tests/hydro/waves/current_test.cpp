#include "hydro/waves/kinematics/current.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "hydro/waves/dispersion.hpp"

namespace hydro::waves::current_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double g = 9.81;
const Water deep{.density = 1025, .gravity = g};
Water depth(double h) { return {.density = 1025, .gravity = g, .depth = WaterDepth::from_metres(h)}; }
const Angle ahead = Angle::from_radians(0);

TEST(Doppler, MeetsItsOwnRelationAtEveryDepthAndHeading) {
  for (const double h : {0.5, 10.0, 500.0})
    for (const double omega : {0.3, 1.0, 2.0})
      for (const double degrees : {0.0, 60.0, 90.0, 150.0}) {
        const Current current = Current::uniform({0.9, 0});
        const DopplerWave w = doppler(omega, Angle::from_degrees(degrees), current, depth(h));
        const double U = 0.9 * std::cos(degrees * std::numbers::pi / 180);
        EXPECT_NEAR((w.sigma + w.k * U) / omega, 1, 1e-13) << h << ' ' << omega << ' ' << degrees;
        EXPECT_NEAR(w.sigma * w.sigma / (g * w.k * std::tanh(w.k * h)), 1, 1e-13);
      }
}

TEST(Doppler, IsTheStillWaterWaveWithoutACurrentAndAcrossOne) {
  const double k = wavenumber(1.1, deep);
  EXPECT_EQ(doppler(1.1, ahead, Current::none(), deep).k, k);
  EXPECT_EQ(doppler(1.1, ahead, Current::none(), deep).sigma, 1.1);
  const DopplerWave across = doppler(1.1, Angle::from_degrees(90), Current::uniform({2, 0}), deep);
  EXPECT_NEAR(across.k / k, 1, 1e-13);  // cos 90° leaves 1e-16 of the current
}

TEST(Doppler, HasItsClosedFormInDeepWater) {
  // ω = √(gk) + kU: √k from the quadratic equation, the root that tends to still water.
  for (const double U : {-1.5, -0.5, 0.5, 3.0}) {
    const double omega = 1.3;
    const double root = (-std::sqrt(g) + std::sqrt(g + 4 * U * omega)) / (2 * U);
    EXPECT_NEAR(doppler(omega, ahead, Current::uniform({U, 0}), deep).k / (root * root), 1, 1e-12) << U;
  }
}

TEST(Doppler, SaysWhichWavesACurrentStops) {
  // In deep water the strongest opposing current that a wave can run up is g/(4ω) (W20).
  const double omega = 1.3, limit = g / (4 * omega);
  EXPECT_NO_THROW(doppler(omega, ahead, Current::uniform({-0.99 * limit, 0}), deep));
  EXPECT_THAT(
      [&] {
        doppler(omega, ahead, Current::uniform({-1.01 * limit, 0}), deep);
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("stops waves of 4.833 s"), HasSubstr("4.882 s"))));
}

TEST(CurrentProfile, IsTheUniformOneWhereItDoesNotVary) {
  const Current profile = Current::profile({-30, -10, 0}, {{1, 2}, {1, 2}, {1, 2}});
  EXPECT_NEAR(profile.felt_by(0.1, Angle::from_degrees(30), 40),
              Current::uniform({1, 2}).felt_by(0.1, Angle::from_degrees(30), 40), 1e-15);
}

TEST(CurrentProfile, ShortWavesFeelTheSurfaceAndLongOnesTheMean) {
  const Current profile = Current::profile({-20, 0}, {{0, 0}, {2, 0}});
  EXPECT_NEAR(profile.felt_by(50, ahead, 20), 2 - 2 / 20.0 / (2 * 50), 1e-12);  // U(0) − U′/2k, the rest e^{−2kh}
  EXPECT_NEAR(profile.felt_by(1e-5, ahead, 20), 1, 1e-6);                       // next term (kh)²
}

TEST(CurrentProfile, AgreesWithPlainQuadratureOfItsIntegral) {
  const Current profile = Current::profile({-18, -7, -2, 0}, {{0.1, 0}, {0.8, 0}, {0.3, 0}, {1.4, 0}});
  const double k = 0.13, h = 25;
  // (W21) by the midpoint rule, 4e5 strips: error (kΔz)² ~ 1e-10.
  const int strips = 400000;
  double sum = 0;
  for (int i = 0; i < strips; ++i) {
    const double z = -h + h * (i + 0.5) / strips;
    sum += profile.at(z).x() * std::cosh(2 * k * (z + h)) * h / strips;
  }
  EXPECT_NEAR(profile.felt_by(k, ahead, h), 2 * k / std::sinh(2 * k * h) * sum, 1e-9);
}

TEST(CurrentProfile, IsRightToFirstOrderInAShear) {
  // (W22): the exact wave of constant shear. Halving the shear must divide the error of k by four.
  const double omega = 1.0, h = 12, U0 = 0.3;
  const auto error = [&](double S) {
    const Current profile = Current::profile({-h, 0}, {{U0 - S * h, 0}, {U0, 0}});
    const double k = doppler(omega, ahead, profile, depth(h)).k;
    const auto exact = [&](double q) {
      const double sigma = omega - q * U0;
      return sigma * sigma - (g * q - S * sigma) * std::tanh(q * h);
    };
    double low = 0.5 * k, high = 1.5 * k;
    for (int i = 0; i < 100; ++i) ((exact(0.5 * (low + high)) > 0) ? low : high) = 0.5 * (low + high);
    return std::abs(k / low - 1);
  };
  EXPECT_LT(error(0.02), 2e-4);  // (S/σ)² = 4e-4
  EXPECT_NEAR(error(0.02) / error(0.01), 4, 0.4);
}

TEST(CurrentProfile, RefusesWhatIsNoProfile) {
  EXPECT_THAT(
      [] {
        Current::profile({0, -10}, {{1, 0}, {1, 0}});
      },
      ThrowsMessage<InputError>(HasSubstr("must increase")));
  EXPECT_THAT(
      [] {
        Current::profile({-10, 1}, {{1, 0}, {1, 0}});
      },
      ThrowsMessage<InputError>(HasSubstr("still water")));
  EXPECT_THROW(Current::profile({-10, 0}, {{1, 0}}), InputError);
  EXPECT_THROW(Current::profile({-10}, {{1, 0}}), InputError);
  EXPECT_THROW(Current::uniform({std::nan(""), 0}), InputError);
}

}  // namespace
}  // namespace hydro::waves::current_test
