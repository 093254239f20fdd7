#include "hydro/waves/spectra/spreading.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>

namespace hydro::waves::spreading_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double pi = std::numbers::pi;

struct Named {
  std::string name;
  std::shared_ptr<const Spreading> spreading;
  double first_harmonic;  ///< in closed form
};

template <class S>
Named named(std::string name, S spreading, double r) {
  return {std::move(name), std::make_shared<const S>(std::move(spreading)), r};
}

Cos2sSpreading cos2s(double s) { return Cos2sSpreading(SpreadingExponent::constant(s)); }

TabulatedSpreading triangle() { return {{-0.8, 0, 0.8}, {0, 1.25, 0}}; }

std::vector<Named> one_of_each() {
  const auto cos_n_r = [](double n) {  // ∫ cos^{n+1}/∫ cos^n
    return std::exp(2 * std::lgamma(n / 2 + 1) - std::lgamma((n + 1) / 2) - std::lgamma((n + 3) / 2));
  };
  return {named("cos2s, s = 0", cos2s(0), 0),
          named("cos2s, s = 0.3", cos2s(0.3), 0.3 / 1.3),
          named("cos2s, s = 10", cos2s(10), 10.0 / 11),
          named("cos2s, s = 3000", cos2s(3000), 3000.0 / 3001),
          named("Mitsuyasu", Cos2sSpreading(SpreadingExponent::goda(25, 0.9)),
                25 * std::pow(1 / 0.9, -2.5) / (1 + 25 * std::pow(1 / 0.9, -2.5))),
          named("cos^n, n = 0", CosNSpreading(0), 2 / pi),
          named("cos^n, n = 2", CosNSpreading(2), cos_n_r(2)),
          named("cos^n, n = 51.5", CosNSpreading(51.5), cos_n_r(51.5)),
          named("wrapped normal, 0.01", WrappedNormalSpreading(Angle::from_radians(0.01)), std::exp(-0.5e-4)),
          named("wrapped normal, 0.5", WrappedNormalSpreading(Angle::from_radians(0.5)), std::exp(-0.125)),
          named("wrapped normal, 3", WrappedNormalSpreading(Angle::from_radians(3)), std::exp(-4.5)),
          named("von Mises, 0", VonMisesSpreading(0), 0),
          named("von Mises, 2", VonMisesSpreading(2), std::cyl_bessel_i(1, 2.0) / std::cyl_bessel_i(0, 2.0)),
          named("von Mises, 200", VonMisesSpreading(200), std::cyl_bessel_i(1, 200.0) / std::cyl_bessel_i(0, 200.0)),
          named("table", triangle(), 2 * (1 - std::cos(0.8)) / (0.8 * 0.8))};
}

double density(const Spreading& s, double theta) { return s.density(Angle::from_radians(theta), 1.0); }
double share(const Spreading& s, double theta) { return s.share_below(Angle::from_radians(theta), 1.0); }

// Slow and plain: midpoint rule between the quantiles' neighbourhood, fine enough for the narrowest (0.01 rad).
double plain_share(const Spreading& s, double from, double to) {
  const int intervals = 200'000;
  double sum = 0;
  for (int i = 0; i < intervals; ++i) sum += density(s, from + (to - from) * (i + 0.5) / intervals);
  return sum * (to - from) / intervals;
}

TEST(EverySpreading, IntegratesToOneAndItsShareIsItsIntegral) {
  for (const Named& n : one_of_each()) {
    const Spreading& s = *n.spreading;
    EXPECT_NEAR(share(s, -pi), 0, 1e-14) << n.name;
    EXPECT_NEAR(share(s, pi), 1, 1e-14) << n.name;
    // Midpoint rule: h²/24 [D′] with h <= 8e-6 rad where D′ is below 3 or alike at both ends, and 4e-7 where it is 1e3.
    // A power 2s < 1 of the distance to ±π costs h^{1 + 2s}; a jump at ±π/2 nothing, since an interval ends there.
    const double limit = n.name == "cos2s, s = 0.3" ? 1e-7 : 1e-10;
    double sum = 0, from = -pi;
    for (const double to : {-pi / 2, -0.3, 0.0, 0.02, 0.1, 1.1, pi / 2, pi}) {
      sum += plain_share(s, from, to);
      from = to;
      EXPECT_NEAR(share(s, to), sum, limit) << n.name << " below " << to;
    }
  }
}

TEST(EverySpreading, FindsTheAngleThatHasAShareBelowIt) {
  for (const Named& n : one_of_each())
    for (const double wanted : {1e-9, 0.01, 0.3, 0.5, 0.77, 0.999, 1 - 1e-9}) {
      const Angle theta = n.spreading->quantile(wanted, 1.0);
      // The share's own rounding for the sharpest here (lgamma of 6000: 5e4 · 1e-16 · a few), and 1e-15 of θ times D
      // <= 40.
      EXPECT_NEAR(n.spreading->share_below(theta, 1.0), wanted, 3e-11) << n.name << " " << wanted;
    }
}

TEST(EverySpreading, HasTheFirstHarmonicOfItsDensity) {
  for (const Named& n : one_of_each()) {
    EXPECT_NEAR(n.spreading->first_harmonic(1.0), n.first_harmonic, 1e-12) << n.name;
    // By parts from the share, which other tests hold: ∫ D cos θ = −1 + ∫ P sin θ, Simpson's rule.
    const int intervals = 20'000;
    double sum = 0;
    for (int i = 1; i < intervals; ++i) {
      const double theta = -pi + 2 * pi * i / intervals;
      sum += (i % 2 == 1 ? 4 : 2) * share(*n.spreading, theta) * std::sin(theta);
    }
    // Kinks of P cost h² of their slope, 1e-7 · 0.3; P of the narrowest is resolved by 30 points.
    EXPECT_NEAR(n.spreading->first_harmonic(1.0), -1 + sum * 2 * pi / (3.0 * intervals), 1e-7) << n.name;
    EXPECT_NEAR(n.spreading->width(1.0).radians(), std::sqrt(2 * (1 - n.first_harmonic)), 1e-9) << n.name;
  }
}

TEST(EverySpreading, IsPeriodicAndSymmetric) {
  for (const Named& n : one_of_each())
    for (const double theta : {0.01, 0.4, 2.9}) {
      const double at = density(*n.spreading, theta);
      EXPECT_NEAR(density(*n.spreading, theta + 2 * pi), at, 1e-9 * (1 + at)) << n.name;
      EXPECT_NEAR(density(*n.spreading, -theta), at, 1e-13 * (1 + at)) << n.name;
      EXPECT_NEAR(share(*n.spreading, -theta) + share(*n.spreading, theta), 1, 1e-10) << n.name;
    }
}

TEST(Cos2sSpreading, HasTheFactorThatHandbooksPrint) {
  // 2^{2s−1} Γ(s+1)²/(π Γ(2s+1)), here for s = 1 (1/π) and 10.
  EXPECT_NEAR(density(cos2s(1), 0), 1 / pi, 1e-14);
  EXPECT_NEAR(density(cos2s(10), 0), std::pow(2, 19) * std::pow(std::tgamma(11), 2) / (pi * std::tgamma(21)), 1e-13);
  EXPECT_NEAR(density(CosNSpreading(2), 0.3), 2 / pi * std::pow(std::cos(0.3), 2), 1e-14);
  EXPECT_NEAR(share(CosNSpreading(2), 0.3), 0.5 + (0.3 + 0.5 * std::sin(0.6)) / pi, 1e-12);
}

TEST(SpreadingExponent, IsLargestAtThePeakAndFallsOnBothSides) {
  const auto s = SpreadingExponent::goda(75, 0.5);
  EXPECT_DOUBLE_EQ(s.at(0.5), 75);
  EXPECT_DOUBLE_EQ(s.at(0.25), 75.0 / 32);
  EXPECT_DOUBLE_EQ(s.at(2.0), 75.0 / 32);
  // ω_p U/g = 1 leaves the factor.
  EXPECT_NEAR(SpreadingExponent::mitsuyasu(9.81, 1, 9.81).at(1), 11.5, 1e-13);
  EXPECT_NEAR(SpreadingExponent::mitsuyasu(19.62, 1, 9.81).at(1), 11.5 / std::pow(2, 2.5), 1e-13);
}

TEST(WrappedNormalSpreading, IsItsFourierSeries) {
  for (const double sigma : {0.5, 1.5, 4.0}) {
    const WrappedNormalSpreading spreading(Angle::from_radians(sigma));
    for (const double theta : {-3.0, 0.0, 1.2}) {
      double series = 0.5;
      for (int k = 1; k < 40; ++k) series += std::exp(-k * k * sigma * sigma / 2) * std::cos(k * theta);
      EXPECT_NEAR(density(spreading, theta), series / pi, 1e-14) << sigma << " " << theta;
    }
  }
}

TEST(VonMisesSpreading, HasBesselsFactor) {
  for (const double kappa : {0.5, 7.0, 80.0})
    EXPECT_NEAR(density(VonMisesSpreading(kappa), 0.2),
                std::exp(kappa * std::cos(0.2)) / (2 * pi * std::cyl_bessel_i(0, kappa)), 1e-12);
  // Narrow: a normal distribution with σ² = 1/κ, but for 1/κ of it.
  EXPECT_NEAR(share(VonMisesSpreading(1e6), 1e-3), 0.5 * std::erfc(-1 / std::numbers::sqrt2), 1e-6);
}

TEST(TabulatedSpreading, MayLeanToOneSide) {
  // A uniform 1 rad between 0.5 and 1.5: r_1 = 2 sin ½, whatever the mean.
  EXPECT_NEAR(TabulatedSpreading({0.5, 1.5}, {1, 1}).first_harmonic(1), 2 * std::sin(0.5), 1e-14);
}

TEST(TabulatedSpreading, IsNormalisedWithinAThousandthAndSaysSo) {
  const TabulatedSpreading spreading({-0.8, 0, 0.8}, {0, 1.2505, 0});
  EXPECT_NEAR(spreading.raw_integral(), 1.0004, 1e-12);
  EXPECT_NEAR(share(spreading, pi), 1, 1e-15);
  EXPECT_NEAR(density(spreading, 0), 1.25, 1e-13);
  EXPECT_THAT(
      [] {
        TabulatedSpreading({-0.8, 0, 0.8}, {0, 1.26, 0});
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("must integrate to 1"), HasSubstr("1.008"), HasSubstr("+0.008"))));
}

TEST(Spreading, RefusesWhatIsNoDistribution) {
  EXPECT_THAT([] { SpreadingExponent::constant(-1); }, ThrowsMessage<InputError>(HasSubstr("got -1")));
  EXPECT_THROW(SpreadingExponent::constant(std::nan("")), InputError);
  EXPECT_THROW(SpreadingExponent::goda(10, 0), InputError);
  EXPECT_THROW(SpreadingExponent::mitsuyasu(0, 1), InputError);
  EXPECT_THROW(CosNSpreading(-0.1), InputError);
  EXPECT_THROW(WrappedNormalSpreading(Angle::from_radians(0)), InputError);
  EXPECT_THROW(VonMisesSpreading(-1), InputError);
  EXPECT_THROW(TabulatedSpreading({0}, {1}), InputError);
  EXPECT_THROW(TabulatedSpreading({}, {}), InputError);
  EXPECT_THAT([] { TabulatedSpreading({0, 0, 1}, {1, 1, 1}); }, ThrowsMessage<InputError>(HasSubstr("must increase")));
  EXPECT_THROW(TabulatedSpreading({-1, 1}, {0.5, -0.5}), InputError);
  EXPECT_THROW(TabulatedSpreading({-1, 1}, {0.5, std::nan("")}), InputError);
  EXPECT_THROW(TabulatedSpreading({-4, 1}, {0.2, 0.2}), InputError);
  EXPECT_THROW(cos2s(2).density(Angle::from_radians(0), 0), InputError);
  EXPECT_THROW(cos2s(2).share_below(Angle::from_radians(4), 1), InputError);
  EXPECT_THROW(cos2s(2).density(Angle::from_radians(std::nan("")), 1), InputError);
  EXPECT_THROW(cos2s(2).quantile(1.1, 1), InputError);
}

}  // namespace
}  // namespace hydro::waves::spreading_test
