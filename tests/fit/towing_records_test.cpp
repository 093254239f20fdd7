// Towing from records: the way from raw channels to the numbers of a table.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/problem/towing.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"
#include "support/coloured_noise.hpp"
#include "support/reference_data.hpp"

namespace towing_records_test {
namespace {

using fit::towing::Problem;
using testing::HasSubstr;
using testing::ThrowsMessage;

const fit::Cylinder cylinder{
    .diameter = 0.12, .length = 0.5, .density = 997, .viscosity = 1.05e-6, .experiment = fit::Experiment::body_moves};
constexpr double step = 0.01, rest_s = 10, tow_s = 60;

/// What a run has: means and deviations of speed and force in the steady part.
struct Truth {
  double speed, speed_deviation, force, force_deviation;
};

/// Rest, 1 m/s², the tow, as fast to rest. The force acts against the speed in one cell with a zero of 2 N; the noise
/// of the force has a memory of `memory_s`, the structure vibrates at 8 Hz, the wake takes a second to settle.
fit::RawTow recorded(const Truth& truth, std::uint64_t seed, double memory_s = 0.3) {
  const double ramp = truth.speed;  // s
  const auto n = static_cast<std::size_t>((2 * rest_s + tow_s + 2 * ramp) / step);
  const auto slow = froude_test::ar1_noise(n, std::exp(-step / memory_s), truth.force_deviation, seed);
  const auto fast = froude_test::ar1_noise(n, 0, truth.speed_deviation, seed + 100000);
  fit::RawTow out;
  std::vector<double> force(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = step * static_cast<double>(i), s = t - rest_s,
                 u = std::clamp(std::min(s, 2 * ramp + tow_s - s), 0.0, truth.speed);
    const bool moves = u > 0;
    const double wake = s > ramp ? 1 + 0.2 * std::exp(-(s - ramp)) : 1.0;
    const double inertia = moves && u < truth.speed ? (s < ramp ? 10.0 : -10.0) : 0.0;
    out.time.push_back(t);
    out.speed.push_back(u + (moves ? fast[i] : 0));
    force[i] = 2 - truth.force * std::pow(u / truth.speed, 2) * wake - inertia - (moves ? slow[i] : 0) +
               (moves ? 0.8 * std::sin(2 * std::numbers::pi * 8 * t) : 0.0);
  }
  for (double& f : force) f = -f;  // as "-F" does
  out.force = {{"F", std::move(force), {}}};
  return out;
}

Problem problem_of(std::vector<fit::RawTow> runs) {
  Problem out{.cylinder = cylinder, .runs = {}, .records = {}, .options = {}};
  for (std::size_t i = 0; i < runs.size(); ++i)
    out.records.push_back({{fmt::format("tow_{}.csv", i + 1)}, std::move(runs[i])});
  out.options.zero_at_rest = true;
  out.options.prepare.filters = {{.kind = fit::FilterChoice::Kind::butterworth, .order = 4, .hz = 4}};
  return out;
}

TEST(TowingRecords, GiveTheNumbersOfTheTableWhoseNoiseTheyHave) {
  FROUDE_REQUIRE_DATA(path, "thesis-tables/hendriksen_table6_1_towing.csv");
  const auto table = hydro::io::CsvTable::read(path);
  std::vector<fit::RawTow> runs;
  for (std::size_t i = 0; i < table.rows(); ++i)
    runs.push_back(recorded({table.column("velocity_mean_m_s")[i], table.column("velocity_sd")[i],
                             table.column("force_mean_N")[i], table.column("force_sd")[i]},
                            10 + i));
  const auto found = solve(problem_of(std::move(runs)));
  ASSERT_EQ(found.records.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& r = found.records[i];
    const auto is = [&](const char* name) { return table.column(name)[i]; };
    // Means within three standard errors: sd √(2 · 0.3 s/60 s) of the force, sd/√6000 of the speed.
    EXPECT_NEAR(r.speed.value, is("velocity_mean_m_s"), 3 * is("velocity_sd") / std::sqrt(6000.0)) << i;
    EXPECT_NEAR(r.force.value, is("force_mean_N"), 3 * 0.1 * is("force_sd")) << i;
    // Deviations: of 100 independent samples within 3/√200; the table's own two digits are known to 7 %.
    EXPECT_NEAR(r.speed.deviation, is("velocity_sd"), 0.05 * is("velocity_sd")) << i;
    EXPECT_NEAR(r.force.deviation, is("force_sd"), 0.25 * is("force_sd")) << i;
    EXPECT_NEAR(*r.cd.value, is("force_mean_N") / (0.5 * 997 * 0.06 * std::pow(is("velocity_mean_m_s"), 2)),
                3 * 0.1 * is("cd_sd") + 1e-4);
    EXPECT_NEAR(r.samples.deviation, is("cd_sd"), 0.3 * is("cd_sd")) << i;
    EXPECT_NEAR(100 * r.samples.coefficient_of_variation(), is("cd_cov_pct"), 0.3 * is("cd_cov_pct")) << i;
  }
}

/// A tow of 50 s whose force has noise of 1 N with this memory all the time, also in the rest before it, and a zero.
fit::RawTow noisy(double cd, double memory_s, double rest_for_s, std::uint64_t seed) {
  constexpr double speed = 0.8, between = 0.02;
  const auto n = static_cast<std::size_t>((55 + rest_for_s) / between);
  const auto noise = froude_test::ar1_noise(n, std::exp(-between / memory_s), 1, seed);
  fit::RawTow out;
  std::vector<double> force;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = between * static_cast<double>(i), u = speed * std::clamp((t - rest_for_s) / 2, 0.0, 1.0) *
                                                           std::clamp((50 + rest_for_s - t) / 2, 0.0, 1.0);
    out.time.push_back(t);
    out.speed.push_back(u);
    force.push_back(0.5 * 997 * 0.06 * cd * u * u + 0.7 + noise[i]);
  }
  out.force = {{"F", std::move(force), {}}};
  return out;
}

// Few samples of a short rest do not know the correlation time of their noise; the steady part does.
TEST(TowingRecords, CountTheMemoryOfTheNoiseInAShortRest) {
  constexpr double cd = 1.1;
  int held = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto interval = solve(problem_of({noisy(cd, 1, 4, 900 + seed)})).records[0].cd.interval;
    held += interval.low < cd && cd < interval.high ? 1 : 0;
  }
  EXPECT_GE(held, 50);  // binomial with p = 0.95 and 60 tows: 57 ± 1.7; four deviations below
}

// Noise of 2 s, of which a tow of 46 s holds eleven independent samples: scatter and memory from so few are too small,
// and a normal law about the zero was too narrow.
TEST(TowingRecords, CountThatFewSamplesTellTheErrorOfTheZero) {
  constexpr double cd = 1.1;
  int held = 0, told = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    const double rest = seed % 2 == 0 ? 4 : 6;
    try {
      const auto interval = solve(problem_of({noisy(cd, 2, rest, 5000 + seed / 2)})).records[0].cd.interval;
      held += interval.low < cd && cd < interval.high ? 1 : 0;
      ++told;
    } catch (const hydro::InputError&) {  // a record that does not settle
    }
  }
  EXPECT_GE(told, 110);
  EXPECT_GE(held, 0.9 * told);
}

TEST(TowingRecords, MayHaveSamplesWhoseNoiseTurnsTheirSign) {
  Problem problem = problem_of({noisy(0.15, 0.1, 10, 1)});  // 1.4 N with noise of 1 N
  problem.options.prepare.filters.clear();
  const auto found = solve(problem);
  EXPECT_NEAR(*found.records[0].cd.value, 0.15, 4 * found.records[0].cd.standard_error);
}

TEST(TowingRecords, HoldTheTruthAsOftenAsTheySay) {
  const Truth truth{0.545, 0.0012, 10.44, 0.12};
  const double cd = truth.force / (0.5 * 997 * 0.06 * truth.speed * truth.speed);
  int held = 0, of = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto found = solve(problem_of({recorded(truth, 500 + seed)}));
    const auto& interval = found.records[0].cd.interval;
    held += interval.low < cd && cd < interval.high ? 1 : 0;
    ++of;
  }
  EXPECT_GE(held, 52) << of;  // 57 of 60 expected, with a deviation of 1.7
}

TEST(TowingRecords, CutTheRunUpAndTheWayBack) {
  const auto found = solve(problem_of({recorded({0.8, 0.001, 25, 0.2}, 1)})).records[0];
  const auto& time = found.prepared.time;
  EXPECT_GT(time[found.steady.from], rest_s + 0.8);
  EXPECT_LT(time[found.steady.from], rest_s + 0.8 + 15);
  EXPECT_GT(time[found.steady.to - 1], rest_s + 0.8 + tow_s - 1);
  EXPECT_LT(time[found.steady.to - 1], rest_s + 0.8 + tow_s);
}

TEST(TowingRecords, CountWhatIsTheSameInAllRunsOnce) {
  std::vector<fit::RawTow> runs;
  for (std::uint64_t i = 0; i < 4; ++i) runs.push_back(recorded({0.7, 0.001, 17, 0.15}, 40 + i));
  auto problem = problem_of(runs);
  const auto without = solve(problem);
  problem.options.errors.diameter = 0.012;  // a tenth
  const auto with = solve(problem);
  EXPECT_NEAR(with.records[0].cd.systematic_error, 0.1 * *with.records[0].cd.value, 1e-12);
  const auto half = [](const fit::towing::Solution& s) {
    return (s.law->intervals[0].high - s.law->intervals[0].low) / 2;
  };
  ASSERT_TRUE(with.law && without.law);
  EXPECT_DOUBLE_EQ(with.law->coefficients[0], without.law->coefficients[0]);
  EXPECT_NEAR(half(with), std::hypot(half(without), 1.959964 * 0.1 * with.law->coefficients[0]), 1e-4);
}

// A slope that is known to 1 % makes every force wrong by as much, and C_D with it, the same in all runs.
TEST(TowingRecords, CountTheErrorOfTheSlopeOfACell) {
  auto problem = problem_of({recorded({0.7, 0.001, 17, 0.15}, 40)});
  fit::ForceChannel& cell = problem.records[0].raw.force[0];
  for (double& v : cell.values) v *= 0.02;  // V/N
  cell.calibration.emplace();
  cell.calibration->slope = 0.02;
  cell.calibration->slope_error = 0.01 * 0.02;
  const auto cd = solve(problem).records[0].cd;
  EXPECT_NEAR(cd.systematic_error, 0.01 * *cd.value, 1e-6);
}

TEST(TowingRecords, TakeASpanThatIsNamed) {
  auto problem = problem_of({recorded({0.7, 0.001, 17, 0.15}, 7)});
  problem.options.prepare.window = {.kind = fit::WindowChoice::Kind::span, .from = 30, .to = 50};
  const auto found = solve(problem).records[0];
  EXPECT_NEAR(found.prepared.time[found.steady.from], 30, step);
  EXPECT_NEAR(found.prepared.time[found.steady.to - 1], 50, step);
  problem.options.prepare.window.to = 500;
  EXPECT_THAT([&] { solve(problem); }, ThrowsMessage<hydro::InputError>(HasSubstr("does not lie in what is left")));
}

TEST(TowingRecords, RefuseWhatIsNoTow) {
  const Truth truth{0.7, 0.001, 17, 0.15};
  auto wrong = recorded(truth, 3);
  for (double& f : wrong.force[0].values) f = -f;
  EXPECT_THAT([&] { solve(problem_of({wrong})); },
              ThrowsMessage<hydro::InputError>(testing::AllOf(HasSubstr("tow_1.csv"), HasSubstr("wrong sign"))));
  auto drifts = recorded(truth, 3);
  for (std::size_t i = 0; i < drifts.time.size(); ++i) drifts.force[0].values[i] += 0.2 * drifts.time[i];
  EXPECT_THAT([&] { solve(problem_of({drifts})); }, ThrowsMessage<hydro::InputError>(HasSubstr("does not settle")));
  auto late = recorded(truth, 3);
  for (auto* column : {&late.time, &late.speed, &late.force[0].values})
    column->erase(column->begin(), column->begin() + static_cast<std::ptrdiff_t>(rest_s / step) - 50);
  EXPECT_THAT([&] { solve(problem_of({late})); }, ThrowsMessage<hydro::InputError>(HasSubstr("too little")));
}

}  // namespace
}  // namespace towing_records_test
