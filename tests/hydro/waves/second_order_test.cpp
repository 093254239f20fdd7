#include "hydro/waves/synthesis/second_order.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/kinematics/steady.hpp"
#include "support/fresh_waters.hpp"

namespace hydro::waves::second_order_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;
constexpr double g = 9.81;

using support::deep;
using support::water_of;

FreeWave wave(double sigma, double heading, const Water& water) {
  const double k = wavenumber(sigma, water);
  return {sigma, k * std::cos(heading), k * std::sin(heading)};
}

struct Given {
  double omega, amplitude, phase, heading;
};
Sea sea_of(const std::vector<Given>& waves, const Water& water, double scale = 1,
           const Current& current = Current::none()) {
  std::vector<GivenWave> list;
  for (const Given& w : waves)
    list.push_back({AngularFrequency::from_rad_per_s(w.omega), WaveAmplitude::from_metres(scale * w.amplitude), w.phase,
                    Angle::from_radians(w.heading)});
  return Sea::of(list, water, current);
}

const std::vector<Given> crossing{
    {0.8, 0.4, 0.3, 0.2}, {1.0, 0.5, 1.9, -0.5}, {1.1, 0.3, 4.0, 2.9}, {1.0, 0.2, 2.0, 1.4}};

TEST(SecondOrder, OneWaveIsStokesSecondOrder) {
  for (const Water& water : {water_of(8), water_of(40), deep}) {
    const Sea sea = sea_of({{0.9, 0.7, 0, 0}}, water);
    const BoundWaves bound = bound_harmonics(sea);
    const SteadyWave stokes =
        stokes_second({.height_m = 1.4, .length = AngularFrequency::from_rad_per_s(0.9), .water = water});
    ASSERT_EQ(bound.harmonics.size(), 1u);
    EXPECT_NEAR(std::abs(bound.harmonics[0].elevation - stokes.elevation[1]), 0, 1e-14);
    EXPECT_NEAR(std::abs(bound.harmonics[0].potential - Complex(0, stokes.potential[1])), 0, 1e-13);
    EXPECT_DOUBLE_EQ(bound.harmonics[0].omega, 1.8);
    EXPECT_NEAR(second_order_bernoulli(sea), stokes.bernoulli, 1e-15);
  }
}

// Departures from the conditions at the free surface itself, at z = ζ: pressure in metres of water, and w − Dζ/Dt in
// m/s with ζ differentiated harmonic by harmonic.
struct Departure {
  double pressure = 0, kinematic = 0;
};
Departure departure(const HarmonicField& field) {
  Departure worst;
  for (int n = 0; n < 200; ++n) {
    const double t = 0.731 * n, x = 1.7 * n, y = -2.3 * n;
    const double zeta = field.elevation(t, x, y);
    double rate = 0;
    Eigen::Vector2d slope(0, 0);
    for (const Harmonic& h : field.harmonics()) {
      const Complex turned = Complex(0, 1) * h.elevation * std::polar(1.0, h.omega * t - h.kx * x - h.ky * y);
      rate += h.omega * turned.real();
      slope -= Eigen::Vector2d(h.kx, h.ky) * turned.real();
    }
    const Kinematics k = field.at(t, {x, y, zeta});
    worst.pressure = std::max(worst.pressure, std::abs(k.dynamic_pressure / (1000 * g) - zeta));
    worst.kinematic = std::max(worst.kinematic, std::abs(k.velocity.z() - rate - k.velocity.head<2>().dot(slope)));
  }
  return worst;
}

TEST(SecondOrder, FulfilsTheFreeSurfaceConditionsToThirdOrder) {
  // Half the amplitudes leave an eighth; the next order moves the exponent by about the steepness.
  const Current stream = Current::uniform({0.6, -0.3});
  for (const Water& water : {water_of(12), water_of(60), deep})
    for (const Current& current : {Current::none(), stream}) {
      const auto at = [&](double scale) {
        HarmonicField::Options options;
        options.stretching = Stretching::none;
        return departure(second_order_field(sea_of(crossing, water, scale, current), {}, options));
      };
      const Departure large = at(0.02), small = at(0.01);
      EXPECT_NEAR(std::log2(large.pressure / small.pressure), 3, 0.05) << water.depth.metres();
      EXPECT_NEAR(std::log2(large.kinematic / small.kinematic), 3, 0.05) << water.depth.metres();
    }
}

TEST(SecondOrder, WithoutTheBoundWavesOnlyTheSecondOrderIsMissed) {
  const auto at = [&](double scale) {
    HarmonicField::Options options;
    options.stretching = Stretching::none;
    return departure(second_order_field(sea_of(crossing, water_of(12), scale), {.parts = {false, false}}, options));
  };
  EXPECT_NEAR(std::log2(at(0.02).pressure / at(0.01).pressure), 2, 0.05);  // so the test above can tell
}

TEST(SecondOrder, TwoWavesInDeepWaterAreThoseOfLonguetHiggins) {
  // Same heading: ½(k₁ + k₂) at the sum, −½|k₁ − k₂| at the difference (Longuet-Higgins 1963).
  const FreeWave a = wave(1.1, 0.4, deep), b = wave(0.7, 0.4, deep);
  const double k1 = 1.21 / g, k2 = 0.49 / g;
  EXPECT_NEAR(sum_kernel(a, b, deep).elevation, (k1 + k2) / 2, 1e-15);
  EXPECT_NEAR(sum_kernel(a, b, deep).potential, 0, 1e-15);
  EXPECT_NEAR(difference_kernel(a, b, deep).elevation, -(k1 - k2) / 2, 1e-15);
  // The potential at the difference frequency is that of a long wave with w = −½ … : φ = −ω₁ a₁ a₂ sin(θ₁ − θ₂)
  EXPECT_NEAR(std::abs(difference_kernel(a, b, deep).potential), 1.1, 1e-14);
}

TEST(SecondOrder, KernelsAreSymmetricAndFinite) {
  for (const Water& water : {water_of(0.5), water_of(20), deep})
    for (const double s : {0.3, 0.9, 0.9 + 1e-9, 2.5})
      for (const double heading : {0.0, 1e-8, 0.3, pi / 2, pi}) {
        const FreeWave a = wave(0.9, 0, water), b = wave(s, heading, water);
        const PairKernel sum = sum_kernel(a, b, water), back = sum_kernel(b, a, water);
        const PairKernel difference = difference_kernel(a, b, water), other = difference_kernel(b, a, water);
        for (const double value : {sum.elevation, sum.potential, difference.elevation, difference.potential})
          EXPECT_TRUE(std::isfinite(value)) << s << " " << heading;
        EXPECT_NEAR(sum.elevation, back.elevation, 1e-12 * std::abs(sum.elevation));
        // E₁E₂* and its conjugate: the level is the same, the potential changes its sign with the frequency
        EXPECT_NEAR(difference.elevation, other.elevation, 1e-6 * std::abs(difference.elevation) + 1e-15);
        EXPECT_NEAR(difference.potential, -other.potential, 1e-6 * std::abs(difference.potential) + 1e-15);
      }
}

TEST(SecondOrder, NearlyEqualWavesTendToTheSetDownOfAGroup) {
  // (W66), half of it being −S_xx/(ρ(gh − c_g²)) with S_xx = E(2c_g/c − ½) (Longuet-Higgins & Stewart 1962).
  for (const double h : {3.0, 15.0, 200.0}) {
    const Water water = water_of(h);
    const FreeWave a = wave(0.8, 0.3, water);
    const double limit = difference_kernel(a, a, water).elevation;
    const double c_g = group_velocity(0.8, water), n = c_g / phase_velocity(0.8, water);
    EXPECT_NEAR(0.5 * limit / (-0.5 * g * (2 * n - 0.5) / (g * h - c_g * c_g)), 1, 1e-13);
    // first order in the difference: 1e-4 of frequency, times a coefficient of order kh/(slope), measured below 10
    EXPECT_NEAR(difference_kernel(a, wave(0.8 * (1 + 1e-4), 0.3, water), water).elevation / limit, 1, 2e-2) << h;
    const double closer = difference_kernel(a, wave(0.8 * (1 + 1e-6), 0.3, water), water).elevation;
    EXPECT_NEAR(closer / limit, 1, 2e-4) << h;
  }
  EXPECT_EQ(difference_kernel(wave(1, 0, deep), wave(1, 0, deep), deep).elevation, 0);
}

TEST(SecondOrder, OpposedEqualWavesBeatWithThePressureOfAStandingWave) {
  // Miche (1944): under a standing wave of amplitude A = 2a in deep water the pressure far below is −½ρω²A² cos 2ωt.
  const Sea sea = sea_of({{1.2, 0.3, 0, 0}, {1.2, 0.3, 0, pi}}, deep);
  HarmonicField::Options options;
  options.stretching = Stretching::none;
  const HarmonicField field = second_order_field(sea, {}, options);
  for (const double t : {0.0, 0.4, 1.1}) {
    const double expected = -0.5 * 1000 * 1.44 * 0.36 * std::cos(2.4 * t);
    EXPECT_NEAR(field.at(t, {3, 1, -500}).dynamic_pressure, expected, 1e-9 * 260);
  }
}

TEST(SecondOrder, DifferenceWavesLowerTheWaterUnderAGroup) {
  const Water water = water_of(10);
  std::vector<Given> group;
  for (int n = 0; n < 9; ++n) group.push_back({0.9 + 0.02 * n, 0.05, 0, 0});  // focused at the origin at t = 0
  const BoundWaves low = bound_harmonics(sea_of(group, water), {.parts = {.sums = false}});
  const HarmonicField field(low.harmonics, water, HarmonicField::Options{});
  EXPECT_EQ(low.harmonics.size(), 36u);
  EXPECT_LT(field.elevation(0, 0, 0), 0);
  const HarmonicField high(bound_harmonics(sea_of(group, water), {.parts = {.differences = false}}).harmonics, water,
                           HarmonicField::Options{});
  EXPECT_GT(high.elevation(0, 0, 0), 0);  // and sum waves sharpen its crest
}

TEST(SecondOrder, SkewnessOfARecordIsThatOfTheKernels) {
  // Frequencies at marks of a Golomb ruler (0 1 4 9 15 22 32 34): no sum or difference of two equals that of two
  // others, so the mean of ζ₁²ζ₂ over the repetition is the kernels' sum to rounding.
  const Water water = water_of(15);
  const double step = 0.02;
  std::vector<Given> waves;
  for (const int mark : {0, 1, 4, 9, 15, 22, 32, 34})
    waves.push_back({step * (200 + 5 * mark) / 5 * 0.1 + 0, 0.1, 0.7 * mark * mark, 0.1 * mark});
  const Sea sea = sea_of(waves, water);
  const HarmonicField linear(harmonics(sea), water, HarmonicField::Options{});
  const HarmonicField bound(bound_harmonics(sea).harmonics, water, HarmonicField::Options{});
  const double base = step * 0.1, T = 2 * pi / base;
  const int samples = 2048;  // above four times the highest harmonic (40 + 34) of the base frequency
  double third = 0, second = 0;
  for (int n = 0; n < samples; ++n) {
    const double t = n * T / samples, z1 = linear.elevation(t, 0, 0);
    third += 3 * z1 * z1 * bound.elevation(t, 0, 0) / samples;
    second += z1 * z1 / samples;
  }
  EXPECT_NEAR(third / std::pow(second, 1.5) / second_order_skewness(sea), 1, 1e-9);
  EXPECT_GT(second_order_skewness(sea), 0);
}

TEST(SecondOrder, SkewnessOfANarrowSeaInDeepWaterIsThreeTimesItsSteepness) {
  // One wave: ζ = a cos θ + ½ka² cos 2θ, E[ζ³] = 3/8 ka⁴, over (a²/2)^{3/2}.
  const double k = 1 / g;
  EXPECT_NEAR(second_order_skewness(sea_of({{1, 0.2, 0.4, 1}}, deep)),
              3.0 / 8 * k * std::pow(0.2, 4) / std::pow(0.02, 1.5), 1e-14);
}

TEST(SecondOrder, WeakPairsAreLeftOutByTheirEnergy) {
  const Sea sea = sea_of(crossing, water_of(12));
  const BoundWaves all = bound_harmonics(sea), some = bound_harmonics(sea, {.energy_left_out = 0.1});
  EXPECT_EQ(all.pairs, 10u + 6u);
  EXPECT_EQ(all.harmonics.size(), all.pairs);
  EXPECT_LT(some.harmonics.size(), all.harmonics.size());
  double kept = 0;
  for (const Harmonic& h : some.harmonics) kept += std::norm(h.elevation) / 2;
  EXPECT_NEAR(kept / all.variance, 1 - some.energy_left_out, 1e-13);
  EXPECT_LE(some.energy_left_out, 0.1);
  for (const Harmonic& h : all.harmonics) EXPECT_GE(h.omega, 0);
}

TEST(SecondOrder, BinsAtAPointAgreeWithTheListOfPairs) {
  const Water water = water_of(20);
  const auto spectrum = pierson_moskowitz(2, 8);
  const Sea sea =
      Sea::irregular(spectrum, {.bins = FftGrid{.repetition_s = 64}, .omega_min = 0.4, .omega_max = 2, .seed = 7},
                     {.mean = Angle::from_degrees(30)}, water);
  const Eigen::Vector3d point(12, -7, -3);
  const BoundAtPoint bins = bound_at_point(sea, point);
  HarmonicField::Options options;
  options.stretching = Stretching::none;
  const HarmonicField field(bound_harmonics(sea).harmonics, water, options);
  const TimeGrid grid{.dt_s = 0.5, .samples = 140, .start_s = 3.25};
  const auto eta = bins.series(bins.elevation, grid), u = bins.series(bins.u, grid), v = bins.series(bins.v, grid),
             w = bins.series(bins.w, grid);
  for (const std::size_t n : {0u, 1u, 55u, 139u}) {  // the last is past the repetition
    const Kinematics k = field.at(3.25 + 0.5 * static_cast<double>(n), point);
    EXPECT_NEAR(eta[n], k.elevation, 1e-12);
    EXPECT_NEAR(u[n], k.velocity.x(), 1e-12);
    EXPECT_NEAR(v[n], k.velocity.y(), 1e-12);
    EXPECT_NEAR(w[n], k.velocity.z(), 1e-12);
  }
}

TEST(SecondOrder, RefusesWhatItCannotDo) {
  const Sea sea = sea_of(crossing, water_of(12));
  EXPECT_THAT([&] { (void)bound_at_point(sea, {0, 0, -1}); }, ThrowsMessage<InputError>(HasSubstr("never repeats")));
  EXPECT_THAT([&] { (void)bound_harmonics(sea, {.energy_left_out = 1}); },
              ThrowsMessage<InputError>(HasSubstr("left out")));
  EXPECT_THAT([&] { (void)pair_kernel({0, 0, 0}, {1, 1, 0}, deep); }, ThrowsMessage<InputError>(HasSubstr("not zero")));
  const Current shear = Current::profile({-10, 0}, {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.5, 0)});
  EXPECT_THAT([&] { (void)bound_harmonics(sea_of(crossing, water_of(12), 1, shear)); },
              ThrowsMessage<InputError>(HasSubstr("sheared")));
  const Sea grid = Sea::irregular(pierson_moskowitz(2, 8),
                                  {.bins = FftGrid{.repetition_s = 64}, .omega_min = 0.4, .omega_max = 2, .seed = 7},
                                  {}, water_of(12));
  const BoundAtPoint bins = bound_at_point(grid, {0, 0, -1});
  EXPECT_THAT([&] { (void)bins.series(bins.u, {.dt_s = 0.7, .samples = 3}); },
              ThrowsMessage<InputError>(HasSubstr("divide")));
  EXPECT_THAT([&] { (void)bins.series(bins.u, {.dt_s = 2, .samples = 3}); },
              ThrowsMessage<InputError>(HasSubstr("Nyquist")));
  EXPECT_THAT([&] { (void)bound_at_point(grid, {0, 0, 1}); }, ThrowsMessage<InputError>(HasSubstr("still water")));
}

}  // namespace
}  // namespace hydro::waves::second_order_test
