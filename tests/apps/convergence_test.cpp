// What runs with longer and longer steps tell of the error of the first.
#include "answers/convergence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace convergence_test {
namespace {

using namespace froude;

constexpr Sizes in_its_unit{1, 1, 1};

/// cos t over 20 s, off by `error` times a shape that has the rms of the cosine.
froude::Run run_with(double error, double every = 0.1) {
  froude::Run out;
  out.signals = {{"x", "m", "", {}}};
  for (int i = 0; every * i <= 20 + 1e-9; ++i) {
    const double t = every * i;
    out.time.push_back(t);
    out.signals[0].values.push_back(std::cos(t) + error * std::sin(t));
  }
  return out;
}

constexpr double safety = 1.25;  // (E1)

TEST(Convergence, ExtrapolatesByTheOrderSeen) {
  for (const double order : {1.0, 1.5, 2.0}) {
    const auto at = [&](double step) { return run_with(std::pow(step, order)); };
    const froude::Run fine = at(0.01), twice = at(0.02), fourfold = at(0.04);
    const auto c = convergence({&fine, 1}, {&twice, 1}, Beside{&fourfold, 1}, 4, 0, in_its_unit);
    EXPECT_NEAR(c.ratio, std::pow(2, order), 1e-6);  // rounding of differences of 1e-4
    // rms of sin over these 20 s, which are no whole periods: 0.69.
    const froude::Run exact = run_with(0);
    EXPECT_NEAR(c.error, safety * difference({&fine, 1}, {&exact, 1}, 0, in_its_unit).rms, 1e-6 * c.error);
  }
}

TEST(Convergence, TakesNoMoreThanTheMethodsOrderAndNoLessThanOrderAHalf) {
  const froude::Run fine = run_with(0), twice = run_with(1e-3), fourfold = run_with(1e-1), alike = run_with(2.01e-3);
  const double d = difference({&fine, 1}, {&twice, 1}, 0, in_its_unit).rms;
  // Two runs that agree 24 times as well as errors of order 2 fall do so by chance.
  const double before = difference({&twice, 1}, {&fourfold, 1}, 0, in_its_unit).rms;
  EXPECT_DOUBLE_EQ(convergence({&fine, 1}, {&twice, 1}, Beside{&fourfold, 1}, 4, 0, in_its_unit).error,
                   safety * before / 4 / 3);
  EXPECT_DOUBLE_EQ(convergence({&fine, 1}, {&twice, 1}, Beside{&alike, 1}, 4, 0, in_its_unit).error,
                   safety * d / (std::sqrt(2.0) - 1));
  EXPECT_DOUBLE_EQ(convergence({&fine, 1}, {&twice, 1}, {}, 4, 0, in_its_unit).error, d);
}

// Samples twice as far apart lie at crests alone, where errors of phase are of second order.
TEST(Convergence, SeesByHowMuchErrorsFallWhereAllRunsAre) {
  const auto late = [](double phase, double every) {
    froude::Run out;
    out.signals = {{"x", "m", "", {}}};
    for (int i = 0; every * i <= 20 + 1e-9; ++i) {
      out.time.push_back(every * i);
      out.signals[0].values.push_back(std::cos((2 * std::numbers::pi + phase) * every * i));
    }
    return out;
  };
  const froude::Run fine = late(1e-5, 0.25), twice = late(4e-5, 0.25), fourfold = late(16e-5, 0.5),
                    exact = late(0, 0.25);
  const double off = difference({&fine, 1}, {&exact, 1}, 0, in_its_unit).rms;
  const double told = convergence({&fine, 1}, {&twice, 1}, Beside{&fourfold, 2}, 4, 0, in_its_unit).error;
  EXPECT_NEAR(told, safety * off, 1e-3 * off);  // φ²/2 of phases below 3.2e-3
}

TEST(Convergence, SeesErrorsOfStatisticsBesideALargeMean) {
  // 100 + (1 + e) cos t: e of the deviation and of what lies above the mean, but some e/100 of rms and extreme.
  const auto about_mean = [](double error) {
    froude::Run out = run_with(0);
    for (double& v : out.signals[0].values) v = 100 + (1 + error) * v;
    return out;
  };
  const froude::Run fine = about_mean(1e-2), twice = about_mean(4e-2), fourfold = about_mean(16e-2);
  const Sizes sizes = sizes_of(fine, 0)[0];
  EXPECT_NEAR(sizes.deviation, 1.01 * std::sqrt(0.5), 0.03);  // no whole periods
  const auto c = convergence({&fine, 1}, {&twice, 1}, Beside{&fourfold, 1}, 4, 0, sizes);
  EXPECT_NEAR(c.ratio, 4, 1e-6);
  EXPECT_NEAR(c.error, safety * 1e-2 / 1.01, 1e-6);
  EXPECT_LT(difference({&fine, 1}, {&twice, 1}, 0, sizes).rms, 3e-4);
}

TEST(Convergence, StatisticsOfTwoRunsMayAgreeByChance) {
  const froude::Run fine = run_with(0);
  froude::Run twice = fine, fourfold = fine;
  std::reverse(twice.signals[0].values.begin(), twice.signals[0].values.end());
  for (double& v : fourfold.signals[0].values) v *= 1.5;
  const Sizes statistics_alone{1e9, 1, 1};
  EXPECT_NEAR(difference({&fine, 1}, {&twice, 1}, 0, statistics_alone).statistics, 0, 1e-12);
  const double before = difference({&twice, 1}, {&fourfold, 1}, 0, statistics_alone).statistics;
  EXPECT_NEAR(before, 0.5, 1e-12);  // of the highest value, 1
  const auto c = convergence({&fine, 1}, {&twice, 1}, Beside{&fourfold, 1}, 4, 0, statistics_alone);
  EXPECT_LT(c.ratio, std::sqrt(2.0));
  EXPECT_NEAR(c.error, safety * before / std::sqrt(2.0) / (std::sqrt(2.0) - 1), 1e-12);
}

// What is dissipated grows with the time of the run, and is no measure of the motion.
TEST(Convergence, EnergiesAreJudgedBesideTheKineticOne) {
  froude::Run run = run_with(0);
  for (const char* name : {"energy.kinetic", "energy.pto.stored"}) {
    run.signals.push_back(run.signals[0]);
    run.signals.back().name = name;
  }
  run.signals[0].name = "energy.dissipated";
  for (Signal& s : run.signals) s.units = "J";
  for (double& v : run.signals[0].values) v *= 1e6;
  for (double& v : run.signals[2].values) v *= 1e-2;
  const std::vector<Sizes> sizes = sizes_of(run, 0);
  EXPECT_NEAR(sizes[1].rms, std::sqrt(0.5), 0.03);  // no whole periods
  EXPECT_NEAR(sizes[2].rms, 1e-2 * sizes[1].rms, 1e-12);
}

TEST(Convergence, ComparesSamplesThatRunsShare) {
  const froude::Run fine = run_with(0), sparse = run_with(1e-3, 0.4);
  EXPECT_NEAR(difference({&fine, 1}, {&sparse, 4}, 0, in_its_unit).rms, 1e-3 * std::sqrt(0.5),
              0.1e-3);                                                                   // few samples of the sine
  EXPECT_NEAR(difference({&fine, 1}, {&sparse, 4}, 0, in_its_unit, 0.1).rms, 0, 1e-12);  // sin 0
}

TEST(Convergence, JudgesSmallSignalsAgainstTheLargestOfTheirUnit) {
  froude::Run run = run_with(0);
  const double rms = sizes_of(run, 0)[0].rms;
  for (const auto& [units, share] : {std::pair<const char*, double>{"m", 1e-8}, {"m", 1e-2}, {"N", 1e-12}}) {
    run.signals.push_back(run.signals[0]);
    run.signals.back().units = units;
    for (double& v : run.signals.back().values) v *= share;
  }
  const auto out = sizes_of(run, 1e4);
  EXPECT_DOUBLE_EQ(out[1].rms, 1e-3 * rms);
  EXPECT_DOUBLE_EQ(out[2].rms, 1e-2 * rms);
  EXPECT_DOUBLE_EQ(out[3].rms, 1e-9 * 1e4);
  EXPECT_DOUBLE_EQ(out[2].extreme, 1e-2);
  EXPECT_DOUBLE_EQ(out[1].extreme, 1e-3 * rms);
}

TEST(Convergence, SeesUntilWhenRunsAgreeAndHowNeighboursPart) {
  froude::Run run = run_with(0), chaotic = run, drifting = run;
  for (std::size_t j = 0; j < run.time.size(); ++j) {
    chaotic.signals[0].values[j] += 1e-9 * std::exp(run.time[j]);
    drifting.signals[0].values[j] += 1e-9 * run.time[j];
  }
  // 1e-9 e^t passes 1e-3 at 13.8 s, within the block that begins at 13.6 s; its rms there does.
  EXPECT_NEAR(agrees_until({&run, 1}, {&chaotic, 1}, 0, 1e-3), 13.8, 0.4);
  EXPECT_DOUBLE_EQ(agrees_until({&run, 1}, {&drifting, 1}, 0, 1e-3), run.time.back());
  EXPECT_GT(growth(run, chaotic, 0, 1e-12), 1e6);
  // rms of t over the last third over that of its first three samples: 16.8/0.216.
  EXPECT_NEAR(growth(run, drifting, 0, 1e-12), 78, 2);
}

TEST(Convergence, DeviationIsFromATimeOn) {
  froude::Run run = run_with(0);
  for (std::size_t j = 0; j < run.time.size(); ++j)
    run.signals[0].values[j] = run.time[j] < 10 ? 100 : (j % 2 == 0 ? 3 : 5);
  EXPECT_NEAR(deviation(run, 0, 10), 1, 1e-3);  // an odd number of samples
}

}  // namespace
}  // namespace convergence_test
