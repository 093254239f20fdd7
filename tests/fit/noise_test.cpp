#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/problem/decay.hpp"
#include "fit/problem/morison.hpp"
#include "fit/sensor_noise.hpp"
#include "support/noisy_runs.hpp"

namespace noise_test {
namespace {

using froude_test::decay_in_steps;
using froude_test::moved_run;
using froude_test::Noise;

TEST(SensorNoise, OfRoundingHasTheVarianceOfATwelfthOfAStepSquared) {
  std::vector<double> signal;
  for (int j = 0; j < 4000; ++j) signal.push_back(3 * std::sin(0.0371 * j));
  double squares = 0;
  for (std::uint64_t draw = 0; draw < fit::noise_draws; ++draw)
    for (const double e : drawn_error(signal, {.deviation = 0, .step = 0.1}, fit::DrawnError::rounding, 1, draw))
      squares += e * e;
  // Even within ±δ/2; 128 000 samples that cross a step in one to fifty: the mean square is good to a few per cent.
  EXPECT_NEAR(squares / (4000 * fit::noise_draws) / (0.01 / 12), 1, 0.03);
}

TEST(SensorNoise, PartsAddUpToTheWhole) {
  EXPECT_DOUBLE_EQ(fit::sensor_noise(0.5, 0.6).total(), 0.5);
  EXPECT_EQ(fit::sensor_noise(0.1, 0.6).deviation, 0);  // less than rounding alone
  EXPECT_TRUE(fit::sensor_noise(0.3, 0.6).rounds_with_memory());
  EXPECT_FALSE(fit::sensor_noise(0.5, 0.6).rounds_with_memory());  // 0.47 of white noise, over half a step
}

TEST(MotionNoise, DoesNotBiasInertia) {
  // Noise of 2 mm is 10 % of the derived acceleration's variance: least squares alone is 0.20 too low (2.05 of added
  // and other mass), with a scatter of 0.013 from run to run. The mean of 40 runs is good to 0.0025.
  double mean = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const auto solution = solve(moved_run({.position = 2e-3, .force = 1, .step_s = 0.02}, i));
    mean += *solution.runs[0].fit.inertia.value / 40;
  }
  EXPECT_NEAR(mean, froude_test::moved_ca, 0.01);
}

struct Share {
  double first = 0, second = 0;
};

Share coverage_of_forces(const Noise& noise, int sets) {
  Share share;
  const auto holds = [](const fit::Interval& i, double truth) { return i.low < truth && truth < i.high; };
  for (int i = 0; i < sets; ++i) {
    const auto solution = solve(moved_run(noise, static_cast<std::uint64_t>(i)));
    share.first += holds(solution.runs[0].fit.cd.interval, froude_test::moved_cd) / static_cast<double>(sets);
    share.second += holds(solution.runs[0].fit.inertia.interval, froude_test::moved_ca) / static_cast<double>(sets);
  }
  return share;
}

// Of 60 sets with p = 0.95 fewer than 50 hold the truth in one test of 3000.
constexpr int sets = 60;
constexpr double least = 50.0 / sets;

TEST(MotionNoise, IsCoveredByTheIntervals) {
  const Share share = coverage_of_forces({.position = 0.5e-3, .force = 1, .step_s = 0.02}, sets);
  EXPECT_GE(share.first, least);
  EXPECT_GE(share.second, least);
}

TEST(MotionNoise, OfAPositionInStepsIsCovered) {
  const Share share = coverage_of_forces({.force = 0.5, .position_step = 0.008, .step_s = 0.01}, sets);
  EXPECT_GE(share.first, least);
  EXPECT_GE(share.second, least);
}

// Steps of 2 % of the force, next to no noise, and 80 samples in each period: rounding is the same in every cycle.
TEST(ForceInSteps, IsCoveredByTheIntervals) {
  for (const double noise : {0.0, 0.015}) {
    const Share share = coverage_of_forces({.force = noise, .force_step = 0.3}, sets);
    EXPECT_GE(share.first, least) << noise;
    EXPECT_GE(share.second, least) << noise;
  }
}

TEST(DecayInSteps, IsCoveredByTheIntervals) {
  // Steps of 2 % of the amplitude at 100 Hz: a sample moves by a twentieth of a step where the body turns. Each set
  // takes a second; of 20 with p = 0.95 fewer than 15 hold the truth in one test of 3000.
  constexpr int decays = 20;
  constexpr double enough = 15.0 / decays;
  double period = 0, linear = 0;
  for (int i = 0; i < decays; ++i) {
    const auto [problem, omega] = decay_in_steps(0.003, 0.01, static_cast<std::uint64_t>(i));
    const auto solution = solve(problem);
    ASSERT_FALSE(solution.runs.empty()) << i;
    const auto& fit = solution.runs[0].fit;
    const double truth = 2 * std::numbers::pi / omega;
    period += (fit.period.interval.low < truth && truth < fit.period.interval.high) / static_cast<double>(decays);
    const auto& b = fit.damping[0].interval;
    linear += (b.low < froude_test::decay_linear && froude_test::decay_linear < b.high) / static_cast<double>(decays);
  }
  EXPECT_GE(period, enough);
  EXPECT_GE(linear, enough);
}

TEST(Delay, ThatNobodyAskedForIsNamedAndNoValueTold) {
  auto problem = moved_run({.force = 0.1, .step_s = 0.02, .late_s = 0.2}, 1);
  const auto found = solve(problem);
  const auto& fit = found.runs.at(0).fit;
  EXPECT_FALSE(fit.cd.value || fit.inertia.value);
  // The cubic between samples is good to 1e-6 of the force, noise to less than a hundredth of a second.
  EXPECT_THAT(fit.cd.why_not,
              testing::AllOf(testing::HasSubstr("0.2 s after the motion"), testing::HasSubstr("delay = \"0.2 s\"")));
  problem.options.prepare.delay_s = 0.2;
  EXPECT_NEAR(*solve(problem).runs.at(0).fit.inertia.value, froude_test::moved_ca, 0.01);
}

TEST(Aicc, ComparesTermsByTheSameNumberOfSamples) {
  auto [problem, omega] = decay_in_steps(0, 0.05, 3);
  problem.options.accept_residuals = true;  // one term alone does not explain this motion
  problem.options.motion.terms = {.linear = true};
  const double one = solve(problem).runs.at(0).fit.independent;
  problem.options.motion.terms = {.linear = true, .quadratic = true};
  const double two = solve(problem).runs.at(0).fit.independent;
  // The same fit from other starts: its search ends within 1e-12 of the cost.
  EXPECT_NEAR(one / two, 1, 1e-3);
}

}  // namespace
}  // namespace noise_test
