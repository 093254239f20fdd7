// What accuracy costs: errors against closed forms, the choice, and what is written.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "answers/cost_error.hpp"
#include "froude/scene.hpp"
#include "hydro/base/error.hpp"

namespace froude_test::cost {
namespace {

using froude::AnswerCost, froude::CostRung, froude::ErrorMeasure, froude::Signal;
using testing::HasSubstr;

// ω = √(k/m) = 2 rad/s. The rule of rho_infinity = 1 is the trapezium rule, whose frequency is known at every step.
constexpr const char* oscillator = R"(schema = 1
[water]
density = "1025 kg/m^3"
depth = "infinite"
[[body]]
name = "block"
mass = "100 kg"
free = "surge"
initial = { surge = "20 cm" }
[[mooring]]
on = "block"
kind = "linear"
stiffness = { surge = "400 N/m" }
[ask]
run = { duration = "10 s", every = "0.2 s", of = ["block.surge"] }
[solve]
step = "0.05 s"                 # by hand
integrator = { rho_infinity = 1 }
)";

double error(const CostRung& rung, ErrorMeasure measure) { return rung.error[static_cast<std::size_t>(measure)].error; }

/// Rms of cos ω't − cos ωt over that of cos ωt, at the samples, for the trapezium rule: tan(ω'h/2) = ωh/2.
double error_of_trapezium(double h) {
  const double omega = 2, stepped = 2 / h * std::atan(omega * h / 2);
  double off = 0, size = 0;
  for (int i = 0; i <= 50; ++i) {
    const double t = 0.2 * i;
    off += std::pow(std::cos(stepped * t) - std::cos(omega * t), 2);
    size += std::pow(std::cos(omega * t), 2);
  }
  return std::sqrt(off / size);
}

TEST(Cost, ErrorOfEachStepIsThatOfItsPeriod) {
  const auto cost = froude::parse(oscillator).cost({.repeat_for_s = 0});
  const AnswerCost& run = cost.answers.front();
  int steps = 0;
  for (const CostRung& rung : run.rungs) {
    if (rung.approximation != "step") continue;
    const double h = std::stod(rung.setting);
    // The reference is off by what it says: of the order of its own tolerance, 1e-10, over 20 rad.
    EXPECT_NEAR(error(rung, ErrorMeasure::rms), error_of_trapezium(h), 1e-6 * error_of_trapezium(h) + 1e-8) << h;
    // The drift of phase grows to ωT (ωh)²/12 = (5/3) h² · 4 and its mean square is a third of that squared, as long as
    // it is small. The next term of the period, (ωh)⁴/80, and how many whole half periods 10 s are leave a tenth.
    if (h <= 0.05) {
      EXPECT_NEAR(error(rung, ErrorMeasure::rms), 20 * 4 * h * h / 12 / std::sqrt(3), 0.1 * error_of_trapezium(h));
    }
    EXPECT_EQ(rung.as_scene, h == 0.05);
    ++steps;
  }
  EXPECT_EQ(steps, 5);
  EXPECT_LT(run.uncertainty.error, 1e-7);
}

TEST(Cost, ChoosesTheCheapestThatKeepsTheTolerance) {
  constexpr double tolerance = 2e-2;
  const auto cost = froude::parse(oscillator).cost({.tolerance = tolerance, .repeat_for_s = 0});
  const AnswerCost& run = cost.answers.front();
  ASSERT_TRUE(run.chosen);
  const CostRung& chosen = run.rungs[*run.chosen];
  EXPECT_LE(error(chosen, ErrorMeasure::rms), tolerance);
  for (const CostRung& rung : run.rungs)
    if (rung.refused.empty() && error(rung, ErrorMeasure::rms) <= tolerance) {
      EXPECT_GE(rung.time_s(), chosen.time_s());
    }
  ASSERT_TRUE(cost.scene);
  EXPECT_THAT(*cost.scene, HasSubstr("# by hand"));
  const froude::Run again = froude::parse(*cost.scene).run();
  double off = 0, size = 0;
  for (std::size_t i = 0; i < again.time.size(); ++i) {
    off += std::pow(again.signal("block.surge")[i] - 0.2 * std::cos(2 * again.time[i]), 2);
    size += std::pow(0.2 * std::cos(2 * again.time[i]), 2);
  }
  EXPECT_LE(std::sqrt(off / size), tolerance);
}

TEST(Cost, FrontHasNothingCheaperThatIsAsAccurate) {
  const auto cost = froude::parse(oscillator).cost({.repeat_for_s = 0});
  const auto& rungs = cost.answers.front().rungs;
  EXPECT_GE(std::count_if(rungs.begin(), rungs.end(), [](const auto& r) { return r.on_front; }), 2);
  for (const CostRung& a : rungs)
    for (const CostRung& b : rungs)
      if (a.on_front && b.refused.empty() && b.time_s() < a.time_s()) {
        EXPECT_GT(error(b, ErrorMeasure::rms), error(a, ErrorMeasure::rms));
      }
}

TEST(Cost, WhatNothingKeepsIsNotChosen) {
  // The best rung, an explicit pair, is off by some 3e-8.
  const auto cost = froude::parse(oscillator).cost({.tolerance = 1e-10, .repeat_for_s = 0});
  EXPECT_FALSE(cost.answers.front().chosen);
  EXPECT_FALSE(cost.answers.front().by_chance);
  EXPECT_FALSE(cost.scene);
  EXPECT_GT(error(cost.answers.front().most_accurate(), ErrorMeasure::rms), 1e-10);
}

/// Two pendulums, one on the other, let go from high up: neighbours part e-fold about once a second.
constexpr const char* wild = R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "30 m"
[[line]]
name = "wild"
from = "(0, 0, 0) m"
node_mass = "1 kg"
[[line.link]]
length = "1 m"
mass = "0 kg"
[[line.link]]
length = "1 m"
mass = "0 kg"
[line.release]
node = 2
at = "(1.9, 0, 0.3) m"
[ask]
run = { duration = "60 s", every = "0.1 s", of = ["wild.link2.polar"] }
[solve]
step = "0.01 s"
)";

TEST(Cost, RunsThatCannotBePredictedAreJudgedByTheirStatistics) {
  constexpr double tolerance = 1e-4;  // less than 60 s tell of a standard deviation
  const auto cost = froude::parse(wild).cost({.tolerance = tolerance, .repeat_for_s = 0});
  const AnswerCost& run = cost.answers.front();
  EXPECT_THAT(run.notes, testing::Contains(HasSubstr("no setting predicts 1 of 1 signals")));
  for (const CostRung& rung : run.rungs)
    if (rung.refused.empty()) {
      EXPECT_EQ(error(rung, ErrorMeasure::rms), error(rung, ErrorMeasure::deviation)) << rung.setting;
    }
  EXPECT_GT(run.uncertainty.error, tolerance);
  // Which of them come within chance is chance itself: rounding of another build makes other motions.
  const auto within = std::count_if(run.rungs.begin(), run.rungs.end(), [&](const CostRung& rung) {
    return rung.refused.empty() && error(rung, ErrorMeasure::rms) <= run.uncertainty.error;
  });
  ASSERT_EQ(run.chosen.has_value(), within > 0);
  EXPECT_EQ(cost.scene.has_value(), within > 0);
  if (within == 0) return;
  ASSERT_TRUE(run.by_chance);
  EXPECT_EQ(*run.by_chance, run.uncertainty.error);
  EXPECT_LE(error(run.rungs[*run.chosen], ErrorMeasure::rms), *run.by_chance);
}

/// A pendulum whose rod is a member in waves: its pieces and the step are approximations that add up.
constexpr const char* rod = R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "30 m"
[waves]
kind = "regular"
height = "1 m"
period = "4 s"
heading = "0 deg"
[[body]]
name = "rod"
position = "(0, 0, -6) m"
mass = "2000 kg"
free = "surge"
[[mooring]]
on = "rod"
kind = "linear"
stiffness = { surge = "10 kN/m" }
[[member]]
on = "rod"
from = "(0, 0, -5) m"
to = "(0, 0, 5) m"
diameter = "0.5 m"
morison = { cd = 1, ca = 1, pieces = 4 }
[ask]
run = { duration = "16 s", every = "0.5 s", of = ["rod.surge"] }
[solve]
step = "0.125 s"
)";

TEST(Cost, SettingsTogetherAreMeasuredTogether) {
  constexpr double tolerance = 2e-2;
  const auto cost = froude::parse(rod).cost({.tolerance = tolerance, .repeat_for_s = 0});
  const AnswerCost& run = cost.answers.front();
  const auto named = [&](const std::string& approximation) {
    return std::count_if(run.rungs.begin(), run.rungs.end(),
                         [&](const CostRung& r) { return r.approximation == approximation && r.refused.empty(); });
  };
  EXPECT_GE(named("step"), 3);
  EXPECT_GE(named("pieces of members"), 3);
  EXPECT_GE(named("together"), 1);
  ASSERT_TRUE(run.chosen);
  EXPECT_LE(error(run.rungs[*run.chosen], ErrorMeasure::rms), tolerance);
  // Gauss' points of a load that falls like exp(kz): with half the pieces' length a sixteenth of the error,
  // of one piece of 2.5/k alone an eleventh, where drag goes as exp(2kz).
  std::vector<double> alone;
  for (const CostRung& r : run.rungs)
    if (r.approximation == "pieces of members") alone.push_back(r.alone.error);
  ASSERT_EQ(alone.size(), 4u);  // 1, 2, 4, 8
  for (std::size_t i = 1; i < alone.size(); ++i)
    EXPECT_NEAR(std::log2(alone[i - 1] / alone[i]), 4, i == 1 ? 1 : 0.6) << i;
}

TEST(Cost, ErrorsAreSharesOfTheReference) {
  const auto sine = [](double amplitude, double phase) {
    Signal out{"x", "m", "", {}};
    for (int i = 0; i < 1000; ++i)
      out.values.push_back(amplitude * std::sin(2 * std::numbers::pi * (i + 0.5) / 100 + phase));
    return std::vector<Signal>{out};
  };
  const auto larger = froude::errors_of(sine(1.01, 0), sine(1, 0), false);
  for (const auto m : {ErrorMeasure::rms, ErrorMeasure::deviation, ErrorMeasure::extreme, ErrorMeasure::range})
    EXPECT_NEAR(larger[static_cast<std::size_t>(m)].error, 0.01, 1e-12) << name_of(m);
  // sin(x + φ) − sin x = 2 sin(φ/2) cos(x + φ/2): as large as 2 sin(φ/2), and no other deviation over whole periods.
  const auto later = froude::errors_of(sine(1, 0.1), sine(1, 0), false);
  EXPECT_NEAR(later[static_cast<std::size_t>(ErrorMeasure::rms)].error, 2 * std::sin(0.05), 1e-12);
  EXPECT_NEAR(later[static_cast<std::size_t>(ErrorMeasure::deviation)].error, 0, 1e-12);
}

TEST(Cost, SmallSignalsAndResidualsWeighLittle) {
  const std::vector<Signal> reference{
      {"a", "m", "", {1, -1}}, {"b", "m", "", {1e-9, 0}}, {"c.residual", "m", "", {1, 2}}};
  const std::vector<Signal> answer{
      {"a", "m", "", {1.1, -1}}, {"b", "m", "", {-1e-9, 1e-9}}, {"c.residual", "m", "", {9, 9}}};
  const auto errors = froude::errors_of(answer, reference, false);
  EXPECT_EQ(errors[0].signal, "a");
  EXPECT_NEAR(errors[0].error, 0.1 / std::sqrt(2.0), 1e-12);
  // What nothing predicts counts by its deviation, where others count by their rms.
  const auto without = froude::errors_of(answer, reference, false, {"a"});
  EXPECT_EQ(without[0].signal, "a");
  EXPECT_NEAR(without[0].error, 0.05, 1e-12);
}

TEST(Cost, OfAChangedSceneIsRefused) {
  const froude::Scene scene = froude::parse(oscillator);
  EXPECT_THROW(scene.with(scene.parameter("body.block.mass"), 200).cost(), hydro::InputError);
}

}  // namespace
}  // namespace froude_test::cost
