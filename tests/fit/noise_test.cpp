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

// 0.02 s of 4 s leave 0.8 of the residuals' variance and take ca seven half intervals away from what it is.
TEST(Delay, ThatMovesACoefficientFarBeyondItsIntervalLetsNoValueStand) {
  for (const double late : {0.02, -0.02, 0.1, 0.25}) {
    auto problem = moved_run({.position = 3e-4, .force = 0.5, .step_s = 0.02, .late_s = late}, 4);
    const auto found = solve(problem);
    const auto& run = found.runs.at(0);
    EXPECT_FALSE(run.fit.cd.value || run.fit.inertia.value) << late;
    ASSERT_EQ(run.prepared.cautions.size(), 1u) << late;
    EXPECT_THAT(run.prepared.cautions[0],
                testing::AllOf(testing::HasSubstr(late > 0 ? "s after the motion" : "s before the motion"),
                               testing::HasSubstr("half of an interval away")));
  }
}

TEST(Delay, ThatIsNoneIsNotSpokenOf) {
  // One right record in a thousand has a word said of it: of forty none, or one.
  int spoken = 0;
  std::string told;
  for (std::uint64_t set = 0; set < 40; ++set) {
    const auto solution = solve(moved_run({.position = 3e-4, .force = 1, .memory = 0.8, .step_s = 0.04}, set));
    for (const std::string& caution : solution.runs.at(0).prepared.cautions)
      if (caution.find("the force ") != std::string::npos) {
        ++spoken;
        told += caution + '\n';
      }
    EXPECT_TRUE(solution.runs.at(0).fit.inertia.value) << set;
  }
  EXPECT_LE(spoken, 1) << told;
}

/// Noise of 0.8 mm under 0.4 m, with derivatives to 1.5 Hz: 5 % of the acceleration's variance.
fit::morison::Problem noisy_motion(double late, std::uint64_t set) {
  auto problem = moved_run({.position = 8e-4, .force = 0.3, .step_s = 0.02, .late_s = late}, set);
  problem.options.prepare.derivative_bandwidth_hz = 1.5;
  return problem;
}

TEST(Delay, OfANoisyMotionHasNoBias) {
  // What noise takes from the inertia was told as a delay that is 0.03 s too short, and no interval of C_D held it.
  double mean = 0;
  int cd = 0, ca = 0, delay = 0;
  const auto holds = [](const fit::Interval& i, double truth) { return i.low < truth && truth < i.high; };
  for (std::uint64_t set = 0; set < 20; ++set) {
    auto problem = noisy_motion(0.05, set);
    problem.options.longest_delay = 0.3;
    const auto solution = solve(problem);
    ASSERT_FALSE(solution.runs.empty()) << set;
    const auto& fit = solution.runs[0].fit;
    mean += (fit.delay->interval.low + fit.delay->interval.high) / 40;
    cd += holds(fit.cd.interval, froude_test::moved_cd);
    ca += holds(fit.inertia.interval, froude_test::moved_ca);
    delay += holds(fit.delay->interval, 0.05);
  }
  // Errors of 0.006 s from run to run: the mean of 20 is good to 0.0014 s, and four of these are allowed.
  EXPECT_NEAR(mean, 0.05, 0.006);
  constexpr int enough = 15;  // of 20 with p = 0.95 fewer hold the truth in one test of 3000
  EXPECT_GE(cd, enough);
  EXPECT_GE(ca, enough);
  EXPECT_GE(delay, enough);
}

TEST(Delay, ThatIsNoneOfANoisyMotionIsNotSpokenOf) {
  for (std::uint64_t set = 0; set < 10; ++set) {
    const auto solution = solve(noisy_motion(0, set));
    EXPECT_TRUE(solution.runs.at(0).fit.cd.value) << set;
    EXPECT_THAT(solution.runs.at(0).prepared.cautions,
                testing::Not(testing::Contains(testing::HasSubstr("the motion (error"))))
        << set;
  }
}

TEST(MotionNoise, LeavesThePeriodOfANoisyMotionAsItIs) {
  // 4 mm under 0.4 m, with derivatives to five times the main frequency: 30 % of the acceleration's variance, by which
  // the period came out 16 % too short. What noise adds is known to a few per cent of itself, the period to half of it.
  for (std::uint64_t set = 0; set < 4; ++set) {
    const auto solution = solve(moved_run({.position = 4e-3, .force = 0.5, .step_s = 0.02}, set));
    EXPECT_NEAR(solution.runs.at(0).fit.period, 4, 0.1) << set;
  }
}

TEST(Delay, WhoseErrorIsStatedIsNotSpokenOfWithinIt) {
  auto problem = moved_run({.position = 3e-4, .force = 0.5, .step_s = 0.02, .late_s = 0.02}, 4);
  problem.options.force.delay_error_s = 0.02;
  const auto found = solve(problem);
  EXPECT_TRUE(found.runs.at(0).prepared.cautions.empty());
  const auto& ca = found.runs.at(0).fit.inertia;
  EXPECT_LT(ca.interval.low, froude_test::moved_ca);
  EXPECT_GT(ca.interval.high, froude_test::moved_ca);
}

TEST(Offset, ThatNobodyTookOffIsNamedWithTheKeyThatDoes) {
  auto problem = moved_run({.position = 3e-4, .force = 0.5, .step_s = 0.02}, 6);
  for (double& f : problem.runs[0].raw.force[0].values) f += 4;
  const auto found = solve(problem);
  EXPECT_THAT(found.runs.at(0).prepared.cautions,
              testing::Contains(testing::AllOf(testing::HasSubstr("those of a constant force of"),
                                               testing::HasSubstr("offset = true"))));
  problem.options.force.force_offset = true;
  EXPECT_TRUE(solve(problem).runs.at(0).prepared.cautions.empty());
}

TEST(Inertia, ThatNoStillWaterHasIsRefusedWithItsLikelyCause) {
  for (const double mass : {5.9, 2.0}) {
    auto problem = moved_run({.position = 3e-4, .force = 0.5, .step_s = 0.02}, 5);
    problem.runs[0].cylinder.mass_beyond_load_cells = mass;
    for (double& f : problem.runs[0].raw.force[0].values) f *= 1e-3;  // kN under a header of N
    const auto found = solve(problem);
    ASSERT_TRUE(found.report.refused) << mass;
    EXPECT_EQ(found.report.refused->reason, fit::Refusal::Reason::wrong_sign);
    EXPECT_THAT(found.report.refused->why, testing::HasSubstr("kN under [N]"));
  }
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
