// Records whose header names another unit than their numbers have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/problem/decay.hpp"
#include "fit/problem/radiation.hpp"
#include "fit/problem/regular_waves.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"
#include "support/coloured_noise.hpp"

namespace wrong_units_test {
namespace {

using hydro::InputError;
using std::numbers::pi;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A body of 120 kg on 2500 N/m with 80 kg of added mass and a damping of 100 N s/m, driven at these frequencies;
/// motion and force are written in other units by these factors.
fit::radiation::Problem driven(std::initializer_list<double> frequencies, double motion_factor,
                               double force_factor = 1) {
  fit::radiation::Problem out{.turns = false, .runs = {}, .body = {.mass = 120, .stiffness = 2500}, .options = {}};
  std::uint64_t seed = 0;
  for (const double omega : frequencies) {
    fit::radiation::Run run{.source = {.file = "run.csv"}, .time = {}, .motion = {}, .force = {}};
    const auto noise = froude_test::ar1_noise(2000, 0.5, 0.1, ++seed);
    for (std::size_t i = 0; i < 2000; ++i) {
      const double t = 0.02 * static_cast<double>(i), x = 0.05 * std::sin(omega * t),
                   v = 0.05 * omega * std::cos(omega * t);
      run.time.push_back(t);
      run.motion.push_back(motion_factor * x);
      run.force.push_back(force_factor * (noise[i] - (2500 - omega * omega * 200) * x - 100 * v));
    }
    out.runs.push_back(std::move(run));
  }
  return out;
}

TEST(WrongUnits, OfTheMotionAreToldByAForceThatMassAndStiffnessHardlyFeel) {
  EXPECT_THAT(
      [] {
        fit::radiation::solve(driven({2, 4, 6}, 100));
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("run.csv"), HasSubstr("do not go together with the body's"))));
  // One run whose added mass is negative says so by itself.
  EXPECT_THAT([] { fit::radiation::solve(driven({6}, 100)); }, ThrowsMessage<InputError>(HasSubstr("cm under [m]")));
  // The force in kN under [N] is as small.
  EXPECT_THAT(
      [] {
        fit::radiation::solve(driven({2, 6}, 1, 1e-3));
      },
      ThrowsMessage<InputError>(HasSubstr("cm under [m]")));
  // Metres under [cm] make a force that no mass can have.
  EXPECT_THAT([] { fit::radiation::solve(driven({2}, 0.01)); },
              ThrowsMessage<InputError>(HasSubstr("mass and added mass together come out negative")));
}

// At the natural frequency, √(2500/200) = 3.54 rad/s, a force is small by right; so it is with no mass given.
TEST(WrongUnits, AreNotSeenInARightRunAtTheNaturalFrequency) {
  EXPECT_FALSE(fit::radiation::solve(driven({3.5}, 1)).report.refused);
  EXPECT_FALSE(fit::radiation::solve(driven({3.5, 5}, 1)).report.refused);
  fit::radiation::Problem without = driven({2, 4, 6}, 100);
  without.body = {.mass = 0, .stiffness = 0};
  EXPECT_NO_THROW(fit::radiation::solve(without));
}

/// A wave of 30 mm and 1.6 s in 1.25 m of water, written with this factor.
fit::regular_waves::Problem waves(double factor) {
  const fit::WaveTank tank{.water = {.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(1.25)},
                           .gauge = 20,
                           .body = 23,
                           .end = 60};
  const double omega = 2 * pi / 1.6, k = hydro::waves::wavenumber(omega, tank.water);
  fit::regular_waves::Problem out{
      .runs = {{.source = {.file = "waves.csv"}, .time = {}, .elevation = {}, .responses = {{"heave", {}}}}},
      .units = {"m"},
      .options = {}};
  out.options.tank = tank;
  const auto noise = froude_test::ar1_noise(4500, 0.5, 0.0003, 7);
  for (std::size_t i = 0; i < 4500; ++i) {
    const double t = 0.02 * static_cast<double>(i);
    out.runs[0].time.push_back(t);
    out.runs[0].elevation.push_back(factor * (0.03 * std::cos(omega * t - k * 20) + noise[i]));
    out.runs[0].responses[0].values.push_back(0.04 * std::cos(omega * t - k * 23) + noise[(i + 100) % 4500]);
  }
  return out;
}

TEST(WrongUnits, OfWavesAreToldByWavesThatWouldBreak) {
  EXPECT_NO_THROW(fit::regular_waves::solve(waves(1)));
  EXPECT_THAT([] { fit::regular_waves::solve(waves(1000)); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("waves.csv"), HasSubstr("break above 0.5"))));
}

TEST(WrongUnits, OfAnAngleAreToldByMoreThanHalfATurn) {
  fit::decay::Problem problem{
      .turns = true, .runs = {{.source = {.file = "d.csv"}, .time = {}, .motion = {}}}, .body = {}, .options = {}};
  for (int i = 0; i < 600; ++i) {
    const double t = 0.1 * i;
    problem.runs[0].time.push_back(t);
    problem.runs[0].motion.push_back(11.5 * std::exp(-0.05 * t) * std::cos(1.2 * t));  // degrees under [rad]
  }
  EXPECT_THAT([&] { fit::decay::solve(problem); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("d.csv"), HasSubstr("more than half a turn"))));
}

}  // namespace
}  // namespace wrong_units_test
