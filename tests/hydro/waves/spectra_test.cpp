#include "hydro/waves/spectra/spectra.hpp"
#include "hydro/waves/spectra/donelan.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include "hydro/waves/dispersion.hpp"

namespace hydro::waves::spectra_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double two_pi = 2 * std::numbers::pi;
constexpr double g = 9.81;

Water depth(double metres) { return {.gravity = g, .depth = WaterDepth::from_metres(metres)}; }

struct Named {
  std::string name;
  std::shared_ptr<const Spectrum> spectrum;
  double hs;
};

template <class S>
Named named(std::string name, S spectrum, double hs) {
  return {std::move(name), std::make_shared<const S>(std::move(spectrum)), hs};
}

// One of each kind, and the awkward ones: sharp, shallow, steep.
std::vector<Named> one_of_each() {
  return {named("Pierson-Moskowitz", pierson_moskowitz_of_wind(15), 4.799214),
          named("Bretschneider", bretschneider(3, ZeroCrossingPeriod{6}), 3),
          named("JONSWAP", Jonswap(8.2, 11.7, 3.3), 8.2),
          named("JONSWAP, sharp", Jonswap(2, 9, 20), 2),
          named("TMA", Tma(2.5, 9, 3.3, depth(8)), 2.5),
          named("TMA, shallow", Tma(0.5, 12, 1, depth(0.5)), 0.5),
          named("Ochi-Hubble", ochi_hubble_most_probable(5), 5),
          named("Torsethaugen, wind sea", torsethaugen(6, 8), 6),
          named("Torsethaugen, swell", torsethaugen(3, 16), 3),
          named("Wallops", wallops(6.5, 10), 6.5),
          named("Donelan, young", donelan(15, 4), donelan(15, 4).hs()),
          named("Donelan, old", donelan(12, 9), donelan(12, 9).hs()),
          named("Gaussian swell", GaussianSwell(1.5, 15, 0.04), 1.5),
          named("sum", sum(Jonswap(3, 7, 2), GaussianSwell(1, 14, 0.03)), std::sqrt(10.0))};
}

// Slow and plain: Simpson's rule with 100 000 intervals in s, for ω = ω_0 s and for ω = ω_0/s, with `weight`.
double plain_integral(const Spectrum& spectrum, const std::function<double(double)>& weight, double from = 0,
                      double to = infinity) {
  const double omega_0 = spectrum.peak_omega();
  const auto simpson = [&](const std::function<double(double)>& f, double low, double high) {
    const int intervals = 100'000;
    double sum = 0;
    for (int i = 0; i <= intervals; ++i) {
      const double s = low + (high - low) * i / intervals;
      if (s > 0) sum += f(s) * (i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2);  // f(0) = 0 here
    }
    return sum * (high - low) / (3.0 * intervals);
  };
  const auto f = [&](double omega) { return weight(omega) * spectrum.density(omega); };
  return omega_0 * (simpson([&](double s) { return f(omega_0 * s); }, from / omega_0, 1) +
                    simpson([&](double s) { return f(omega_0 / s) / (s * s); }, omega_0 / to, 1));
}

TEST(EverySpectrum, CarriesExactlyTheEnergyOfItsSignificantHeight) {
  for (const Named& n : one_of_each()) {
    // Seven printed digits of Pierson & Moskowitz's height; the others to rounding.
    EXPECT_NEAR(n.spectrum->hs() / n.hs, 1, n.name == "Pierson-Moskowitz" ? 1e-7 : 1e-14) << n.name;
  }
}

TEST(EverySpectrum, HasTheMomentsOfPlainQuadrature) {
  for (const Named& n : one_of_each()) {
    // A tail ω^−4 leaves s^{−n+2} at the end of Simpson's rule, which is not smooth for n = 2: the error is h^{1…2}.
    const bool slow_tail = n.spectrum->tail_power() == 4;
    for (const int order : {-1, 0, 1, 2}) {
      const double plain = plain_integral(*n.spectrum, [&](double omega) { return std::pow(omega, order); });
      const double limit = slow_tail && order == 2 ? 1e-4 : 1e-10;  // 1e-10: kinks that no node of Simpson's rule meets
      EXPECT_NEAR(n.spectrum->moment(order) / plain, 1, limit) << n.name << ", m_" << order;
    }
    const double top = 4 * n.spectrum->peak_omega();  // m_4 exists in a band
    EXPECT_NEAR(
        n.spectrum->band_moment(4, 0, top) / plain_integral(
                                                 *n.spectrum, [](double omega) { return std::pow(omega, 4); }, 0, top),
        1, 1e-8)
        << n.name;
  }
}

TEST(EverySpectrum, AddsUpOverBandsHoweverNarrow) {
  for (const Named& n : one_of_each()) {
    const double top = 3 * n.spectrum->peak_omega();
    for (const int order : {-1, 0, 2}) {
      double sum = 0;
      const int bands = 3001;  // not a multiple of any panel
      for (int i = 0; i < bands; ++i) sum += n.spectrum->band_moment(order, top * i / bands, top * (i + 1) / bands);
      // 1e-12 is promised of a band; their sum averages.
      EXPECT_NEAR(sum / n.spectrum->band_moment(order, 0, top), 1, 1e-12) << n.name << ", m_" << order;
    }
    EXPECT_NEAR((n.spectrum->energy(0, top) + n.spectrum->energy(top, infinity)) / n.spectrum->moment(0), 1, 1e-14);
  }
}

TEST(EverySpectrum, KeepsItsDigitsInBandsOfAMillionthOfThePeakFrequency) {
  for (const Named& n : one_of_each())
    for (const double at : {0.9, 1.3, 2.9, 7.0}) {
      const double omega = at * n.spectrum->peak_omega(), half = 0.5e-6 * omega;
      const double from = omega - half, to = omega + half;
      const double density = n.spectrum->density(omega);
      if (density < 1e-12) continue;
      // Midpoint rule: S″ width²/24 is below 1e-9 of S for the sharpest peak here.
      EXPECT_NEAR(n.spectrum->energy(from, to) / (density * (to - from)), 1, 1e-9) << n.name << " at " << at;
    }
}

TEST(EverySpectrum, FindsTheFrequencyBelowWhichAShareOfItsEnergyLies) {
  for (const Named& n : one_of_each()) {
    const double top = 5 * n.spectrum->peak_omega(), all = n.spectrum->energy(0, top);
    for (const double share : {1e-6, 0.1, 0.5, 0.9, 0.9999}) {
      const double omega = n.spectrum->omega_at_energy(share * all, 0, top);
      // 1e-15 of the band, 5ω_p, times the share per frequency, 12/ω_p at the sharpest peak.
      EXPECT_NEAR(n.spectrum->energy(0, omega) / all, share, 1e-13) << n.name;
    }
    EXPECT_THROW(n.spectrum->omega_at_energy(1.01 * all, 0, top), InputError);
  }
}

TEST(EverySpectrum, IsHighestWhereItSaysSo) {
  for (const Named& n : one_of_each()) {
    const double peak = n.spectrum->peak_omega(), highest = n.spectrum->density(peak);
    for (int i = 1; i < 4000; ++i) EXPECT_LE(n.spectrum->density(peak * i / 1000.0), highest * (1 + 1e-14)) << n.name;
  }
}

TEST(EverySpectrum, FallsOffAsItSays) {
  for (const Named& n : one_of_each()) {
    const double p = n.spectrum->tail_power(), far = 1e3 * n.spectrum->peak_omega();
    if (std::isinf(p)) {
      EXPECT_EQ(n.spectrum->density(far), 0) << n.name;
      EXPECT_GT(n.spectrum->moment(4), 0) << n.name;
      continue;
    }
    // e^{−w u^−q} at u = 1e3 is 1 − 1e-12, and the other part of a sum is smaller by 1e3 to the difference of the
    // powers.
    const double slope = std::log(n.spectrum->density(far) / n.spectrum->density(10 * far)) / std::log(10);
    EXPECT_NEAR(slope, p, n.name == "Ochi-Hubble" ? 1e-8 : 1e-10) << n.name;
    const int first_infinite = static_cast<int>(std::ceil(p - 1));
    EXPECT_THAT([&] { n.spectrum->moment(first_infinite); },
                ThrowsMessage<InputError>(HasSubstr(fmt::format("m_{}", first_infinite))))
        << n.name;
  }
}

TEST(PeakedSpectrum, HasItsMomentsInClosedForm) {
  for (const PeakShape shape : {PeakShape{5, 4, 1}, PeakShape{4, 4, 1}, PeakShape{8.9, 4, 1}, PeakShape{6, 2.5, 1},
                                PeakShape{3.7, 1, 1}, PeakShape{40, 8, 1}}) {
    const PeakedSpectrum spectrum(3, 10, shape);
    for (const int n : {-1, 1, 2}) {
      if (n >= shape.p - 1) continue;
      // (W30): v = (p/q) u^−q turns ∫ u^{n−p} e^{−(p/q) u^−q} du into a gamma function.
      const double closed = std::pow(two_pi / 10, n) * std::pow(shape.p / shape.q, n / shape.q) *
                            std::exp(std::lgamma((shape.p - 1 - n) / shape.q) - std::lgamma((shape.p - 1) / shape.q));
      EXPECT_NEAR(spectrum.moment(n) / (9.0 / 16 * closed), 1, 1e-13) << shape.p << " " << shape.q << " m_" << n;
    }
  }
}

TEST(SeaPeriods, ReturnWhatWasAskedFor) {
  for (const double gamma : {1.0, 3.3, 7.0}) {
    EXPECT_NEAR(jonswap(2, ZeroCrossingPeriod{6}, gamma).tz(), 6, 1e-13);
    EXPECT_NEAR(jonswap(2, MeanPeriod{6}, gamma).mean_period(), 6, 1e-13);
    EXPECT_NEAR(jonswap(2, EnergyPeriod{6}, gamma).energy_period(), 6, 1e-13);
    EXPECT_DOUBLE_EQ(jonswap(2, PeakPeriod{6}, gamma).tp(), 6);
  }
  // (W32): T1 = 0.7718 Tp, Tz = 0.7104 Tp and Te = 0.857 Tp, as handbooks print them.
  EXPECT_NEAR(bretschneider(2, PeakPeriod{1}).mean_period(), 0.7718, 1e-4);
  EXPECT_NEAR(bretschneider(2, PeakPeriod{1}).tz(), 0.7104, 1e-4);
  EXPECT_NEAR(bretschneider(2, PeakPeriod{1}).energy_period(), 0.857, 5e-4);
  // DNV-RP-C205 approximates Tz/Tp of JONSWAP by a cubic in γ, to 0.3 %.
  for (const double gamma : {1.0, 2.0, 3.3, 5.0, 7.0})
    EXPECT_NEAR(Jonswap(2, 1, gamma).tz(),
                0.6673 + 0.05037 * gamma - 0.006230 * gamma * gamma + 0.0003341 * gamma * gamma * gamma, 3e-3)
        << gamma;
}

TEST(JonswapGamma, FollowsItsRelationToHeightAndPeriod) {
  EXPECT_EQ(dnv_gamma(4, 10), 1.0);                                // Tp = 5 √Hs
  EXPECT_EQ(dnv_gamma(4, 6), 5.0);                                 // 3 √Hs
  EXPECT_NEAR(dnv_gamma(4, 8), std::exp(5.75 - 1.15 * 4), 1e-14);  // 3.158
  EXPECT_NEAR(dnv_gamma(4, 7.201), dnv_gamma(4, 7.199), 5e-3);     // no step at 3.6 √Hs
  for (const double tz : {4.0, 5.5, 6.2, 7.0, 9.0}) {
    const Jonswap spectrum = jonswap_dnv(4, ZeroCrossingPeriod{tz});
    EXPECT_NEAR(spectrum.tz(), tz, 1e-12);
    EXPECT_NEAR(spectrum.gamma(), dnv_gamma(4, spectrum.tp()), 1e-12);
  }
  for (const double gamma : {1.0, 3.3, 12.0, 20.0})
    EXPECT_NEAR(jonswap_gamma(PeakPeriod{9}, ZeroCrossingPeriod{Jonswap(1, 9, gamma).tz()}), gamma, 1e-11) << gamma;
  EXPECT_THAT([] { jonswap_gamma(PeakPeriod{10}, ZeroCrossingPeriod{7}); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("0.71037"), HasSubstr("0.70000"))));
}

TEST(PiersonMoskowitz, IsThatOfTheWind) {
  const Jonswap spectrum = pierson_moskowitz_of_wind(15, g);
  for (const double omega : {0.4, 0.6, 1.1})
    EXPECT_NEAR(spectrum.density(omega),
                8.1e-3 * g * g * std::pow(omega, -5) * std::exp(-0.74 * std::pow(g / (15 * omega), 4)),
                1e-13 * spectrum.density(omega) + 1e-15);
  EXPECT_NEAR(wind_of_pierson_moskowitz(spectrum.hs(), g), 15, 1e-13);
}

TEST(Tma, IsJonswapInDeepWater) {
  const Jonswap deep(3, 8, 3.3);
  const Tma infinitely(3, 8, 3.3, {.gravity = g}), very(3, 8, 3.3, depth(5000));
  for (const double omega : {0.5, 0.785, 1.0, 2.0}) {
    EXPECT_DOUBLE_EQ(infinitely.density(omega), deep.density(omega));
    EXPECT_NEAR(very.density(omega) / deep.density(omega), 1, 1e-13);
  }
  EXPECT_NEAR(infinitely.deep_water_hs(), 3, 1e-13);
}

TEST(Tma, DepthFactorIsTheChangeOfAWavenumberSpectrumThatKeepsItsTail) {
  // Kitaigorodskii, Krasitskii & Zaslavskii 1975: [k^−3 dk/dω] at depth over the same in deep water.
  for (const double h : {0.3, 5.0, 40.0})
    for (const double omega : {0.2, 0.7, 1.5, 4.0}) {
      const double step = 1e-4 * omega;
      const auto slope = [&](const Water& water) {
        return (wavenumber(omega + step, water) - wavenumber(omega - step, water)) / (2 * step) /
               std::pow(wavenumber(omega, water), 3);
      };
      // The difference quotient is right to step² k‴/6k ~ 1e-8.
      EXPECT_NEAR(depth_factor(omega, depth(h)) / (slope(depth(h)) / slope({.gravity = g})), 1, 1e-7)
          << h << " " << omega;
    }
  // Long waves: ω²h/(2g); the next term is (kh)²/3 of it.
  EXPECT_NEAR(depth_factor(1e-3, depth(10)) / (1e-6 * 10 / (2 * g)), 1, 1e-6);
  EXPECT_EQ(depth_factor(1e3, depth(10)), 1.0);  // kh = 1e6: no overflow
}

TEST(Tma, KeepsItsEnergyAndTellsWhatItWouldBeInDeepWater) {
  const Tma spectrum(2, 9, 3.3, depth(6));
  const double raised = spectrum.deep_water_hs();
  EXPECT_GT(raised, 2);
  const Jonswap deep(raised, 9, 3.3);
  for (const double omega : {0.5, 0.7, 1.3})
    EXPECT_NEAR(spectrum.density(omega) / (deep.density(omega) * depth_factor(omega, depth(6))), 1, 1e-12);
  EXPECT_LT(spectrum.tp(), 9);  // the factor moves the peak up
  EXPECT_NEAR(Tma::with_peak(2, 9, 3.3, depth(6)).tp(), 9, 1e-6);
  // (W35): in very shallow water the product falls as ω^−3, and without enhancement its peak is at (5/3)^{1/4} ω_p.
  EXPECT_NEAR(Tma(1, 10, 1, depth(0.01)).peak_omega() / (two_pi / 10), std::pow(5.0 / 3, 0.25), 1e-4);
}

TEST(OchiHubble, HasTheFormOfItsPaper) {
  const auto spectrum = ochi_hubble({.hs_m = 3, .tp_s = 14, .lambda = 2.5}, {.hs_m = 2, .tp_s = 7, .lambda = 1.2});
  const auto part = [](double hs, double tp, double lambda, double omega) {
    const double peak = two_pi / tp;
    return 0.25 * std::pow((4 * lambda + 1) / 4 * std::pow(peak, 4), lambda) / std::tgamma(lambda) * hs * hs /
           std::pow(omega, 4 * lambda + 1) * std::exp(-(4 * lambda + 1) / 4 * std::pow(peak / omega, 4));
  };
  for (const double omega : {0.35, 0.45, 0.9, 2.0})
    EXPECT_NEAR(spectrum.density(omega) / (part(3, 14, 2.5, omega) + part(2, 7, 1.2, omega)), 1, 1e-12);
  EXPECT_NEAR(spectrum.hs(), std::sqrt(13.0), 1e-13);
  EXPECT_NEAR(spectrum.tail_power(), 5.8, 1e-14);
}

TEST(Wallops, AgreesWithAnotherProgram) {
  // The documentation of pywafo prints these for Hm0 = 6.5 m, Tp = 10 s.
  const PeakedSpectrum spectrum = wallops(6.5, 10);
  EXPECT_NEAR(spectrum.density(1), 9.36921871e-01, 1e-9);
  EXPECT_NEAR(spectrum.density(2), 2.76991078e-03, 1e-11);
  EXPECT_NEAR(spectrum.density(3), 7.72996150e-05, 1e-12);
  // N = 5 is Pierson–Moskowitz: √m_0/λ_p = 2^{−5/2}/(√2 π).
  const double lambda = g * 100 / two_pi,
               hs = 4 * lambda * std::pow(2, -2.5) / (std::numbers::sqrt2 * std::numbers::pi);
  EXPECT_NEAR(wallops_exponent(hs, 10), 5, 1e-13);
}

// (W100) As its authors write it, by frequency in hertz.
TEST(Donelan, HasTheFormOfItsPaper) {
  for (const auto& [wind, tp] : {std::pair{15.0, 4.0}, {8.0, 3.0}, {12.0, 7.2}}) {
    const PeakedSpectrum spectrum = donelan(wind, tp);
    const double fp = 1 / tp, age = wind / (g * tp / two_pi);
    const double alpha = 0.006 * std::pow(age, 0.55), gamma = age < 1 ? 1.7 : 1.7 + 6 * std::log10(age),
                 sigma = 0.08 * (1 + 4 / std::pow(age, 3));
    for (const double f : {0.6 * fp, 0.9 * fp, fp, 1.2 * fp, 2 * fp, 5 * fp}) {
      const double by_hertz = alpha * g * g * std::pow(two_pi, -4) / fp * std::pow(f, -4) *
                              std::exp(-std::pow(fp / f, 4)) *
                              std::pow(gamma, std::exp(-std::pow(f - fp, 2) / (2 * std::pow(sigma * fp, 2))));
      EXPECT_NEAR(two_pi * spectrum.density(two_pi * f) / by_hertz, 1, 1e-12) << wind << ' ' << f / fp;
    }
  }
}

TEST(Donelan, RefusesWindsThatWereNotMeasured) {
  EXPECT_THAT([] { donelan(5, 10); }, ThrowsMessage<InputError>(HasSubstr("0.83 to 5 times was measured")));
  EXPECT_THAT([] { donelan(60, 4); }, ThrowsMessage<InputError>(HasSubstr("0.83 to 5 times was measured")));
}

TEST(Torsethaugen, DividesTheEnergyBetweenTwoSystems) {
  // Worked out by hand from the relations: Hs = 6 m, Tp = 8 s is a wind sea.
  const auto wind = torsethaugen_systems(6, 8);
  EXPECT_TRUE(wind.wind_dominated());
  const double developed = 6.6 * std::cbrt(6.0), e = (developed - 8) / (developed - 2 * std::sqrt(6.0));
  EXPECT_NEAR(wind.primary_hs, 6 * (0.7 + 0.3 * std::exp(-4 * e * e)), 1e-13);
  EXPECT_NEAR(wind.secondary_tp_s, developed + 2, 1e-13);
  EXPECT_NEAR(wind.gamma, 35 * std::pow(two_pi / g * wind.primary_hs / 64, 6.0 / 7), 1e-13);
  const auto swell = torsethaugen_systems(3, 16);
  EXPECT_FALSE(swell.wind_dominated());
  EXPECT_NEAR(std::hypot(swell.primary_hs, swell.secondary_hs), 3, 1e-13);
  EXPECT_NEAR(swell.secondary_tp_s, 6.6 * std::cbrt(swell.secondary_hs), 1e-13);
  // A low sea: the relation asks for less than no enhancement, and says so.
  const auto low = torsethaugen_systems(0.5, 5.3);
  EXPECT_LT(low.relation_gamma, 1);
  EXPECT_EQ(low.gamma, 1);
}

TEST(Torsethaugen, IsOneSystemOnTheBorderAndContinuousAcrossIt) {
  const double border = 6.6 * std::cbrt(5.0);
  const auto below = torsethaugen(5, border * (1 - 1e-9)), at = torsethaugen(5, border),
             above = torsethaugen(5, border * (1 + 1e-9));
  EXPECT_EQ(at.parts().size(), 1u);
  for (const double omega : {0.4, 0.55, 0.8, 1.5}) {
    EXPECT_NEAR(below.density(omega) / at.density(omega), 1, 1e-6);  // 1e-9 of the peak's place, times the slope
    EXPECT_NEAR(above.density(omega) / at.density(omega), 1, 1e-6);
  }
}

TEST(GaussianSwell, HasTheMomentsOfANormalDistribution) {
  const double s = 0.04, w = two_pi / 15, m0 = 1.5 * 1.5 / 16;
  const GaussianSwell swell(1.5, 15, s);
  EXPECT_NEAR(swell.moment(1) / (m0 * w), 1, 1e-13);
  EXPECT_NEAR(swell.moment(2) / (m0 * (w * w + s * s)), 1, 1e-13);  // cut off at 8σ: 1e-14
  EXPECT_NEAR(swell.moment(4) / (m0 * (std::pow(w, 4) + 6 * w * w * s * s + 3 * std::pow(s, 4))), 1, 1e-12);
  // So wide that it reaches zero frequency, where 1/ω cannot be integrated.
  EXPECT_THAT([&] { GaussianSwell(1.5, 15, w / 4).moment(-1); },
              ThrowsMessage<InputError>(HasSubstr("m_-1 is infinite")));
  EXPECT_NEAR(GaussianSwell(1.5, 15, w / 4).hs(), 1.5, 1e-14);
}

TEST(SumSpectrum, AddsDensitiesAndMoments) {
  const Jonswap wind(3, 7, 2);
  const GaussianSwell swell(4, 14, 0.03);
  const SumSpectrum both = sum(wind, swell);
  EXPECT_EQ(both.density(0.5), wind.density(0.5) + swell.density(0.5));
  EXPECT_EQ(both.band_moment(2, 0.3, 1.7), wind.band_moment(2, 0.3, 1.7) + swell.band_moment(2, 0.3, 1.7));
  EXPECT_NEAR(both.hs(), 5, 1e-14);
  EXPECT_EQ(both.tail_power(), 5);
  EXPECT_NEAR(both.tp(), 14, 1e-6);  // the swell is far higher; the wind sea is 0 there
  EXPECT_THROW(SumSpectrum({}), InputError);
  EXPECT_THROW(SumSpectrum({nullptr}), InputError);
}

TEST(Spectra, RefuseWhatIsNoSea) {
  EXPECT_THAT([] { bretschneider(-1, PeakPeriod{8}); }, ThrowsMessage<InputError>(HasSubstr("got -1 m")));
  EXPECT_THAT([] { bretschneider(1, ZeroCrossingPeriod{0}); }, ThrowsMessage<InputError>(HasSubstr("got 0 s")));
  EXPECT_THROW(jonswap(1, MeanPeriod{std::nan("")}, 2), InputError);
  EXPECT_THAT([] { jonswap(1, MeanPeriod{5}, 0.5); },
              ThrowsMessage<InputError>(HasSubstr("between 1 and 20, got 0.5")));
  EXPECT_THROW(pierson_moskowitz_of_wind(0), InputError);
  EXPECT_THROW(pierson_moskowitz_of_wind(10, 0), InputError);
  EXPECT_THROW(Tma(1, 8, 0.9, depth(10)), InputError);
  EXPECT_THROW(Tma(0, 8, 2, depth(10)), InputError);
  EXPECT_THAT([] { depth(-3); }, ThrowsMessage<InputError>(HasSubstr("-3")));
  EXPECT_THAT([] { wallops(60, 8); }, ThrowsMessage<InputError>(HasSubstr("exponent between")));
  EXPECT_THAT([] { torsethaugen(6, 4); }, ThrowsMessage<InputError>(HasSubstr("2 sqrt(Hs)")));
  EXPECT_THROW(torsethaugen(3, 26), InputError);
  EXPECT_THROW(ochi_hubble({1, 10, 0}, {1, 5, 1}), InputError);
  EXPECT_THROW(ochi_hubble_most_probable(31), InputError);
  EXPECT_THROW(GaussianSwell(1, 12, 0), InputError);
  EXPECT_THROW(GaussianSwell(1, 12, 1), InputError);
  EXPECT_THROW(PeakedSpectrum(1, 8, {.p = 1, .q = 4, .gamma = 1}), InputError);
  EXPECT_THROW(Jonswap(1, 8, 2).band_moment(-2, 0, 1), InputError);
}

}  // namespace
}  // namespace hydro::waves::spectra_test
