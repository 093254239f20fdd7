#include "hydro/waves/kinematics/tank.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "hydro/waves/dispersion.hpp"

namespace hydro::waves::tank_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;
constexpr double g = 9.81, h = 0.994;
constexpr Complex i(0, 1);

const Water water{.density = 1000, .gravity = g, .depth = WaterDepth::from_metres(h)};
Tank tank_with(Paddle paddle, Reflections reflections = {}, int modes = 30, Stretching stretching = Stretching::none) {
  return {.length_m = 40,
          .water = water,
          .paddle = paddle,
          .reflections = reflections,
          .evanescent_modes = modes,
          .stretching = stretching};
}
const std::vector<double> frequencies{0.3, 2.0, 4.0, 9.0};

TEST(WaveTank, RatioOfWaveToStrokeIsBiesels) {
  // Biésel & Suquet (1951): height over stroke at the still water, for a piston and a flap hinged at the bed.
  for (const double omega : frequencies) {
    const double kh = wavenumber(omega, water) * h;
    const double piston = 2 * (std::cosh(2 * kh) - 1) / (std::sinh(2 * kh) + 2 * kh);
    const double flap =
        4 * std::sinh(kh) / kh * (kh * std::sinh(kh) - std::cosh(kh) + 1) / (std::sinh(2 * kh) + 2 * kh);
    EXPECT_NEAR(std::abs(TankMode(tank_with(Paddle::piston()), omega).biesel()) / piston, 1, 1e-13) << omega;
    EXPECT_NEAR(std::abs(TankMode(tank_with(Paddle::flap(-h)), omega).biesel()) / flap, 1, 1e-12) << omega;
  }
}

TEST(WaveTank, AHingeFarBelowTheBedIsAPiston) {
  const TankMode piston(tank_with(Paddle::piston()), 4), flap(tank_with(Paddle::flap(-1e7)), 4);
  for (const double x : {0.0, 0.2, 5.0}) EXPECT_NEAR(std::abs(piston.elevation(x) - flap.elevation(x)), 0, 1e-6);
}

TEST(WaveTank, EvanescentWavenumbersSolveTheirEquation) {
  for (const double omega : {0.01, 2.0, 9.0, 40.0}) {
    const TankMode mode(tank_with(Paddle::piston(), {}, 200), omega);
    for (std::size_t n = 0; n < 200; ++n) {
      const double y = mode.evanescent()[n] * h, top = (static_cast<double>(n) + 1) * pi;
      const double X = omega * omega * h / g;  // one rounding of y changes the equation by 1e-16 y (y + X)
      EXPECT_NEAR(y * std::sin(y) + X * std::cos(y), 0, 4e-16 * y * (y + X)) << n;
      EXPECT_GT(y, top - pi / 2);
      EXPECT_LT(y, top);
    }
  }
}

TEST(WaveTank, WaterMovesWithThePaddle) {
  // (W72): root mean square of u − iω s over the paddle, against iω; it falls like N^−3/2 for a flap, whose modes end
  // like 1/n² (a kink at a hinge above the bed, the corner at the surface), faster nowhere.
  const auto error = [](const Paddle& paddle, int modes) {
    const TankMode mode(tank_with(paddle, {}, modes), 4);
    double sum = 0;
    const int points = 2000;
    for (int m = 0; m < points; ++m) {
      const double z = -h + h * (m + 0.5) / points;
      sum += std::norm(mode.flow(0, z).u / (i * 4.0) - paddle.shape(z)) / points;
    }
    return std::sqrt(sum);
  };
  for (const Paddle& paddle : {Paddle::piston(), Paddle::flap(-h), Paddle::flap(-0.6), Paddle::flap(-1.7)}) {
    EXPECT_LT(error(paddle, 30), 2e-3);
    EXPECT_NEAR(std::log2(error(paddle, 20) / error(paddle, 40)), 1.5, 0.15);
  }
}

TEST(WaveTank, FulfilsLaplaceAndItsBoundaries) {
  const Tank tank = tank_with(Paddle::flap(-0.6), {.far_end = 1, .paddle = PaddleMode::absorbing});
  for (const double omega : frequencies) {
    const TankMode mode(tank, omega);
    for (const double x : {0.0, 0.1, 7.0, 40.0}) {
      EXPECT_NEAR(std::abs(mode.flow(x, -h).w), 0, 1e-14);
      const TankMode::Flow top = mode.flow(x, 0);  // −ω²φ + g ∂φ/∂z = 0
      EXPECT_NEAR(std::abs(-omega * omega * top.phi + g * top.w), 0, 1e-11 * omega * g) << omega << " " << x;
      // ∇²φ = 0 and the rates by central differences, error (κ d)²/6 with κ up to 30π/h
      const double d = 1e-5, z = -0.3;
      if (x == 0 || x == 40) continue;
      const TankMode::Flow f = mode.flow(x, z);
      const Complex ux = (mode.flow(x + d, z).u - mode.flow(x - d, z).u) / (2 * d);
      const Complex wz = (mode.flow(x, z + d).w - mode.flow(x, z - d).w) / (2 * d);
      const Complex wx = (mode.flow(x + d, z).w - mode.flow(x - d, z).w) / (2 * d);
      EXPECT_NEAR(std::abs(ux + wz), 0, 1e-6 * omega);
      EXPECT_NEAR(std::abs(ux - f.u_x), 0, 1e-6 * omega);
      EXPECT_NEAR(std::abs(wx - f.u_z), 0, 1e-6 * omega);
      EXPECT_NEAR(std::abs((mode.flow(x + d, z).phi - mode.flow(x - d, z).phi) / (2 * d) - f.u), 0, 1e-6 * omega);
    }
    EXPECT_NEAR(std::abs(mode.flow(40, -0.2).u), 0, 1e-12 * omega);  // the wall
  }
}

TEST(WaveTank, PowerOfThePaddleIsTheFluxOfEnergy) {
  // Mean of ∫ p u dz at x = 0, p = −iωρφ, against ½ρg|ζ|² c_g; midpoints, and modes cut off: 1e-5 for 3000 heights.
  for (const Paddle& paddle : {Paddle::piston(), Paddle::flap(-0.6), Paddle::flap(-1.7)})
    for (const double omega : frequencies) {
      const TankMode mode(tank_with(paddle), omega);
      double power = 0;
      const int points = 3000;
      for (int m = 0; m < points; ++m) {
        const TankMode::Flow f = mode.flow(0, -h + h * (m + 0.5) / points);
        power += 0.5 * (-i * omega * 1000.0 * f.phi * std::conj(f.u)).real() * h / points;
      }
      const double flux = 0.5 * 1000 * g * std::norm(mode.biesel()) * group_velocity(omega, water);
      EXPECT_NEAR(power / flux, 1, 1e-5) << omega;
    }
}

TEST(WaveTank, ABeachReflectsItsShare) {
  const TankMode mode(tank_with(Paddle::piston(), {.far_end = 0.3}), 4);
  double low = 1e9, high = 0;  // envelope over some lengths, away from the paddle
  for (double x = 10; x < 20; x += 0.005) {
    low = std::min(low, std::abs(mode.elevation(x)));
    high = std::max(high, std::abs(mode.elevation(x)));
  }
  EXPECT_NEAR((high - low) / (high + low), 0.3, 1e-4);  // steps of 5 mm: (kΔx)²/2
  EXPECT_NEAR((high + low) / 2 / std::abs(mode.biesel()), 1, 1e-4);
}

TEST(WaveTank, AWallMakesAStandingWaveWithItsNodes) {
  const TankMode mode(tank_with(Paddle::flap(-h), {.far_end = 1, .paddle = PaddleMode::reflecting}), 4);
  const double k = mode.k(), crest = std::abs(mode.elevation(40));
  for (int n = 0; n < 5; ++n) {
    EXPECT_NEAR(std::abs(mode.elevation(40 - (n + 0.5) * pi / k)), 0, 1e-12 * crest);
    EXPECT_NEAR(std::abs(mode.elevation(40 - (n + 1) * pi / k)), crest, 1e-12 * crest);
  }
  // Steady state by hand: φ = A cos k(L − x), −k sin… : ζ at the wall is Biésel's over |sin kL|.
  EXPECT_NEAR(crest * std::abs(std::sin(k * 40)) / std::abs(mode.biesel()), 1, 1e-12);
}

TEST(WaveTank, RoundTripsAddUpToTheSteadyState) {
  const auto elevation = [](int trips) {
    return TankMode(
               tank_with(Paddle::piston(), {.far_end = 0.5, .paddle = PaddleMode::reflecting, .round_trips = trips}), 4)
        .elevation(12);
  };
  const Complex steady = elevation(std::numeric_limits<int>::max());
  EXPECT_NEAR(std::abs(elevation(50) - steady), 0, 1e-14);  // 0.5⁵¹
  const Complex none =
      TankMode(tank_with(Paddle::piston(), {.far_end = 0.5, .paddle = PaddleMode::absorbing}), 4).elevation(12);
  EXPECT_NEAR(std::abs(elevation(0) - none), 0, 1e-14);
  EXPECT_GT(std::abs(elevation(1) - none), 0.1);
}

TEST(WaveTank, ReflectingPaddleMovesWithTheWaterAndAbsorbingOneLetsItThrough) {
  const TankMode wall(tank_with(Paddle::piston(), {.far_end = 0.7, .paddle = PaddleMode::reflecting}, 400), 4);
  for (const double z : {-0.2, -0.5, -0.9}) EXPECT_NEAR(std::abs(wall.flow(0, z).u - 4.0 * i), 0, 1e-2);
  const TankMode absorbing(tank_with(Paddle::piston(), {.far_end = 0.7, .paddle = PaddleMode::absorbing}, 400), 4);
  EXPECT_GT(std::abs(absorbing.flow(0, -0.2).u - 4.0 * i), 0.5);
}

TEST(WaveTank, IsTheSumOfItsModesAsAField) {
  const std::vector<RecordHarmonic> motion{{3.0, {0.02, 0.01}}, {5.0, {-0.01, 0.03}}};
  const WaveTank tank(tank_with(Paddle::flap(-h)), motion);
  const double t = 1.3;
  const Eigen::Vector3d p(2.5, 99, -0.4);
  const Kinematics k = tank.at(t, p);
  Complex zeta = 0, u = 0;
  for (const RecordHarmonic& m : motion) {
    zeta += TankMode(tank.tank(), m.omega).elevation(2.5) * m.amplitude * std::polar(1.0, m.omega * t);
    u += TankMode(tank.tank(), m.omega).flow(2.5, -0.4).u * m.amplitude * std::polar(1.0, m.omega * t);
  }
  EXPECT_DOUBLE_EQ(k.elevation, zeta.real());
  EXPECT_DOUBLE_EQ(k.elevation, tank.elevation(t, 2.5));
  EXPECT_DOUBLE_EQ(k.velocity.x(), u.real());
  EXPECT_EQ(k.velocity.y(), 0);
  // Acceleration, gradient by differences of 1e-5 (errors 1e-9 of the size), linear Bernoulli at the surface.
  const double d = 1e-5;
  const Eigen::Vector3d rate = (tank.at(t + d, p).velocity - tank.at(t - d, p).velocity) / (2 * d);
  EXPECT_LT((k.acceleration - rate).norm(), 1e-8);
  const Eigen::Vector3d up =
      (tank.at(t, p + d * Eigen::Vector3d::UnitZ()).velocity - tank.at(t, p - d * Eigen::Vector3d::UnitZ()).velocity) /
      (2 * d);
  EXPECT_LT((k.gradient.col(2) - up).norm(), 1e-8);
  EXPECT_NEAR(k.gradient.trace(), 0, 1e-16);
  EXPECT_NEAR(tank.at(t, {2.5, 0, 0}).dynamic_pressure, 1000 * g * k.elevation, 1e-9);
}

TEST(WaveTank, MotionForAWantedElevationGivesThatElevation) {
  const Tank tank = tank_with(Paddle::flap(-1.7), {.far_end = 0.1});
  const std::vector<RecordHarmonic> wanted{{2.5, {0.03, 0}}, {4.0, {0, 0.02}}, {7.0, {0.01, -0.01}}};
  const WaveTank made(tank, paddle_motion_for(tank, wanted, 29.88));
  for (const double t : {0.0, 0.7, 13.0}) {
    double expected = 0;
    for (const RecordHarmonic& w : wanted) expected += (w.amplitude * std::polar(1.0, w.omega * t)).real();
    EXPECT_NEAR(made.elevation(t, 29.88), expected, 1e-13);
  }
}

TEST(WaveTank, APaddleThatStartsFromRestSendsAFrontAtTheSpeedOfItsGroup) {
  // Ramped sine of 1.2 s for 30 s; at 20 m nothing before the fastest (long) waves, the sine behind its group's front.
  const double dt = 0.1, omega = 2 * pi / 1.2, x = 20;
  std::vector<double> motion(300);
  for (std::size_t n = 0; n < motion.size(); ++n) {
    const double t = static_cast<double>(n) * dt, ramp = std::min({1.0, t / 4, (30 - t) / 4});
    motion[n] = 0.02 * ramp * std::sin(omega * t);
  }
  const Band band{0.05, 11};
  const RecordSpectrum record = record_spectrum(motion, dt, arrival_time(water, band, x), band);
  EXPECT_LT(record.fraction_left_out, 1e-4);
  const WaveTank tank(tank_with(Paddle::piston(), {}, 5), record.harmonics);
  EXPECT_NEAR(tank.paddle(12.3), motion[123], 2e-3 * 0.02);  // what the band leaves out
  const double first = x / std::sqrt(g * h), front = x / group_velocity(omega, water);
  double early = 0, late = 0;
  for (double t = 0; t < first; t += 0.2) early = std::max(early, std::abs(tank.elevation(t, x)));
  for (double t = front + 8; t < front + 11; t += 0.05) late = std::max(late, std::abs(tank.elevation(t, x)));
  const double steady = 0.02 * std::abs(TankMode(tank.tank(), omega).biesel());
  EXPECT_LT(early, 5e-3 * steady);
  EXPECT_NEAR(late / steady, 1, 0.05);  // ripples of the ramp
}

TEST(WaveTank, RecordSpectrumGivesTheRecordBack) {
  std::vector<double> samples(64);
  for (std::size_t n = 0; n < 64; ++n) samples[n] = 0.3 * std::cos(2 * pi * 5 * static_cast<double>(n) / 64 + 0.4);
  const RecordSpectrum s = record_spectrum(samples, 0.25, 0, {0.1, 10});
  EXPECT_DOUBLE_EQ(s.repetition_s, 16);
  EXPECT_NEAR(std::abs(s.harmonics[4].amplitude - std::polar(0.3, 0.4)), 0, 1e-15);
  EXPECT_NEAR(s.fraction_left_out, 0, 1e-15);
  EXPECT_NEAR(record_spectrum(samples, 0.25, 0, {3, 10}).fraction_left_out, 1, 1e-15);
}

TEST(WaveTank, RefusesWhatIsNoTank) {
  const auto make = [](const Tank& tank, double omega = 4) { return [=] { TankMode(tank, omega); }; };
  Tank tank = tank_with(Paddle::piston());
  EXPECT_THAT(make(tank, 0), ThrowsMessage<InputError>(HasSubstr("frequency")));
  tank.water.depth = WaterDepth::infinite();
  EXPECT_THAT(make(tank), ThrowsMessage<InputError>(HasSubstr("bed")));
  EXPECT_THAT(make(tank_with(Paddle::piston(), {.far_end = 1.1})),
              ThrowsMessage<InputError>(HasSubstr("between 0 and 1")));
  EXPECT_THAT([] { Paddle::flap(0); }, ThrowsMessage<InputError>(HasSubstr("hinge")));
  tank = tank_with(Paddle::piston(), {.far_end = 1, .paddle = PaddleMode::reflecting});
  tank.length_m = 3 * pi / wavenumber(4, water);  // three half lengths
  EXPECT_THAT(make(tank), ThrowsMessage<InputError>(HasSubstr("resonates")));
  const WaveTank good(tank_with(Paddle::piston()), {{4, 0.1}});
  EXPECT_THAT([&] { (void)good.elevation(0, -0.1); }, ThrowsMessage<InputError>(HasSubstr("outside the tank")));
  EXPECT_THAT([&] { (void)good.at(0, Eigen::Vector3d(1, 0, -1)); },
              ThrowsMessage<InputError>(HasSubstr("below the bed")));
  EXPECT_THAT([] { WaveTank(tank_with(Paddle::piston()), {}); }, ThrowsMessage<InputError>(HasSubstr("none")));
  const std::vector<RecordHarmonic> slow{{1e-4, 0.1}};
  EXPECT_THAT([&] { (void)paddle_motion_for(tank_with(Paddle::flap(-0.01)), slow, 5); },
              ThrowsMessage<InputError>(HasSubstr("per metre")));
  EXPECT_THAT([] { (void)record_spectrum({}, 0.1, 0, {1, 2}); }, ThrowsMessage<InputError>(HasSubstr("got none")));
  const std::vector<double> one{1.0, 2.0};
  EXPECT_THAT([&] { (void)record_spectrum(one, 0.1, 0, {1, 40}); }, ThrowsMessage<InputError>(HasSubstr("band")));
}

}  // namespace
}  // namespace hydro::waves::tank_test
