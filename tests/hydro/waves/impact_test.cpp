#include "hydro/waves/kinematics/impact.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/base/error.hpp"

namespace hydro::waves::impact_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double pi = std::numbers::pi;
constexpr double R = 0.06, V = 1.4, rho = 1000, unit = rho * R * V * V;
const CylinderImpact wienke(ImpactTheory::wienke_oumeraci, R, V, rho);
const CylinderImpact goda(ImpactTheory::goda, R, V, rho);
const CylinderImpact von_karman(ImpactTheory::von_karman, R, V, rho);

TEST(Wetness, RisesWithTheSurfaceOverTheDiameter) {
  EXPECT_EQ(wetness_by_height(-0.61, -0.5, 0.2), 0);
  EXPECT_NEAR(wetness_by_height(-0.55, -0.5, 0.2), 0.25, 1e-15);
  EXPECT_NEAR(wetness_by_height(-0.5, -0.5, 0.2), 0.5, 1e-15);
  EXPECT_EQ(wetness_by_height(-0.3, -0.5, 0.2), 1);
}

TEST(Wetness, ExactAreaIsTheIntegralOfTheChord) {
  double area = 0;  // midpoint rule; the square root at the ends limits it to n^-3/2
  const int n = 4000;
  for (int m = 0; m < n; ++m) {
    const double z = -0.1 + 0.2 * (m + 0.5) / n;
    area += wet_circle(z, 0, 0.2).chord * 0.2 / n;
    EXPECT_NEAR(wet_circle(z + 0.1 / n, 0, 0.2).area_share * pi * 0.01, area, 1e-7);
  }
  EXPECT_NEAR(area, pi * 0.01, 1e-7);
}

TEST(Wetness, ExactFormsAgreeWithTheDiameterWhereTheyMust) {
  EXPECT_NEAR(wet_circle(3, 3, 0.2).area_share, 0.5, 1e-15);
  EXPECT_NEAR(wet_circle(3, 3, 0.2).arc_share, 0.5, 1e-15);
  EXPECT_NEAR(wet_circle(3, 3, 0.2).chord, 0.2, 1e-15);
  EXPECT_EQ(wet_circle(4, 3, 0.2).area_share, 1);
  EXPECT_EQ(wet_circle(2, 3, 0.2).area_share, 0);
  EXPECT_NEAR(wet_circle(0.05, 0, 0.2).arc_share, 2.0 / 3, 1e-15);  // surface at half a radius: 240 of 360 degrees
}

TEST(Impact, BeginsWithTheLimitAtContact) {
  EXPECT_DOUBLE_EQ(wienke.force(0), 2 * pi * unit);
  EXPECT_DOUBLE_EQ(goda.force(0), pi * unit);
  EXPECT_DOUBLE_EQ(von_karman.force(0), pi * unit);
  for (const double t : {1e-300, 1e-30, 1e-20, 1e-16, 1e-12}) {  // no jump, no NaN, no infinity
    const double root = std::sqrt(V * t / R);  // artanh √(1 − x) → ln(2/√x) from below, here x = τ/4
    EXPECT_NEAR(wienke.force(t), 2 * pi * unit, unit * (2 * root * std::log(4.001 / root) + 1e-14)) << t;
  }
}

TEST(Impact, IsZeroBeforeContactAndAfterItsDuration) {
  for (const CylinderImpact& impact : {wienke, goda, von_karman}) {
    EXPECT_EQ(impact.force(-1e-9), 0);
    EXPECT_EQ(impact.impulse(-1), 0);
    EXPECT_EQ(impact.force(impact.duration() * 1.0001), 0);
    EXPECT_EQ(impact.impulse(impact.duration() * 2), impact.impulse(impact.duration()));
    EXPECT_GT(impact.force(0.99 * impact.duration()), 0);
  }
  EXPECT_DOUBLE_EQ(wienke.duration(), 13.0 / 32 * R / V);
  EXPECT_DOUBLE_EQ(goda.duration(), R / V);
}

TEST(Impact, WettedWidthOfWienkeIsContinuousAndEndsAtTheRadius) {
  const double t = R / (8 * V);
  EXPECT_NEAR(wienke.half_width(t * (1 + 1e-13)) / wienke.half_width(t), 1, 1e-12);
  EXPECT_NEAR(wienke.half_width(t), R / std::sqrt(2), 1e-15);
  EXPECT_NEAR(wienke.half_width(wienke.duration()), R, 1e-15);
  EXPECT_NEAR(von_karman.half_width(von_karman.duration()), R, 1e-15);
}

TEST(Impact, ForceOfWienkeDropsAtTheSwitchWithTheRateOfTheWidth) {
  // (W85): c is continuous, dc/dt is not (2.83 V before, 1.89 V after), so the force of the published branches falls
  // from 4.573 to 2.773 ρRV². Both from the formulas by hand.
  const double t = R / (8 * V);
  EXPECT_NEAR(wienke.force(t) / unit, 2 * pi - std::sqrt(0.5) * std::atanh(std::sqrt(31.0 / 32)), 1e-12);
  EXPECT_NEAR(wienke.force(t * (1 + 1e-13)) / unit, 4 * pi / 3 - std::sqrt(0.5) * std::atanh(std::sqrt(1 - 9.0 / 128)),
              1e-10);
}

TEST(Impact, BothBranchesAreOneLawOfTheWettedWidth) {
  // (W84): F = ρV (π c ċ − V c artanh √(1 − (V/2ċ)²)), with ċ differenced; step 1e-4 of the time gives about 1e-8.
  for (const double tau : {0.01, 0.05, 0.12, 0.13, 0.2, 0.4}) {
    const double t = tau * R / V, d = 1e-4 * t, c = wienke.half_width(t);
    const double rate = (wienke.half_width(t + d) - wienke.half_width(t - d)) / (2 * d);
    const double law = rho * V * (pi * c * rate - V * c * std::atanh(std::sqrt(1 - std::pow(V / (2 * rate), 2))));
    EXPECT_NEAR(wienke.force(t) / law, 1, 1e-6) << tau;
  }
}

TEST(Impact, VonKarmanIsTheRateOfTheAddedMass) {
  for (const double tau : {0.1, 0.5, 0.9}) {
    const double t = tau * R / V, d = 1e-5 * t;
    const auto momentum = [&](double at) { return 0.5 * pi * rho * std::pow(von_karman.half_width(at), 2) * V; };
    EXPECT_NEAR(von_karman.force(t), (momentum(t + d) - momentum(t - d)) / (2 * d), 1e-8 * unit);
    EXPECT_NEAR(von_karman.impulse(t), momentum(t), 1e-13 * unit * R / V);
    EXPECT_EQ(goda.force(t), von_karman.force(t));
  }
}

TEST(Impact, ImpulseIsTheIntegralOfTheForce) {
  // Trapezium in s with t = s² (the force has a √t ln t at contact), each branch by itself; error about 1/n².
  const auto integral = [](const CylinderImpact& impact, double from, double to) {
    const int n = 20000;
    double sum = 0;
    const double a = std::sqrt(from), b = std::sqrt(to), ds = (b - a) / n;
    for (int m = 0; m < n; ++m) {
      const double s = a + (m + 0.5) * ds;
      sum += impact.force(s * s) * 2 * s * ds;
    }
    return sum;
  };
  const double change = R / (8 * V), end = wienke.duration();
  EXPECT_NEAR(wienke.impulse(change) / integral(wienke, 0, change), 1, 1e-8);
  EXPECT_NEAR(wienke.impulse(end) / (integral(wienke, 0, change) + integral(wienke, change, end)), 1, 1e-8);
  EXPECT_NEAR(wienke.impulse(0.3 * change) / integral(wienke, 0, 0.3 * change), 1, 1e-8);
  EXPECT_NEAR(goda.impulse(1) / (0.5 * pi * unit * R / V), 1, 1e-14);
}

TEST(Impact, ScalesAsItMust) {
  const CylinderImpact larger(ImpactTheory::wienke_oumeraci, 3 * R, 2 * V, rho);
  EXPECT_NEAR(larger.force(1.5e-3) / wienke.force(1e-3), 12, 1e-12);  // same Vt/R, R V² twelvefold
  const CylinderImpact still(ImpactTheory::wienke_oumeraci, R, 0, rho);
  EXPECT_EQ(still.force(1), 0);
  EXPECT_EQ(still.impulse(1), 0);
  EXPECT_EQ(still.duration(), std::numeric_limits<double>::infinity());
}

TEST(Impact, RefusesWhatIsNoImpact) {
  const auto make = [](double r, double v, double d) { return [=] { CylinderImpact(ImpactTheory::goda, r, v, d); }; };
  EXPECT_THAT(make(0, 1, 1000), ThrowsMessage<InputError>(HasSubstr("radius")));
  EXPECT_THAT(make(1, -1, 1000), ThrowsMessage<InputError>(HasSubstr("speed of an impact")));
  EXPECT_THAT(make(1, 1, 0), ThrowsMessage<InputError>(HasSubstr("density")));
  EXPECT_THAT([] { (void)goda.force(std::nan("")); }, ThrowsMessage<InputError>(HasSubstr("time since contact")));
  EXPECT_THAT([] { (void)wetness_by_height(0, 0, 0); }, ThrowsMessage<InputError>(HasSubstr("diameter")));
  EXPECT_THAT([] { (void)wet_circle(std::nan(""), 0, 1); }, ThrowsMessage<InputError>(HasSubstr("surface")));
}

}  // namespace
}  // namespace hydro::waves::impact_test
