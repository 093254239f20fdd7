// Plans of experiments: numbers that belong together, and lengths whose interval comes out as planned.
#include "fit/experiment.hpp"
#include "fit/problem/planned_tow.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "support/morison_records.hpp"

namespace experiment_test {
namespace {

using fit::complete;
using fit::OscillationNumbers;
using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double viscosity = 1.05e-6;

// The definitions, one by one.
void expect_consistent(const OscillationNumbers& n) {
  EXPECT_NEAR(*n.speed, 2 * pi * *n.amplitude / *n.period, 1e-12 * *n.speed);
  EXPECT_NEAR(*n.kc, *n.speed * *n.period / *n.diameter, 1e-12 * *n.kc);
  EXPECT_NEAR(*n.re, *n.speed * *n.diameter / viscosity, 1e-12 * *n.re);
  EXPECT_NEAR(*n.beta, *n.re / *n.kc, 1e-12 * *n.beta);
}

TEST(Oscillation, IsCompleteFromAnyThreeThatTellIt) {
  const OscillationNumbers all = complete({.diameter = 0.12, .amplitude = 0.54, .period = 4.62}, viscosity);
  expect_consistent(all);
  EXPECT_NEAR(*all.kc, 2 * pi * 0.54 / 0.12, 1e-10);
  using N = OscillationNumbers;
  const std::vector<std::optional<double> N::*> members{&N::diameter, &N::amplitude, &N::period, &N::speed,
                                                        &N::kc,       &N::re,        &N::beta};
  int told = 0, open = 0;
  for (std::size_t i = 0; i < members.size(); ++i)
    for (std::size_t j = i + 1; j < members.size(); ++j)
      for (std::size_t k = j + 1; k < members.size(); ++k) {
        N given;
        for (const std::size_t m : {i, j, k}) given.*members[m] = all.*members[m];
        try {
          const N again = complete(given, viscosity);
          for (const auto member : members) EXPECT_NEAR(*(again.*member), *(all.*member), 1e-9 * *(all.*member));
          ++told;
        } catch (const hydro::InputError&) {
          ++open;
        }
      }
  // 35 choices; five of them are of numbers of which two give the third: D A KC, A T U, D U Re, D T β, KC Re β.
  EXPECT_EQ(told, 30);
  EXPECT_EQ(open, 5);
}

TEST(Oscillation, SaysWhatIsLeftOpenAndWhatContradicts) {
  EXPECT_THAT([] { complete({.diameter = 0.12, .kc = 20}, viscosity); },
              ThrowsMessage<hydro::InputError>(HasSubstr("leaves open: period, speed, Re, beta")));
  EXPECT_THAT([] { complete({}, viscosity); }, ThrowsMessage<hydro::InputError>(HasSubstr("everything")));
  EXPECT_THAT([] { complete({.diameter = 0.12, .amplitude = 0.5, .period = 4, .kc = 30}, viscosity); },
              ThrowsMessage<hydro::InputError>(HasSubstr("contradicts itself")));
  EXPECT_THAT([] { complete({.diameter = -1, .amplitude = 0.5, .period = 4}, viscosity); },
              ThrowsMessage<hydro::InputError>(HasSubstr("diameter must be positive")));
  EXPECT_THROW(complete({.diameter = 1, .amplitude = 0.5, .period = 4}, 0), hydro::InputError);
}

fit::PlannedOscillation plan() {
  return {.cylinder = froude_test::moved_cylinder,
          .amplitude = 0.36,
          .period = 4,
          .cd = 1.2,
          .inertia = 1,
          .noise = 2,
          .memory = 0.1,
          .step = 0.02};
}

// White noise: σ_C = σ/√(Σ J²), and Σ J² of |u|u over whole periods is n (½ρDLU²)² 3/8.
TEST(PlannedLengths, OfWhiteNoiseHaveTheWidthOfTheirColumns) {
  auto white = plan();
  white.memory = 0;
  const auto& c = white.cylinder;
  const double u = 2 * pi * white.amplitude / white.period, unit = 0.5 * c.density * c.diameter * c.length * u * u,
               n = 20 * white.period / white.step, expected = 1.96 * white.noise / (unit * std::sqrt(3.0 / 8 * n));
  // The autoregression's own scatter: 5 % of a median over 40 records.
  EXPECT_NEAR(fit::told_by(white, 20, 40).cd_half_width, expected, 0.07 * expected);
}

TEST(PlannedLengths, ShrinkWithTheRootOfTheCyclesAndHoldTheTruth) {
  const auto a = fit::told_by(plan(), 10, 100), b = fit::told_by(plan(), 40, 100);
  EXPECT_NEAR(a.cd_half_width / b.cd_half_width, 2, 0.2);
  for (const double held : {a.cd_held, a.inertia_held, b.cd_held, b.inertia_held})
    EXPECT_GE(held, 0.88);  // 0.95 of 100, with a deviation of 2.2
}

TEST(PlannedLengths, ReachTheWidthThatIsAskedFor) {
  const double width = fit::told_by(plan(), 25).cd_half_width;
  const auto tried = fit::lengths_for(plan(), fit::Wanted::cd, width);
  ASSERT_FALSE(tried.empty());
  EXPECT_LE(tried.back().cd_half_width, width);
  EXPECT_NEAR(tried.back().cycles, 25, 6);  // bisection ends within a tenth; medians scatter by 5 %, cycles by 10 %
  for (std::size_t i = 1; i < tried.size(); ++i) EXPECT_LT(tried[i - 1].cycles, tried[i].cycles);
}

TEST(PlannedLengths, SayWhereNoLengthWithinReachIsEnough) {
  const auto tried = fit::lengths_for(plan(), fit::Wanted::cd, 1e-5, 24, 4);
  EXPECT_GT(tried.back().cd_half_width, 1e-5);
  EXPECT_LE(tried.back().cycles, 24);
}

TEST(PlannedLengths, RefuseWhatMakesNoSense) {
  auto p = plan();
  p.noise = 0;
  EXPECT_THAT([&] { fit::told_by(p, 5); }, ThrowsMessage<hydro::InputError>(HasSubstr("noise of the force")));
  p = plan();
  p.step = 1;
  EXPECT_THAT([&] { fit::told_by(p, 5); }, ThrowsMessage<hydro::InputError>(HasSubstr("eight samples")));
  EXPECT_THROW(fit::told_by(plan(), 1), hydro::InputError);
  EXPECT_THROW(fit::lengths_for(plan(), fit::Wanted::cd, 0), hydro::InputError);
}

fit::PlannedTow tow() {
  return {.cylinder = froude_test::moved_cylinder,
          .speed = 0.7,
          .acceleration = 1,
          .cd = 1.2,
          .noise = 0.3,
          .memory = 0.25,
          .step = 0.02};
}

// Of a correlation e^(−t/θ) the mean over T has the variance 2θ/T σ², where T is long against θ.
TEST(PlannedTows, HaveTheWidthOfTheMeanOfTheirForceAndHoldTheTruth) {
  auto p = tow();
  p.cylinder.mass_beyond_load_cells = 0;
  const auto& c = p.cylinder;
  const double unit = 0.5 * c.density * c.diameter * c.length * p.speed * p.speed;
  for (const int seconds : {40, 160}) {
    const auto told = fit::told_by(p, seconds, 60);
    const double expected = 1.96 * std::sqrt(2 * p.memory / seconds) * p.noise / unit;
    // Some of the beginning is cut, Student's t is larger than 1.96, and the autoregression scatters: a tenth.
    EXPECT_NEAR(told.half_width, expected, 0.12 * expected) << seconds;
    EXPECT_GE(told.held, 0.86) << seconds;  // 0.95 of 60, with a deviation of 0.028; three of them
    EXPECT_LE(told.refused, 0.2) << seconds;
  }
}

// Six memories long, a record tells less of its memory than there is: its intervals are narrow and do not hold.
TEST(PlannedTows, AreNotLongEnoughWhereTheirIntervalsDoNotHold) {
  auto p = tow();
  p.cylinder.mass_beyond_load_cells = 0;
  p.memory = 0.5;
  const auto shortest = fit::told_by(p, 3);
  EXPECT_FALSE(shortest.holds) << shortest.held;
  EXPECT_GT(fit::times_for(p, shortest.half_width).back().seconds, 3);
}

TEST(PlannedTows, ReachTheWidthThatIsAskedFor) {
  auto p = tow();
  p.cylinder.mass_beyond_load_cells = 0;
  const double width = fit::told_by(p, 60).half_width;
  const auto tried = fit::times_for(p, width);
  EXPECT_LE(tried.back().half_width, width);
  EXPECT_NEAR(tried.back().seconds, 60, 15);  // to a tenth, of medians that scatter by 5 %, times by 10 %
  EXPECT_TRUE(tried.back().holds);
  EXPECT_GT(fit::times_for(p, 1e-6, 24, 4).back().half_width, 1e-6);
  EXPECT_THROW(fit::times_for(p, 0), hydro::InputError);
  EXPECT_THAT([&] { fit::told_by(p, 2); }, ThrowsMessage<hydro::InputError>(HasSubstr("128 samples")));
  p.noise = 0;
  EXPECT_THAT([&] { fit::told_by(p, 60); }, ThrowsMessage<hydro::InputError>(HasSubstr("noise of the force")));
}

// Against the plain search of a cycle for the largest D sin|sin| + I cos, with drag leading, and with inertia that is
// more than twice of it.
TEST(LoadSizes, AreThoseOfAPlainSearch) {
  const fit::Cylinder cylinder{.diameter = 0.12,
                               .length = 0.5,
                               .density = 997,
                               .viscosity = {},
                               .experiment = fit::Experiment::body_moves,
                               .mass_beyond_load_cells = 2};
  for (const double kc : {2.0, 6.0, 25.0}) {
    const double period = 4, speed = kc * 0.12 / period, w = 2 * std::numbers::pi / period;
    const auto told = fit::load_sizes(cylinder, speed, period, 1.2, 1.1);
    const double drag = 0.5 * 997 * 1.2 * 0.12 * 0.5 * speed * speed,
                 inertia = (997 * 1.1 * std::numbers::pi / 4 * 0.12 * 0.12 * 0.5 + 2) * w * speed;
    double largest = 0;
    for (int i = 0; i < 100000; ++i) {
      const double t = i * period / 100000, u = std::sin(w * t);
      largest = std::max(largest, drag * u * std::abs(u) + inertia * std::cos(w * t));
    }
    EXPECT_NEAR(told.drag, drag, 1e-12 * drag);
    EXPECT_NEAR(told.inertia, inertia, 1e-12 * inertia);
    EXPECT_NEAR(told.largest, largest, 1e-8 * largest) << kc;  // a 100 000th of a turn off the top, squared
  }
}

TEST(LoadSizes, OfDragOverInertiaAreHendriksensEquation) {
  // F_D/F_I of a cylinder without other mass, Hendriksen (2023), equations 2.10 and 2.12.
  const fit::Cylinder cylinder{
      .diameter = 0.12, .length = 0.5, .density = 997, .viscosity = {}, .experiment = fit::Experiment::body_moves};
  const auto told = fit::load_sizes(cylinder, 0.6, 4, 1.2, 2);
  EXPECT_NEAR(told.drag / told.inertia, fit::drag_over_inertia(1.2, 0.6 * 4 / 0.12, 2), 1e-12);
  EXPECT_THROW(fit::drag_over_inertia(1.2, 0, 2), hydro::InputError);
  EXPECT_THROW(fit::load_sizes(cylinder, 0.6, -4, 1.2, 2), hydro::InputError);
}

TEST(SheddingFrequency, IsThatOfTheSource) {
  EXPECT_NEAR(fit::shedding_frequency_hz(0.25, 0.85, 0.12), 1.8, 0.05);  // Hendriksen (2023), 4.7.5, two digits
  EXPECT_THROW(fit::shedding_frequency_hz(0, 0.85, 0.12), hydro::InputError);
}

// From rest to U takes U²/2a, as does the way to rest: L = U²/a + U t.
TEST(SteadyTow, IsWhatTheRampsLeave) {
  EXPECT_DOUBLE_EQ(fit::steady_tow_s(60, 0.85, 1), 60 / 0.85 - 0.85);
  EXPECT_EQ(fit::steady_tow_s(1, 2, 1), 0);
  EXPECT_THROW(fit::steady_tow_s(0, 1, 1), hydro::InputError);
}

}  // namespace
}  // namespace experiment_test
