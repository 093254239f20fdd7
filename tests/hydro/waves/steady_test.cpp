#include "hydro/waves/kinematics/steady.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/kinematics/limits.hpp"
#include "support/fresh_waters.hpp"

namespace hydro::waves::steady_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double pi = std::numbers::pi;
const double nan = std::numeric_limits<double>::quiet_NaN();

using support::deep;
using support::water_of;

// λ = 100 m at these ratios λ/h (0: infinite depth) and shares of the highest wave: the region table.
struct Place {
  double length_to_depth, share;
};
SteadyWaveInput at(const Place& p) {
  const Water water = p.length_to_depth == 0 ? deep : water_of(100 / p.length_to_depth);
  return {.height_m = p.share * highest_wave(100, water.depth), .length = Wavelength::from_metres(100), .water = water};
}

// The free-surface conditions asked of the field itself, at points and instants: pressure on the surface against ρgH,
// and w − ∂ζ/∂t − u ∂ζ/∂x against Hω, with ζ differenced over 1e-4 of a period and length (error of order 1e-8·j²).
struct Departure {
  double pressure = 0, kinematic = 0;
};
Departure departure(const SteadyWave& wave, Angle heading) {
  const HarmonicField field = wave.field(heading, 0.3);
  const double T = 2 * pi / wave.omega, d = 1e-4;
  const Eigen::Vector2d n(std::cos(heading.radians()), std::sin(heading.radians()));
  Departure worst;
  for (int s = 0; s < 40; ++s) {
    const double t = 0.37 * T + s * T / 40;
    const Eigen::Vector2d p = 3.1 * s * n;
    const double zeta = field.elevation(t, p.x(), p.y());
    const Kinematics k = field.at(t, {p.x(), p.y(), zeta});
    const double rate =
        (field.elevation(t + d * T, p.x(), p.y()) - field.elevation(t - d * T, p.x(), p.y())) / (2 * d * T);
    const Eigen::Vector2d ahead = p + d / wave.k * n, behind = p - d / wave.k * n;
    const double slope =
        (field.elevation(t, ahead.x(), ahead.y()) - field.elevation(t, behind.x(), behind.y())) * wave.k / (2 * d);
    const double along = k.velocity.head<2>().dot(n);
    worst.pressure = std::max(worst.pressure, std::abs(k.dynamic_pressure - 1000 * 9.81 * zeta) / (9810 * wave.height));
    worst.kinematic =
        std::max(worst.kinematic, std::abs(k.velocity.z() - rate - along * slope) / (wave.omega * wave.height));
  }
  return worst;
}

const std::vector<Place> region_table{{0, 0.2},  {0, 0.5},  {0, 0.8},  {0, 0.9},  {2, 0.5},
                                      {2, 0.8},  {5, 0.2},  {5, 0.8},  {10, 0.2}, {10, 0.5},
                                      {10, 0.9}, {20, 0.2}, {20, 0.8}, {30, 0.5}, {50, 0.5}};

TEST(StreamFunction, SolvesItsOwnEquationsOverTheRegionTable) {
  for (const Place& p : region_table) {
    const SteadyWave wave = stream_function(at(p));
    EXPECT_LT(wave.kinematic_residual, 1e-10) << p.length_to_depth << " " << p.share;  // the promise of the header
    EXPECT_LT(wave.dynamic_residual, 1e-10) << p.length_to_depth << " " << p.share;
    EXPECT_NEAR(wave.crest() - wave.trough(), wave.height, 1e-11 * wave.height);
    EXPECT_DOUBLE_EQ(wave.k, 2 * pi / 100);
  }
}

TEST(StreamFunction, FieldFulfilsTheConditionsOfTheFreeSurface) {
  for (const Place& p : {Place{0, 0.5}, Place{5, 0.8}, Place{20, 0.5}}) {
    SteadyWaveInput input = at(p);
    input.mean_flow = EulerianCurrent{0.7};
    const Departure worst = departure(stream_function(input), Angle::from_degrees(35));
    EXPECT_LT(worst.pressure, 1e-10) << p.length_to_depth;
    EXPECT_LT(worst.kinematic, 2e-6)
        << p.length_to_depth;  // (1e-4)²/6 times the third power of harmonics up to about ten
  }
}

TEST(StreamFunction, CrestPassesTheOriginWhenItsPhaseIsZero) {
  const SteadyWave wave = stream_function(at({5, 0.5}));
  const HarmonicField field = wave.field(Angle::from_degrees(20), -0.8);
  EXPECT_NEAR(field.elevation(0.8 / wave.omega, 0, 0), wave.crest(), 1e-12);
  // and half a length further on it is the trough's turn
  const double x = 50 * std::cos(pi / 9), y = 50 * std::sin(pi / 9);
  EXPECT_NEAR(field.elevation(0.8 / wave.omega, x, y), wave.trough(), 1e-12);
  EXPECT_NEAR(field.elevation(0.8 / wave.omega + 50 / wave.phase_velocity, x, y), wave.crest(), 1e-12);
}

TEST(StreamFunction, FrequencyAndLengthAskForTheSameWave) {
  for (const Place& p : {Place{0, 0.8}, Place{10, 0.5}, Place{30, 0.5}}) {
    for (const std::variant<EulerianCurrent, TransportVelocity>& flow :
         {std::variant<EulerianCurrent, TransportVelocity>(EulerianCurrent{-0.4}),
          std::variant<EulerianCurrent, TransportVelocity>(TransportVelocity{0})}) {
      SteadyWaveInput input = at(p);
      if (input.water.depth.is_infinite() && std::holds_alternative<TransportVelocity>(flow)) continue;
      input.mean_flow = flow;
      const SteadyWave by_length = stream_function(input);
      input.length = AngularFrequency::from_rad_per_s(by_length.omega);
      const SteadyWave by_frequency = stream_function(input);
      EXPECT_NEAR(by_frequency.k / by_length.k, 1, 1e-11);
      EXPECT_NEAR(by_frequency.omega / by_length.omega, 1, 1e-11);
      EXPECT_NEAR(by_frequency.crest(), by_length.crest(), 1e-9);
    }
  }
}

TEST(StreamFunction, TendsToTheLinearWave) {
  for (const double h : {5.0, 30.0}) {
    const Water water = water_of(h);
    const double k = 2 * pi / 100, H = 1e-3;
    const SteadyWave wave = stream_function({.height_m = H, .length = Wavelength::from_metres(100), .water = water});
    // Next terms are of order (kH)²/(kh)⁶ at most: 4e-9/1e-3.
    EXPECT_NEAR(wave.omega / angular_frequency(k, water), 1, 1e-5);
    EXPECT_NEAR(wave.elevation[0] / (H / 2), 1, 1e-5);
    EXPECT_NEAR(wave.potential[0] / (9.81 * H / 2 / wave.omega), 1, 1e-5);
    // Flux of the waves is energy over speed: ½ρga²/(ρc).
    EXPECT_NEAR(wave.wave_flux / (9.81 * H * H / 8 / wave.phase_velocity), 1, 1e-5);
  }
}

TEST(StreamFunction, SpeedInDeepWaterIsThatOfStokesSeries) {
  // c²k/g = 1 + ε² + ½ε⁴ + ¼ε⁶ + O(ε⁸) with ε = kH/2, and a next coefficient below one (Schwartz 1974).
  for (const double epsilon : {0.05, 0.1, 0.2}) {
    const double k = 2 * pi / 100, e2 = epsilon * epsilon;
    const SteadyWave wave =
        stream_function({.height_m = 2 * epsilon / k, .length = Wavelength::from_metres(100), .water = deep});
    const double c2 = wave.phase_velocity * wave.phase_velocity * k / 9.81;
    EXPECT_NEAR(c2, 1 + e2 + e2 * e2 / 2 + e2 * e2 * e2 / 4, std::pow(e2, 4) + 1e-14);
  }
}

TEST(StreamFunction, WavesTowardsTheHighestAreFasterByNineInAHundred) {
  // The highest deep-water wave has c/c₀ = 1.0923 at H/λ = 0.1411, the fastest 1.0930 at 0.1388 (Longuet-Higgins 1975;
  // Williams 1981); at H/λ = 0.134 the speed is just below both.
  const SteadyWave wave = stream_function(at({0, 0.95}), {.tolerance = 1e-7});
  const double c0 = std::sqrt(9.81 * 100 / (2 * pi));
  EXPECT_GT(wave.phase_velocity / c0, 1.089);
  EXPECT_LT(wave.phase_velocity / c0, 1.093);
}

TEST(StreamFunction, LongWavesRunLikeTheSolitaryWave) {
  // c² = g (h₀ + H) to first order in H/h₀ above the trough's depth h₀ (Rayleigh 1876), within H/h₀ squared over twenty
  // (Fenton 1972: F² = 1 + ε − ε²/20 …). λ/h = 50 leaves the trough flat: its own c must be that in water that rests.
  SteadyWaveInput input = at({50, 0.2});
  const SteadyWave wave = stream_function(input);
  const double h0 = 2 + wave.trough(), epsilon = wave.height / h0;
  const HarmonicField field = wave.field();
  const double u_trough = field.at(pi / wave.omega, {0, 0, wave.trough()}).velocity.x();  // current under the trough
  const double F2 = std::pow(wave.phase_velocity - u_trough, 2) / (9.81 * h0);
  // next term 3ε³/70 (2e-4 here), and what is left of the slope in the trough, e^{−κλ/2} of the height
  EXPECT_NEAR(F2, 1 + epsilon - epsilon * epsilon / 20, 1e-3);
}

TEST(StreamFunction, TransportIsTheMeanFluxThroughASection) {
  SteadyWaveInput input = at({10, 0.5});
  input.mean_flow = TransportVelocity{0};
  const SteadyWave wave = stream_function(input);
  const HarmonicField field = wave.field();
  // Mean over a period of ∫ u dz from bed to surface: 128 instants (spectral), 64 midpoints of z with Richardson.
  const auto flux = [&](int heights) {
    double sum = 0;
    for (int n = 0; n < 128; ++n) {
      const double t = n * 2 * pi / wave.omega / 128, zeta = field.elevation(t, 0, 0), dz = (zeta + 10) / heights;
      for (int m = 0; m < heights; ++m) sum += field.at(t, {0, 0, -10 + (m + 0.5) * dz}).velocity.x() * dz / 128;
    }
    return sum;
  };
  EXPECT_NEAR((4 * flux(40) - flux(20)) / 3, 0, 1e-6 * wave.wave_flux);
  EXPECT_NEAR(wave.eulerian_current, -wave.wave_flux / 10, 1e-12);
  EXPECT_NEAR(wave.transport_velocity, 0, 1e-12);
  EXPECT_LT(wave.eulerian_current, 0);
}

TEST(StreamFunction, GivenNumberOfHarmonicsIsKept) {
  const SteadyWave wave = stream_function(at({0, 0.8}), {.harmonics = 12});
  EXPECT_EQ(wave.elevation.size(), 12u);
  EXPECT_GT(wave.dynamic_residual, 1e-6);  // too few, and it says so
}

TEST(StreamFunction, RefusesWhatNoWaveCanBe) {
  const auto solve = [](const SteadyWaveInput& input) { return [input] { (void)stream_function(input); }; };
  SteadyWaveInput input = at({5, 0.5});
  input.height_m = 20;
  EXPECT_THAT(solve(input), ThrowsMessage<InputError>(HasSubstr("above the highest of its length")));
  input.length = AngularFrequency::from_period_s(9);
  EXPECT_THAT(solve(input), ThrowsMessage<InputError>(HasSubstr("too high")));
  input.height_m = nan;
  EXPECT_THAT(solve(input), ThrowsMessage<InputError>(HasSubstr("height")));
  input.height_m = 1;
  input.mean_flow = EulerianCurrent{-30};
  EXPECT_THROW(solve(input)(), InputError);
  EXPECT_THAT(
      solve({.height_m = 1, .length = Wavelength::from_metres(50), .water = deep, .mean_flow = TransportVelocity{0}}),
      ThrowsMessage<InputError>(HasSubstr("infinite")));
  EXPECT_THAT([] { Wavelength::from_metres(0); }, ThrowsMessage<InputError>(HasSubstr("positive, got 0 m")));
  EXPECT_THAT(
      [&] {
        (void)stream_function(at({5, 0.5}), {.harmonics = 3});
      },
      ThrowsMessage<InputError>(HasSubstr("4 to 512")));
}

TEST(StreamFunction, SaysWhenItsHarmonicsAreNotEnough) {
  EXPECT_THAT([] { (void)stream_function(at({0, 0.97})); }, ThrowsMessage<NumericsError>(HasSubstr("residual")));
}

TEST(Stokes, ResidualFallsWithTheOrderOfTheTheory) {
  // Half the height: 2⁶ less for the fifth order, 2³ for the second; one more power below and above for the next terms.
  for (const double h : {30.0, 15.0, 1e4}) {
    const auto ratio = [&](auto theory, double H) {
      const auto residual = [&](double height) {
        const SteadyWave w =
            theory(SteadyWaveInput{.height_m = height, .length = Wavelength::from_metres(100), .water = water_of(h)});
        return std::max(w.kinematic_residual, w.dynamic_residual) * height;  // residuals are relative to H
      };
      return std::log2(residual(H) / residual(H / 2));
    };
    EXPECT_NEAR(ratio(stokes_fifth, 1.0), 6, 0.2) << h;
    EXPECT_NEAR(ratio(stokes_second, 0.2), 3, 0.2) << h;
  }
}

TEST(Stokes, FifthOrderAgreesWithTheStreamFunction) {
  // Everything that the theory gives, from the fifth power of ε down; errors O(ε⁶) with coefficients of order one in
  // deep water (2 at most, seen), some tens at kh = 1.26.
  for (const double h : {1e3, 20.0}) {
    SteadyWaveInput input{.height_m = 3, .length = Wavelength::from_metres(100), .water = water_of(h)};
    input.mean_flow = TransportVelocity{0.2};
    const SteadyWave a = stokes_fifth(input), b = stream_function(input);
    const double e6 = std::pow(a.k * 1.5, 6), scale = h > 100 ? 3 : 50;
    EXPECT_NEAR(a.phase_velocity / b.phase_velocity, 1, scale * e6);
    EXPECT_NEAR(a.wave_flux / b.wave_flux, 1, scale * e6 / std::pow(a.k * 1.5, 2));
    EXPECT_NEAR(a.bernoulli, b.bernoulli, scale * e6 * 9.81 / a.k);
    EXPECT_NEAR(a.crest() * a.k, b.crest() * b.k, scale * e6);
    for (std::size_t j = 0; j < 5; ++j) {
      EXPECT_NEAR(a.elevation[j] * a.k, b.elevation[j] * b.k, scale * e6) << j;
      EXPECT_NEAR(a.potential[j] * a.k * a.k / a.omega, b.potential[j] * b.k * b.k / b.omega, scale * e6) << j;
    }
  }
}

// What fifth order leaves out of the stream function's results at ε, in units of k and g: for each number, with the
// last power of ε that the series holds. The next term is two powers up.
struct LeftOut {
  int power;
  double value;
};
std::vector<LeftOut> left_out_by_fifth_order(double epsilon, double kh) {
  const Water water{.density = 1000, .gravity = 1, .depth = WaterDepth::from_metres(kh)};
  const SteadyWaveInput input{.height_m = 2 * epsilon, .length = Wavelength::from_metres(2 * pi), .water = water};
  const SteadyWave a = stokes_fifth(input), b = stream_function(input);
  std::vector<LeftOut> out{
      {4, a.phase_velocity - b.phase_velocity}, {4, a.wave_flux - b.wave_flux}, {4, a.bernoulli - b.bernoulli}};
  for (std::size_t j = 0; j < 5; ++j) {
    const int power = j % 2 == 0 ? 5 : 4;
    out.push_back({power, a.elevation[j] - b.elevation[j]});
    out.push_back({power, a.potential[j] - b.potential[j]});
  }
  return out;
}

TEST(Stokes, EveryCoefficientIsTheOneOfTheStreamFunction) {
  // Left out: aε^m + bε^(m+2) + cε^(m+4) + …, where m is the last power of the series and a must be zero. Three ε give
  // a with an error of order ε⁶ times the next coefficient, which grows in shallow water, and of rounding, 1e-16/ε⁵:
  // together
  for (const double kh : {0.8, 1.2, 1.6, 3.0}) {
    const double scale = kh < 1 ? 0.5 : 1;
    const std::array<double, 3> epsilon{0.02 * scale, 0.03 * scale, 0.04 * scale};
    std::array<std::vector<LeftOut>, 3> left;
    for (std::size_t n = 0; n < 3; ++n) left[n] = left_out_by_fifth_order(epsilon[n], kh);
    for (std::size_t q = 0; q < left[0].size(); ++q) {
      double a = 0;  // Lagrange's extrapolation to ε² = 0
      for (std::size_t n = 0; n < 3; ++n) {
        double weight = 1;
        for (std::size_t m = 0; m < 3; ++m)
          if (m != n) weight *= epsilon[m] * epsilon[m] / (epsilon[m] * epsilon[m] - epsilon[n] * epsilon[n]);
        a += weight * left[n][q].value / std::pow(epsilon[n], left[n][q].power);
      }
      EXPECT_NEAR(a, 0, 2e-5) << "number " << q << " at kh = " << kh;
    }
  }
}

TEST(Stokes, SecondOrderIsTheTextbookWave) {
  const Water water = water_of(12);
  const SteadyWave wave = stokes_second({.height_m = 1, .length = AngularFrequency::from_period_s(7), .water = water});
  const double k = wavenumber(wave.omega, water), a = 0.5, T = std::tanh(k * 12);
  EXPECT_NEAR(wave.omega, 2 * pi / 7, 1e-15);
  EXPECT_NEAR(wave.k / k, 1, 1e-12);
  EXPECT_NEAR(wave.elevation[1], k * a * a / 4 * (3 - T * T) / (T * T * T), 1e-14);
  EXPECT_NEAR(wave.potential[1], 3.0 / 8 * wave.omega * a * a * std::cosh(2 * k * 12) / std::pow(std::sinh(k * 12), 4),
              1e-13);
  EXPECT_NEAR(wave.bernoulli, 9.81 * k * a * a / (2 * std::sinh(2 * k * 12)), 1e-14);
}

TEST(Stokes, DeepWaterIsTheLimitOfFiniteDepth) {
  const auto in = [](const Water& w) {
    return stokes_fifth({.height_m = 6, .length = Wavelength::from_metres(100), .water = w});
  };
  const SteadyWave a = in(deep), b = in(water_of(1e3));
  for (std::size_t j = 0; j < 5; ++j) {
    EXPECT_NEAR(a.elevation[j], b.elevation[j], 1e-13);
    EXPECT_NEAR(a.potential[j], b.potential[j], 1e-12);
  }
  EXPECT_NEAR(a.phase_velocity, b.phase_velocity, 1e-13);
  EXPECT_EQ(a.transport_velocity, 0);
}

TEST(Stokes, SaysThatLongWavesAreNotItsOwn) {
  EXPECT_THAT([] { (void)stokes_fifth(at({30, 0.5})); }, ThrowsMessage<NumericsError>(HasSubstr("stream function")));
}

}  // namespace
}  // namespace hydro::waves::steady_test
