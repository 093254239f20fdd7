// Problems of every kind through the one interface that they share, as a program of somebody else calls it. What is put
// into a record comes back in its report.
#include "fit/problem/any.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fit/problem/decay.hpp"
#include "fit/problem/friction.hpp"
#include "fit/problem/morison.hpp"
#include "fit/problem/motion.hpp"
#include "fit/problem/radiation.hpp"
#include "fit/problem/towing.hpp"
#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"
#include "support/morison_records.hpp"

namespace problem_test {
namespace {

using fit::Refusal;
using fit::Report;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double step = 0.02;

/// Samples of a function of time, with noise.
std::vector<double> sampled(std::size_t samples, double noise, std::uint64_t stream, const auto& of) {
  std::vector<double> out = froude_test::ar1_noise(samples, 0.5, noise, stream);
  for (std::size_t i = 0; i < samples; ++i) out[i] += of(step * static_cast<double>(i));
  return out;
}
std::vector<double> times(std::size_t samples) {
  return sampled(samples, 0, 1, [](double t) { return t; });
}

/// The truth lies within twice the half width of the interval: intervals of 0.95 miss it more often than a test may.
void expect_told(const Report& report, const char* name, double truth, const char* unit) {
  const fit::Estimate* e = report.find(name);
  ASSERT_NE(e, nullptr) << name;
  ASSERT_TRUE(e->coefficient.value) << name << ": " << e->coefficient.why_not;
  const auto& [low, high] = e->coefficient.interval;
  EXPECT_NEAR(*e->coefficient.value, truth, high - low) << name;
  EXPECT_LT(high - low, 0.5 * std::abs(truth)) << name;
  EXPECT_EQ(e->unit, unit);
}

const fit::Cylinder& cylinder = froude_test::moved_cylinder;

fit::morison::Problem oscillated(double sign) {
  constexpr std::size_t samples = 2500;
  constexpr double omega = 2 * std::numbers::pi / 4, a = 0.4;
  const auto position = sampled(samples, 0, 1, [&](double t) { return a * std::sin(omega * t); });
  const auto force = sampled(samples, 0.2, 2, [&](double t) {
    return sign * fit::morison_force(cylinder, 1.3, 1.1, a * omega * std::cos(omega * t),
                                     -a * omega * omega * std::sin(omega * t));
  });
  fit::RawRun raw{
      .time = times(samples), .force = {{"F", force, {}}}, .position = position, .velocity = {}, .acceleration = {}};
  return {.runs = {{.source = {"/tank/run_7.csv", {{"day", "Monday"}}}, .cylinder = cylinder, .raw = raw}},
          .options = {.prepare = {.derivative_bandwidth_hz = 1},
                      .longest_delay = {},
                      .force = {},
                      .coefficients = {"cd", "ca", "cm"},
                      .law = {}}};
}

TEST(Problem, OfAnOscillatedCylinderTellsDragAndInertia) {
  const Report report = fit::solve(oscillated(1));
  EXPECT_FALSE(report.refused);
  expect_told(report, "cd", 1.3, "");
  expect_told(report, "ca", 1.1, "");
  expect_told(report, "cm", 2.1, "");
  const Report& run = report.parts.at(0);
  EXPECT_EQ(std::get<std::string>(*find(run.facts, "file")), "run_7.csv");
  EXPECT_EQ(std::get<std::string>(*find(std::get<fit::Facts>(*find(run.facts, "labels")), "day")), "Monday");
  EXPECT_NEAR(std::get<std::int64_t>(*find(run.facts, "samples")), 2500, 50);  // less what derivatives give up
  EXPECT_FALSE(run.remarks.empty());
  EXPECT_TRUE(run.steps);
  EXPECT_EQ(find(run.facts, "weather"), nullptr);
}

TEST(Problem, IsRefusedWhereForceAndMotionHaveContrarySigns) {
  const Report report = fit::solve(oscillated(-1));
  ASSERT_TRUE(report.refused);
  EXPECT_EQ(report.refused->reason, Refusal::Reason::wrong_sign);
  EXPECT_EQ(report.refused->source, "/tank/run_7.csv");
  EXPECT_EQ(report.find("cd"), nullptr);
}

fit::towing::Problem towed(double at_last) {
  fit::towing::Problem out{.cylinder = froude_test::held_cylinder, .runs = {}, .records = {}, .options = {}};
  for (const double speed : {0.3, 0.5, 0.7, 0.9}) {
    const double cd = speed > 0.8 ? at_last : 1.2;
    out.runs.push_back({speed, 0.001, 0.5 * 997 * 0.12 * 0.5 * cd * speed * speed, 0.05});
  }
  return out;
}

TEST(Problem, OfTowingTellsTheDragOfAllRunsOrWhyThereIsNone) {
  const Report report = fit::solve(towed(1.2));
  EXPECT_FALSE(report.refused);
  expect_told(report, "cd", 1.2, "");
  const Report refused = fit::solve(towed(1.6));
  ASSERT_TRUE(refused.refused);
  EXPECT_EQ(refused.refused->reason, Refusal::Reason::residuals_too_large);
  EXPECT_THAT(refused.refused->why, HasSubstr("they scatter"));
  EXPECT_EQ(refused.parts.size(), 4u);  // each run is told all the same
  EXPECT_EQ(refused.find("cd"), nullptr);
}

/// A swing of 6 s whose amplitude falls by 2 % a second.
fit::decay::Problem let_go() {
  constexpr std::size_t samples = 2000;
  const double omega = 2 * std::numbers::pi / 6;
  const auto roll =
      sampled(samples, 0.0005, 3, [&](double t) { return 0.1 * std::exp(-0.02 * t) * std::cos(omega * t); });
  return {.turns = true,
          .runs = {{.source = {"decay.csv"}, .time = times(samples), .motion = roll}},
          .body = fit::RestoredBody{.mass = 9960, .stiffness = 12e3},
          .options = {.prepare = {}, .motion = {.terms = {.linear = true}}, .memory = {}}};
}

TEST(Problem, OfADecayTellsPeriodDampingAndAddedMass) {
  const Report report = fit::solve(let_go());
  const double rate = 0.04, omega0 = std::hypot(2 * std::numbers::pi / 6, rate / 2);
  expect_told(report, "period", 2 * std::numbers::pi / omega0, "s");
  expect_told(report, "linear", rate, "1/s");
  expect_told(report, "added_mass", 12e3 / (omega0 * omega0) - 9960, "kg m^2");
}

TEST(Problem, OfADecayThatIsNoneIsRefused) {
  fit::decay::Problem problem = let_go();
  problem.options.motion = {};
  auto& [source, time, motion] = problem.runs[0];
  for (auto* values : {&time, &motion}) values->clear();
  for (int j = 0; j < 900; ++j) {  // three swings as large as each other: one of them is a third of the whole
    const double t = 0.1 * j;
    time.push_back(t);
    motion.push_back(0.1 * (std::cos(0.8 * t) + std::cos(t) + std::cos(1.25 * t)));
  }
  const Report report = fit::solve(problem);
  ASSERT_TRUE(report.refused);
  EXPECT_EQ(report.refused->reason, Refusal::Reason::residuals_too_large);
  EXPECT_EQ(report.refused->source, "decay.csv");
  EXPECT_EQ(report.find("period"), nullptr);
}

TEST(Problem, OfForcedHeaveTellsAddedMassAndDamping) {
  constexpr std::size_t samples = 2000;
  constexpr double omega = 3, a = 0.05, mass = 120, added = 60, damping = 90, stiffness = 2500;
  const auto motion = sampled(samples, 0, 1, [&](double t) { return a * std::sin(omega * t); });
  const auto force = sampled(samples, 0.5, 4, [&](double t) {
    return ((mass + added) * omega * omega - stiffness) * a * std::sin(omega * t) -
           damping * a * omega * std::cos(omega * t);
  });
  const Report report = fit::solve(fit::radiation::Problem{
      .turns = false,
      .runs = {{.source = {"heave.csv"}, .time = times(samples), .motion = motion, .force = force}},
      .body = {.mass = mass, .stiffness = stiffness},
      .options = {}});
  expect_told(report, "added_mass", added, "kg");
  expect_told(report, "damping", damping, "N s/m");
  ASSERT_NE(find(report.facts, "coefficients"), nullptr);
}

TEST(Problem, OfABrakeTellsBothLevels) {
  fit::friction::Problem problem{.slides = false, .runs = {}, .options = {.ramp_s = 2, .slide_s = 2, .drop_s = step}};
  for (const std::uint64_t stream : {5, 6, 7}) {
    const auto torque = sampled(400, 0.01, stream, [](double t) { return t < 4.6 ? 0.8 * t : 3.0; });
    problem.runs.push_back({{"brake.csv"}, times(400), torque});
  }
  const Report report = fit::solve(problem);
  ASSERT_EQ(report.parts.size(), 4u);  // three tests, and all together
  for (std::size_t i = 0; i < 3; ++i) {
    expect_told(report.parts[i], "static", 0.8 * 4.6, "N m");
    expect_told(report.parts[i], "dynamic", 3.0, "N m");
  }
  const auto& together = report.parts[3].parts.at(0);
  EXPECT_EQ(together.key, "static");
  EXPECT_NEAR(std::get<double>(*find(together.facts, "value")), 0.8 * 4.6, 0.02);
}

/// x = A e^{-ct}, where A and c are asked.
class Fall final : public fit::Simulation {
 public:
  Eigen::Index coordinates(std::size_t) override { return 0; }
  Eigen::MatrixXd follow(std::size_t, const Eigen::VectorXd& p, const Eigen::VectorXd&) override {
    return (-p[1] * Eigen::ArrayXd::LinSpaced(500, 0, 499 * step)).exp().matrix() * p[0];
  }
  void hand_on(std::size_t, const Eigen::VectorXd&, const Eigen::VectorXd&) override {}
};

TEST(Problem, OfAMotionTellsTheParametersOfAnySimulation) {
  const auto x = sampled(500, 0.01, 8, [](double t) { return 2 * std::exp(-0.3 * t); });
  fit::motion::Problem problem{
      .records = {{.source = {"fall.csv"}, .time = times(500)}},
      .simulation = std::make_shared<Fall>(),
      .parameters = {{{.name = "begins.at", .first = 1.5}, "m"}, {{.name = "rate", .first = 0.5}, "1/s"}},
      .signals = {{"x", "m", 0.012}},
      .measured = {Eigen::Map<const Eigen::VectorXd>(x.data(), std::ssize(x))},
      .options = {.profile = true}};
  const Report report = fit::solve(problem);
  EXPECT_FALSE(report.refused);
  expect_told(report, "begins.at", 2, "m");
  expect_told(report, "rate", 0.3, "1/s");
  EXPECT_TRUE(report.find("rate")->profile);
  problem.signals[0].deviation = 0.001;  // a tenth of what the noise has
  const Report refused = fit::solve(problem);
  ASSERT_TRUE(refused.refused);
  EXPECT_EQ(refused.refused->reason, Refusal::Reason::residuals_too_large);
  EXPECT_EQ(refused.find("rate"), nullptr);
}

TEST(Problem, NamesTheFileOfTheRunAtFault) {
  fit::friction::Problem problem{
      .slides = true, .runs = {{{"short.csv"}, times(20), times(20)}}, .options = {.ramp_s = 2, .slide_s = 2}};
  EXPECT_THAT([&] { fit::solve(problem); }, ThrowsMessage<hydro::InputError>(HasSubstr("short.csv")));
  problem.runs.clear();
  EXPECT_THAT([&] { fit::solve(problem); }, ThrowsMessage<hydro::InputError>(HasSubstr("one test at least")));
}

}  // namespace
}  // namespace problem_test
