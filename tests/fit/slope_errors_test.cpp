// (F105) What the error of a channel's slope does to a coefficient is what the channel does that is so much too large.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "fit/problem/decay.hpp"
#include "fit/problem/friction.hpp"
#include "fit/problem/morison.hpp"
#include "fit/problem/motion.hpp"
#include "fit/problem/radiation.hpp"
#include "fit/problem/restoring.hpp"
#include "fit/problem/towing.hpp"
#include "support/coloured_noise.hpp"
#include "support/morison_records.hpp"

namespace slope_errors_test {
namespace {

constexpr double epsilon = 1e-3;
constexpr fit::SlopeError slope{epsilon, 2 * epsilon};

void scale(std::vector<double>& values) {
  for (double& v : values) v *= 1 + epsilon;
}

fit::Coefficient coefficient(const fit::Report& report, const std::string& name) {
  const fit::Estimate* found = report.find(name);
  EXPECT_NE(found, nullptr) << name;
  return found->coefficient;
}

double middle(const fit::Coefficient& c) { return (c.interval.low + c.interval.high) / 2; }

/// Of one problem as it is, with a channel larger by ε, and with an error of ε stated: the error is what the values
/// change by, to second order in ε, and the interval has twice it in quadrature.
template <class Problem>
void expect_counts(const Problem& plain, const Problem& larger, const Problem& stated,
                   const std::vector<std::string>& names) {
  const fit::Report as_it_is = solve(plain).report, moved = solve(larger).report, counted = solve(stated).report;
  for (const std::string& name : names) {
    const fit::Coefficient before = coefficient(as_it_is, name), with = coefficient(counted, name);
    const double change = std::abs(middle(coefficient(moved, name)) - middle(before)),
                 own = std::sqrt(with.systematic_error * with.systematic_error -
                                 before.systematic_error * before.systematic_error),
                 half = (before.interval.high - before.interval.low) / 2;
    EXPECT_NEAR(own, change, 0.01 * change + 1e-6 * std::abs(middle(before))) << name;
    EXPECT_NEAR((with.interval.high - with.interval.low) / 2, std::hypot(half, 2 * own), 1e-3 * half) << name;
    EXPECT_NEAR(with.standard_error, std::hypot(before.standard_error, own), 1e-9 * with.standard_error) << name;
  }
}

/// x'' + b₁x' + b₂|x'|x' + b₃x'³ + c sgn x' + ω²x = 0 by small steps.
fit::decay::Problem decay(fit::DampingTerms terms, bool pendulum) {
  const auto noise = froude_test::ar1_noise(800, 0, 1e-4, 3);
  const double b2 = terms.quadratic ? 0.15 : 0, b3 = terms.cubic ? 0.1 : 0, c = terms.coulomb ? 0.02 : 0;
  fit::decay::Run run{{"decay.csv"}, {}, {}};
  double x = 0.6, v = 0;
  for (std::size_t i = 0; i < 800; ++i) {
    run.time.push_back(0.05 * static_cast<double>(i));
    run.motion.push_back(x + noise[i]);
    for (int k = 0; k < 500; ++k) {  // midpoint rule in its symplectic form: 1e-4 s, second order
      x += 5e-5 * v;
      v += -1e-4 *
           (0.03 * v + b2 * std::abs(v) * v + b3 * v * v * v + (v > 0 ? c : -c) + 4 * (pendulum ? std::sin(x) : x));
      x += 5e-5 * v;
    }
  }
  fit::decay::Problem out{.turns = pendulum, .runs = {run}, .body = {}, .options = {}};
  out.options.motion.terms = terms;
  out.options.motion.pendulum = pendulum;
  return out;
}

void expect_decay_counts(const fit::decay::Problem& plain, const std::vector<std::string>& names) {
  auto larger = plain, stated = plain;
  scale(larger.runs[0].motion);
  stated.motion_slope = slope;
  expect_counts(plain, larger, stated, names);
}

TEST(SlopeErrors, OfADecayGoToTheTermsByTheirPowersOfTheVelocity) {
  expect_decay_counts(decay({.linear = true, .quadratic = true}, false), {"period", "linear", "quadratic"});
  expect_decay_counts(decay({.linear = true, .cubic = true}, false), {"linear", "cubic"});
  expect_decay_counts(decay({.linear = true, .coulomb = true}, false), {"linear", "coulomb"});
}

fit::radiation::Problem radiation() {
  fit::radiation::Problem out{.turns = false,
                              .runs = {{{"swing.csv"}, {}, {}, {}}},
                              .body = {.mass = 100, .stiffness = 2500},
                              .options = {},
                              .motion_slope = {},
                              .force_slope = {}};
  const auto noise = froude_test::ar1_noise(2000, 0.5, 2, 4);
  for (std::size_t i = 0; i < 2000; ++i) {
    const double t = 0.02 * static_cast<double>(i), w = 3, x = 0.1 * std::cos(w * t), v = -0.1 * w * std::sin(w * t);
    out.runs[0].time.push_back(t);
    out.runs[0].motion.push_back(x);
    out.runs[0].force.push_back(180 * w * w * x - 60 * v - 2500 * x + noise[i]);
  }
  return out;
}

TEST(SlopeErrors, OfAForcedOscillationGoToBothByForceOverMotion) {
  const auto plain = radiation();
  auto larger = plain, stated = plain;
  scale(larger.runs[0].force);
  stated.force_slope = slope;
  expect_counts(plain, larger, stated, {"added_mass", "damping"});
  larger = stated = plain;
  scale(larger.runs[0].motion);
  stated.motion_slope = slope;
  expect_counts(plain, larger, stated, {"added_mass", "damping"});
}

TEST(SlopeErrors, OfLoadsThatWereHeldGoToTheirCurve) {
  fit::restoring::Problem plain{.turns = false,
                                .runs = {{{"pull.csv"}, {}, {}}},
                                .options = {.cubic = true},
                                .motion_slope = {},
                                .load_slope = {}};
  const auto noise = froude_test::ar1_noise(21, 0, 3, 5);
  for (std::size_t i = 0; i < 21; ++i) {
    const double x = 0.1 * static_cast<double>(i) - 1;
    plain.runs[0].motion.push_back(x);
    plain.runs[0].load.push_back(20 + 500 * x + 120 * x * x * x + noise[i]);
  }
  auto larger = plain, stated = plain;
  scale(larger.runs[0].load);
  stated.load_slope = slope;
  expect_counts(plain, larger, stated, {"stiffness", "cubic"});
  larger = stated = plain;
  scale(larger.runs[0].motion);
  stated.motion_slope = slope;
  expect_counts(plain, larger, stated, {"stiffness", "cubic"});
}

TEST(SlopeErrors, OfATorqueGoToItsLevels) {
  fit::friction::Problem plain{
      .slides = false, .runs = {{{"brake.csv"}, {}, {}}}, .options = {.ramp_s = 2, .slide_s = 2.5}, .load_slope = {}};
  const auto noise = froude_test::ar1_noise(900, 0.8, 0.02, 6);
  for (std::size_t i = 0; i < 900; ++i) {
    const double t = 0.01 * static_cast<double>(i), slips = 0.6 + 3.7 / 0.8;
    plain.runs[0].time.push_back(t);
    plain.runs[0].load.push_back((t < slips ? std::max(0.0, 0.8 * (t - 0.6)) : 3.0) + noise[i]);
  }
  auto larger = plain, stated = plain;
  scale(larger.runs[0].load);
  stated.load_slope = slope;
  // The instant of the slip has an error of its own that grows with the load, too: what is changed is the value.
  for (const char* name : {"static", "dynamic", "drop"}) {
    const double change =
        middle(coefficient(solve(larger).report, name)) - middle(coefficient(solve(plain).report, name));
    const fit::Coefficient before = coefficient(solve(plain).report, name),
                           with = coefficient(solve(stated).report, name);
    EXPECT_NEAR(std::sqrt(std::pow(with.systematic_error, 2) - std::pow(before.systematic_error, 2)), change,
                0.01 * change)
        << name;
  }
}

TEST(SlopeErrors, OfMeansOfTowsGoToTheDrag) {
  fit::Cylinder cylinder = froude_test::moved_cylinder;
  cylinder.mass_beyond_load_cells = 0;
  fit::towing::Problem plain{.cylinder = cylinder,
                             .runs = {{0.5, 0, 9, 0.1}, {0.8, 0, 22, 0.2}, {1.0, 0, 35, 0.3}},
                             .records = {},
                             .options = {}};
  plain.options.accept_residuals = true;
  auto larger = plain, stated = plain;
  for (auto& run : larger.runs) run.speed *= 1 + epsilon;
  stated.options.speed_slope = slope;
  const double change = std::abs(*solve(larger).fit.cd.value - *solve(plain).fit.cd.value);
  EXPECT_NEAR(solve(stated).fit.cd.systematic_error, change, 0.01 * change);
  stated = plain;
  stated.options.force_slope = slope;
  EXPECT_NEAR(solve(stated).fit.cd.systematic_error, epsilon * *solve(plain).fit.cd.value, 1e-12);
}

TEST(SlopeErrors, OfAMotionGoToDragTwiceAndToInertia) {
  for (const bool moves : {false, true}) {
    const fit::Cylinder& cylinder = moves ? froude_test::moved_cylinder : froude_test::held_cylinder;
    fit::ForceRecord plain = froude_test::swinging_water(2000, 0.02, 0.5, 7);
    if (moves)
      for (std::size_t i = 0; i < plain.force.size(); ++i)
        plain.force[i] +=
            fit::morison_force(cylinder, 1.2, 1.0, plain.velocity[i], plain.acceleration[i]) -
            fit::morison_force(froude_test::held_cylinder, 1.2, 1.8, plain.velocity[i], plain.acceleration[i]);
    fit::ForceRecord larger = plain;
    scale(larger.velocity);
    scale(larger.acceleration);
    fit::MorisonOptions stated;
    stated.velocity_slope = stated.acceleration_slope = epsilon;
    const auto before = fit::fit_morison(cylinder, plain), moved = fit::fit_morison(cylinder, larger),
               with = fit::fit_morison(cylinder, plain, stated);
    EXPECT_NEAR(with.cd.systematic_error, std::abs(*moved.cd.value - *before.cd.value),
                0.01 * with.cd.systematic_error);
    EXPECT_NEAR(with.inertia.systematic_error, std::abs(*moved.inertia.value - *before.inertia.value),
                0.01 * with.inertia.systematic_error);
    EXPECT_GT(with.cd.standard_error, before.cd.standard_error);
  }
}

/// A decaying exponential of a level: not proportional to what is measured, so that no power tells the answer.
class Fall final : public fit::Simulation {
 public:
  Eigen::Index coordinates(std::size_t) override { return 0; }
  Eigen::MatrixXd follow(std::size_t, const Eigen::VectorXd& p, const Eigen::VectorXd&) override {
    const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(500, 0, 4.99);
    Eigen::MatrixXd out(500, 2);
    out.col(0) = 0.5 + p[0] * (-p[1] * t).exp();
    out.col(1) = p[0] * t;
    return out;
  }
  void hand_on(std::size_t, const Eigen::VectorXd&, const Eigen::VectorXd&) override {}
};

TEST(SlopeErrors, OfASignalGoToTheParametersOfASimulation) {
  const Eigen::MatrixXd truth = Fall().follow(0, Eigen::Vector2d(2, 0.3), {});
  fit::motion::Problem plain{
      .records = {{.source = {"fall.csv"}, .time = {}}},
      .simulation = std::make_shared<Fall>(),
      .parameters = {{{.name = "begins.at", .first = 1.5}, "m"}, {{.name = "rate", .first = 0.5}, "1/s"}},
      .signals = {{"x", "m", 0.02}, {"y", "m", 0.02}},
      .measured = {truth},
      .options = {}};
  for (Eigen::Index c = 0; c < 2; ++c) {
    const auto noise = froude_test::ar1_noise(500, 0, 0.02, static_cast<std::uint64_t>(40 + c));
    for (Eigen::Index i = 0; i < 500; ++i) plain.measured[0](i, c) += noise[static_cast<std::size_t>(i)];
  }
  for (std::size_t c = 0; c < 2; ++c) {
    auto larger = plain, stated = plain;
    larger.measured[0].col(static_cast<Eigen::Index>(c)) *= 1 + epsilon;
    stated.signals[c].slope = slope;
    expect_counts(plain, larger, stated, {"begins.at", "rate"});
  }
}

// Runs share the slope: of a hundred of them its error is still there, and no more of it than of one.
TEST(SlopeErrors, DoNotAverageOutOverRuns) {
  fit::friction::Problem problem{
      .slides = false, .runs = {}, .options = {.ramp_s = 2, .slide_s = 2.5}, .load_slope = {0.02, 0.04}};
  for (std::uint64_t run = 0; run < 20; ++run) {
    const auto noise = froude_test::ar1_noise(900, 0.8, 0.02, 20 + run);
    fit::friction::Run r{{"brake.csv"}, {}, {}};
    for (std::size_t i = 0; i < 900; ++i) {
      const double t = 0.01 * static_cast<double>(i), slips = 0.6 + 3.7 / 0.8;
      r.time.push_back(t);
      r.load.push_back((t < slips ? std::max(0.0, 0.8 * (t - 0.6)) : 3.0) + noise[i]);
    }
    problem.runs.push_back(std::move(r));
  }
  const auto report = solve(problem).report;
  for (const fit::Report& part : report.parts)
    for (const fit::Report& level : part.parts)
      if (level.key == "dynamic") {
        const auto& i = std::get<fit::Interval>(*fit::find(level.facts, "interval"));
        EXPECT_NEAR((i.high - i.low) / 2, 1.96 * 0.02 * 3, 0.01 * 0.12);  // scatter: 2 % of it
        return;
      }
  FAIL() << "no level of all tests together";
}

}  // namespace
}  // namespace slope_errors_test
