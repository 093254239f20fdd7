#include "hydro/waves/kinematics/sea.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/synthesis/synthesis.hpp"

namespace hydro::waves::sea_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double two_pi = 2 * std::numbers::pi;
const Water deep{};
const Water tank{.density = 1000, .gravity = 9.81, .depth = WaterDepth::from_metres(14)};
constexpr Angle oblique = Angle::from_degrees(30);

Sea jonswap_sea(double repetition_s, std::uint64_t seed, double omega_max = 3.0) {
  return Sea::irregular(Jonswap(2.5, 8.0, 3.3), {FftGrid{repetition_s}, 0.3, omega_max, seed}, {oblique}, tank);
}

double energy_of(const Sea& sea) {
  double sum = 0;
  for (const Component& w : sea.components()) sum += w.amplitude * w.amplitude / 2;
  return sum;
}

double rms(const std::vector<double>& x) {
  double sum = 0;
  for (const double v : x) sum += v * v;
  return std::sqrt(sum / static_cast<double>(x.size()));
}

double worst_difference(const std::vector<double>& series, const std::function<double(double)>& at, double dt) {
  double worst = 0;
  for (std::size_t n = 0; n < series.size(); ++n)
    worst = std::max(worst, std::abs(series[n] - at(static_cast<double>(n) * dt)));
  return worst;
}

TEST(RegularSea, TravelsWhereItsHeadingPoints) {
  const double T = 6, omega = two_pi / T, k = wavenumber(omega, deep);
  const Sea sea =
      Sea::regular(WaveAmplitude::from_height(3), AngularFrequency::from_period_s(T), Angle::from_degrees(90), deep);
  EXPECT_DOUBLE_EQ(sea.elevation(0, 0, 0), 1.5);               // a crest at the origin at t = 0
  EXPECT_NEAR(sea.elevation(1.0, 0, omega / k), 1.5, 1e-14);   // which is at y = +c t later (P2)
  EXPECT_NEAR(sea.elevation(1.0, 77, omega / k), 1.5, 1e-14);  // and as long-crested in x
  EXPECT_LT(sea.elevation(1.0, 0, -omega / k), 0.0);
  EXPECT_DOUBLE_EQ(sea.repetition_s(), T);
  EXPECT_EQ(sea.fraction_left_out(), 0.0);
}

TEST(IrregularSea, InverseFftAgreesWithTheDirectSum) {
  const Sea sea = jonswap_sea(600, 7);
  const double dt = 0.25, x = 12.5, y = -40;
  const auto series = synthesise(sea, {dt, 2400}, [&](const Component& w) { return elevation_transfer(w, x, y); });
  const double worst = worst_difference(
      series, [&](double t) { return sea.elevation(t, x, y); }, dt);
  EXPECT_LT(worst, 1e-12 * rms(series));  // phases up to ωt = 1800 rad carry roundings of 2e-13, (W10)
}

TEST(IrregularSea, AnyLinearResponseIsSynthesisedAndSummedAlike) {
  const Sea sea = jonswap_sea(600, 7);
  // A made-up oscillator of 5 s: real and imaginary parts differ, so a conjugate in the wrong place shows.
  const Transfer oscillator = [](const Component& w) {
    return 1.0 / std::complex<double>(1.58 - w.omega * w.omega, 0.1 * w.omega);
  };
  const auto amplitudes = response_amplitudes(sea, oscillator);
  const auto series = synthesise(sea, {0.5, 1200}, oscillator);
  const auto plain = [&](double t) {
    double sum = 0;
    for (const Component& w : sea.components()) {
      const std::complex<double> H = oscillator(w);
      sum += w.amplitude * std::abs(H) * std::cos(w.omega * t + w.phase + std::arg(H));
    }
    return sum;
  };
  EXPECT_LT(worst_difference(series, plain, 0.5), 2e-12 * rms(series));
  EXPECT_LT(worst_difference(
                series, [&](double t) { return sum_at(sea, amplitudes, t); }, 0.5),
            2e-12 * rms(series));
}

TEST(IrregularSea, RepeatsItselfAfterTheRepetitionPeriodOnly) {
  const Sea sea = jonswap_sea(100, 3);
  const auto series = synthesise(sea, {0.5, 500}, [](const Component&) { return 1.0; });
  ASSERT_EQ(series.size(), 500u);
  for (std::size_t n = 0; n < 300; ++n) EXPECT_EQ(series[n], series[n + 200]) << n;
  EXPECT_NEAR(sea.elevation(100 + 13.7, 5, 6), sea.elevation(13.7, 5, 6), 1e-11);
  EXPECT_GT(std::abs(sea.elevation(50 + 13.7, 5, 6) - sea.elevation(13.7, 5, 6)), 1e-3);
}

TEST(IrregularSea, PhasorsServeAStepThatDoesNotDivideTheRepetition) {
  const Sea sea = jonswap_sea(600, 7);
  const double dt = 0.3 * std::numbers::sqrt2;
  const auto series = synthesise(sea, {dt, 2000}, [](const Component& w) { return elevation_transfer(w, 3, 4); });
  EXPECT_LT(worst_difference(
                series, [&](double t) { return sea.elevation(t, 3, 4); }, dt),
            1e-12 * rms(series));
}

TEST(RegularSea, OfAnyPeriodIsSampledAtAnyStep) {
  const Sea sea =
      Sea::regular(WaveAmplitude::from_metres(2), AngularFrequency::from_period_s(7.77), oblique, deep, 0.4);
  for (const double dt : {0.1, 0.777})  // the second divides the period
    EXPECT_LT(worst_difference(
                  synthesise(sea, {dt, 5000}, [](const Component&) { return 1.0; }),
                  [&](double t) { return sea.elevation(t, 0, 0); }, dt),
              2e-12)  // ωt up to 3100 rad
        << dt;
}

TEST(IrregularSea, VarianceOverOneRepetitionIsExactlyTheEnergyOfItsComponents) {
  const Jonswap spectrum(2.5, 8.0, 3.3);
  const double d_omega = two_pi / 300;
  const Sea sea = Sea::irregular(spectrum, {FftGrid{300}, 0.3, 3.0, 11}, {oblique}, tank);
  const auto series = synthesise(sea, {0.5, 600}, [](const Component&) { return 1.0; });
  EXPECT_NEAR(rms(series) * rms(series) / energy_of(sea), 1.0, 1e-13);
  // (W9): that energy is m_0 but for what lies outside the outermost bins, 15 − ½ and 143 + ½ of Δω.
  EXPECT_NEAR(energy_of(sea), spectrum.energy(14.5 * d_omega, 143.5 * d_omega), 1e-14);
  EXPECT_NEAR(energy_of(sea) / spectrum.moment(0), 1 - sea.fraction_left_out(), 1e-14);
  EXPECT_NEAR(sea.fraction_left_out(), 1 - spectrum.energy(14.5 * d_omega, 143.5 * d_omega) / spectrum.moment(0),
              1e-12);
}

TEST(IrregularSea, SeedsDifferInPhaseButNotInVariance) {
  const Sea one = jonswap_sea(200, 1), two = jonswap_sea(200, 2);
  EXPECT_DOUBLE_EQ(energy_of(one), energy_of(two));
  EXPECT_GT(std::abs(one.elevation(0, 0, 0) - two.elevation(0, 0, 0)), 1e-6);
  // At one instant and place ζ is near Gaussian of variance m_0 over seeds; of 2000 seeds the variance is known to
  // √(2/2000) = 3.2 %, and the mean to σ/√2000 = 2.2 %. Four standard errors; the seeds are fixed.
  double sum = 0, squares = 0;
  const int seeds = 2000;
  for (int seed = 0; seed < seeds; ++seed) {
    const double z = jonswap_sea(60, static_cast<std::uint64_t>(seed)).elevation(0, 0, 0);
    sum += z;
    squares += z * z;
  }
  const double variance = energy_of(jonswap_sea(60, 0));
  EXPECT_NEAR(squares / seeds / variance, 1.0, 4 * 0.032);
  EXPECT_NEAR(sum / seeds / std::sqrt(variance), 0.0, 4 * 0.022);
}

TEST(IrregularSea, WiderBandKeepsThePhasesOfTheNarrower) {
  const Sea narrow = jonswap_sea(200, 5, 2.0), wide = jonswap_sea(200, 5, 3.0);
  ASSERT_LT(narrow.components().size(), wide.components().size());
  for (std::size_t i = 0; i < narrow.components().size(); ++i) {
    EXPECT_EQ(narrow.components()[i].phase, wide.components()[i].phase);
    EXPECT_EQ(narrow.components()[i].amplitude, wide.components()[i].amplitude);
  }
  // A longer repetition is another grid: number j keeps its phase but is another frequency.
  const Sea longer = jonswap_sea(400, 5);
  const std::size_t j = wide.grid_index()[0];
  const auto at_j =
      std::find(longer.grid_index().begin(), longer.grid_index().end(), 2 * j) - longer.grid_index().begin();
  EXPECT_DOUBLE_EQ(longer.components()[static_cast<std::size_t>(at_j)].omega, wide.components()[0].omega);
  EXPECT_NE(longer.components()[static_cast<std::size_t>(at_j)].phase, wide.components()[0].phase);
}

TEST(IrregularSea, HasPhasesThatAreTheSameOnEveryMachine) {
  // Tripwire: the numbers of RandomStream(5, phase_stream), which rests on published answers in random_test.cpp.
  const Sea sea = Sea::irregular(Jonswap(2.5, 8.0, 3.3), {FftGrid{200}, 0.3, 2.0, 5}, {oblique}, tank);
  ASSERT_EQ(sea.grid_index()[0], 10u);
  EXPECT_NEAR(sea.components()[0].phase, two_pi * 0.03730592315710779, 1e-15);
}

TEST(IrregularSea, ComponentsObeyTheDispersionRelationOfTheWater) {
  const Sea sea = jonswap_sea(200, 5);
  for (const Component& w : sea.components())
    EXPECT_NEAR(w.k * 9.81 * std::tanh(w.k * 14) / (w.omega * w.omega), 1.0, 1e-14);
}

TEST(Sea, RefusesAStepTooLongForItsShortestWave) {
  const Sea sea = jonswap_sea(600, 7);
  EXPECT_THAT(
      [&] {
        synthesise(sea, {1.2, 500}, [](const Component&) { return 1.0; });
      },
      ThrowsMessage<InputError>(HasSubstr("less than two samples a period")));
  EXPECT_THROW(synthesise(sea, {0, 500}, [](const Component&) { return 1.0; }), InputError);
  // At the Nyquist frequency itself the sine part is lost: refused as well.
  const Sea regular = Sea::regular(WaveAmplitude::from_metres(1), AngularFrequency::from_period_s(2), oblique, deep);
  EXPECT_THROW(synthesise(regular, {1, 10}, [](const Component&) { return 1.0; }), InputError);
}

TEST(Sea, RefusesABandWithoutComponents) {
  const Jonswap spectrum(2, 8, 3.3);
  EXPECT_THAT(
      [&] {
        Sea::irregular(spectrum, {FftGrid{10}, 0.1, 0.5, 1}, {oblique}, deep);
      },
      ThrowsMessage<InputError>(HasSubstr("no multiple of 0.628")));
  EXPECT_THROW(Sea::irregular(spectrum, {FftGrid{100}, 2, 1, 1}, {oblique}, deep), InputError);
  EXPECT_THROW(Sea::irregular(spectrum, {FftGrid{100}, -1, 1, 1}, {oblique}, deep), InputError);
  EXPECT_THROW(Sea::irregular(spectrum, {FftGrid{0}, 0.5, 1, 1}, {oblique}, deep), InputError);
  EXPECT_THROW(Sea::irregular(spectrum, {FftGrid{-5}, 0.5, 1, 1}, {oblique}, deep), InputError);
}

double moment(const Sea& sea, int n) {
  double sum = 0;
  for (const Component& w : sea.components()) sum += std::pow(w.omega, n) * w.amplitude * w.amplitude / 2;
  return sum;
}

TEST(EqualEnergySea, KeepsEnergyAndMeanFrequencyOfItsBandExactly) {
  const Jonswap spectrum(2.5, 8.0, 3.3);
  const Sea sea = Sea::irregular(spectrum, {EqualEnergy{50}, 0.3, 3.0, 4}, {oblique}, tank);
  ASSERT_EQ(sea.components().size(), 50u);
  EXPECT_NEAR(moment(sea, 0) / spectrum.energy(0.3, 3), 1, 1e-12);
  EXPECT_NEAR(moment(sea, 1) / spectrum.band_moment(1, 0.3, 3), 1, 1e-12);
  for (const Component& w : sea.components())
    EXPECT_NEAR(w.amplitude / sea.components()[0].amplitude, 1, 1e-9);  // bisection of the bins' edges to rounding
  EXPECT_TRUE(std::isinf(sea.repetition_s()));
  EXPECT_TRUE(sea.grid_index().empty());
  // m_2 misses the spread of frequency within each bin only, which falls with the bins' width squared.
  const DiscretisationError error = discretisation_error(sea, spectrum, 0.3, 3);
  EXPECT_NEAR(error.m0, 0, 1e-12);
  EXPECT_LT(error.m2, 0);
  const Sea finer = Sea::irregular(spectrum, {EqualEnergy{500}, 0.3, 3.0, 4}, {oblique}, tank);
  EXPECT_LT(std::abs(discretisation_error(finer, spectrum, 0.3, 3).m2), std::abs(error.m2) / 10);
}

TEST(RandomFrequencySea, HasOneWaveSomewhereInEachBin) {
  const Jonswap spectrum(2.5, 8.0, 3.3);
  const Sea sea = Sea::irregular(spectrum, {RandomInBin{300}, 0.3, 3.0, 4}, {oblique}, tank);
  ASSERT_EQ(sea.components().size(), 300u);
  double mean = 0;
  for (std::size_t i = 0; i < 300; ++i) {
    const double place = (sea.components()[i].omega - 0.3) / 0.009 - static_cast<double>(i);
    EXPECT_GE(place, -1e-9);
    EXPECT_LT(place, 1 + 1e-9);
    mean += place / 300;
  }
  EXPECT_NEAR(mean, 0.5, 4 / std::sqrt(12 * 300.0));  // four standard errors of a uniform mean
  EXPECT_NEAR(moment(sea, 0) / spectrum.energy(0.3, 3), 1, 1e-12);
  EXPECT_NEAR(discretisation_error(sea, spectrum, 0.3, 3).m2, 0, 0.01);
  EXPECT_GT(std::abs(sea.elevation(2 * std::numbers::pi / 0.009, 0, 0) - sea.elevation(0, 0, 0)),
            1e-3);  // no repetition
}

TEST(RayleighSea, ScattersAboutTheSpectrumAsARecordOfThatLengthDoes) {
  // (W23): variance over seeds of Σ a²/2 is Σ e_j², of mean Σ e_j.
  const Jonswap spectrum(2.5, 8.0, 3.3);
  const Sea fixed = Sea::irregular(spectrum, {FftGrid{100}, 0.3, 3.0, 0}, {oblique}, tank);
  double squares = 0;
  for (const Component& w : fixed.components()) squares += std::pow(w.amplitude, 4) / 4;
  const double m0 = moment(fixed, 0), deviation = std::sqrt(squares);
  const int seeds = 1000;
  double mean = 0, square = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const double v =
        moment(Sea::irregular(spectrum, {FftGrid{100}, 0.3, 3.0, seed, Amplitudes::rayleigh}, {oblique}, tank), 0);
    mean += v / seeds;
    square += (v - m0) * (v - m0) / seeds;
  }
  EXPECT_NEAR(mean, m0, 4 * deviation / std::sqrt(seeds));
  // A sum of exponentials has an excess kurtosis below 6, so √(variance) is known to 0.5 √((2 + 6)/1000) = 4.5 %.
  EXPECT_NEAR(std::sqrt(square) / deviation, 1, 4 * 0.045);
}

/// Two directions only: a share at +0.5 rad and the rest at −0.3 rad, smoothed over 0.02 rad.
class TwoDirections final : public Spreading {
 public:
  double density(Angle a, double) const override {
    return std::abs(a.radians() - 0.5) < 0.01 ? 15 : std::abs(a.radians() + 0.3) < 0.01 ? 35 : 0;
  }
  double share_below(Angle a, double) const override {
    const auto step = [&](double at) { return std::clamp((a.radians() - at) / 0.02 + 0.5, 0.0, 1.0); };
    return 0.7 * step(-0.3) + 0.3 * step(0.5);
  }
  double first_harmonic(double) const override {
    return std::sin(0.01) / 0.01 * std::abs(0.7 * std::polar(1.0, -0.3) + 0.3 * std::polar(1.0, 0.5));
  }
};

TEST(SpreadSea, SendsEachComponentOneWayInTheSharesOfTheSpreading) {
  const Jonswap spectrum(2.5, 8.0, 3.3);
  const TwoDirections spreading;
  const Sea sea = Sea::irregular(spectrum, {RandomInBin{4000}, 0.3, 3.0, 4}, {oblique, &spreading}, tank);
  int left = 0;
  for (const Component& w : sea.components()) {
    const double from_mean = w.heading - oblique.radians();
    EXPECT_TRUE(std::abs(from_mean - 0.5) < 0.011 || std::abs(from_mean + 0.3) < 0.011) << from_mean;
    left += from_mean > 0;
  }
  EXPECT_NEAR(left / 4000.0, 0.3, 4 * std::sqrt(0.21 / 4000));  // four standard errors
  EXPECT_NEAR(moment(sea, 0) / spectrum.energy(0.3, 3), 1, 1e-12);
}

TEST(SpreadSea, PhasesDoNotChangeWhenDirectionsAreAdded) {
  const Jonswap spectrum(2.5, 8.0, 3.3);
  const TwoDirections spreading;
  const Sea along = Sea::irregular(spectrum, {FftGrid{100}, 0.3, 3.0, 4}, {oblique}, tank);
  const Sea spread = Sea::irregular(spectrum, {FftGrid{100}, 0.3, 3.0, 4}, {oblique, &spreading}, tank);
  for (std::size_t i = 0; i < along.components().size(); ++i)
    EXPECT_EQ(along.components()[i].phase, spread.components()[i].phase);
  EXPECT_NEAR(along.elevation(17, 0, 0), spread.elevation(17, 0, 0), 1e-12);  // at the origin no way has been gone
}

TEST(GivenSea, HasTheWavesOfTheListInItsOrder) {
  const std::vector<GivenWave> list{
      {AngularFrequency::from_period_s(8), WaveAmplitude::from_metres(1), 0.4, oblique},
      {AngularFrequency::from_period_s(5), WaveAmplitude::from_metres(0.2), 2.4, Angle::from_degrees(-90)}};
  const Sea sea = Sea::of(list, tank);
  EXPECT_NEAR(sea.elevation(0, 0, 0), std::cos(0.4) + 0.2 * std::cos(2.4), 1e-15);
  EXPECT_NEAR(sea.hs(), 4 * std::sqrt(0.5 + 0.02), 1e-15);
  EXPECT_NEAR(sea.components()[1].k, wavenumber(two_pi / 5, tank), 1e-15);
  EXPECT_THROW(Sea::of({}, tank), InputError);
}

TEST(SeaOnACurrent, KeepsItsFrequencyAndChangesItsLength) {
  const Current against = Current::uniform({-1, 0});
  const Sea still = Sea::irregular(Jonswap(2.5, 8, 3.3), {FftGrid{200}, 0.3, 1.5, 5}, {}, tank),
            stream = Sea::irregular(Jonswap(2.5, 8, 3.3), {FftGrid{200}, 0.3, 1.5, 5}, {}, tank, against);
  for (std::size_t i = 0; i < still.components().size(); ++i) {
    const Component &a = still.components()[i], &b = stream.components()[i];
    EXPECT_EQ(a.omega, b.omega);
    EXPECT_EQ(a.sigma, a.omega);
    EXPECT_GT(b.k, a.k);  // shorter waves against the current
    EXPECT_NEAR(b.sigma - b.k, b.omega, 1e-12);
    EXPECT_EQ(a.amplitude, b.amplitude);
  }
  EXPECT_THAT(
      [&] {
        Sea::irregular(Jonswap(2.5, 8, 3.3), {FftGrid{200}, 0.3, 3, 5}, {}, tank, against);
      },
      ThrowsMessage<InputError>(HasSubstr("stops waves")));
}

TEST(Sea, WantsOneAmplitudePerComponent) {
  const Sea sea = jonswap_sea(100, 1);
  const std::vector<std::complex<double>> few(2);
  EXPECT_THAT([&] { sum_at(sea, few, 0); }, ThrowsMessage<InputError>(HasSubstr("2 complex amplitudes")));
  EXPECT_THROW(synthesise(sea, {0.1, 10}, few), InputError);
}

}  // namespace
}  // namespace hydro::waves::sea_test
