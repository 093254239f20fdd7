// Controllers of the caller's on sliders and hinges.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "answers/controlled_run.hpp"
#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"
#include "hydro/base/error.hpp"

namespace joint_control_test {
namespace {

using namespace froude;
using dynamics::Command;
using froude_test::parse;
using froude_test::water;
using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Le;
using testing::ThrowsMessage;

/// 2 kg that slide along x from 0.1 m on, ω = 2 rad/s on 8 N/m, damped to a tenth; or 2 kg m² that turn about y from
/// 0.1 rad on. The ground is named first, and last where `reversed`, so that the coordinate counts backwards.
std::string swinging(const std::string& kind, const std::string& pto, double step, bool reversed = false) {
  const bool slides = kind == "slider";
  return water +
         "[[body]]\nname = \"m\"\nmass = \"2 kg\"\ncentre_of_gravity = \"(0, 0, 0) m\"\nradii_of_gyration = \"(1, 1, "
         "1) m\"\ninitial = { " +
         (slides ? "surge = \"0.1 m\"" : "pitch = \"0.1 rad\"") + " }\n[[joint]]\nname = \"rack\"\nkind = \"" + kind +
         "\"\nbetween = " + (reversed ? "[\"m\", \"ground\"]" : "[\"ground\", \"m\"]") +
         "\nat = \"(0, 0, 0) m\"\naxis = \"" + (slides ? "x" : "y") + "\"\n" + pto +
         "[ask]\nrun = { duration = \"6 s\", every = \"0.1 s\" }\n[solve]\nstep = \"" + fmt::format("{} s", step) +
         "\"\n";
}
const std::string of_slider = "[joint.pto]\nstiffness = \"8 N/m\"\ndamping = \"0.8 N s/m\"\n",
                  of_hinge = "[joint.pto]\nstiffness = \"8 N m/rad\"\ndamping = \"0.8 N m s/rad\"\n";

Command spring_and_damper(const JointSample& now) { return {8 * now.coordinate + 0.8 * now.rate, 8, 0.8}; }

Run ruled(const std::string& text, const std::function<std::optional<Command>(const JointSample&)>& decide,
          const std::string& joint = "rack") {
  return simulate_controlled(parse(text), {}, {}, {{joint, decide}}, nullptr);
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double out = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) out = std::max(out, std::abs(a[i] - b[i]));
  return a.size() == b.size() ? out : std::numeric_limits<double>::infinity();
}

double dissipated(const Run& run, const std::string& entry) {
  for (const auto& [name, value] : run.energy)
    if (name == entry) return value;
  ADD_FAILURE() << "no " << entry;
  return 0;
}

// With its slopes the controller says the scene's own law anew at each step: both are the same equations, which Newton
// solves to 1e-10 of the loads or better.
TEST(JointControllers, ThatAreASpringAndADamperAreThePowerTakeOffOfTheScene) {
  for (const bool reversed : {false, true})
    for (const auto& [kind, pto] : {std::pair("slider", of_slider), std::pair("hinge", of_hinge)}) {
      const std::string text = swinging(kind, pto, 0.05, reversed);
      const auto own = simulate(parse(text)), run = ruled(text, &spring_and_damper);
      const bool slides = std::string(kind) == "slider";
      const std::string coordinate = slides ? "rack.stroke" : "rack.angle",
                        force = slides ? "rack.pto_force" : "rack.pto_moment";
      ASSERT_EQ(run.stopped, "");
      EXPECT_LT(largest_difference(run.signal(coordinate), own.signal(coordinate)), 1e-10) << kind;
      EXPECT_LT(largest_difference(run.signal(force), own.signal(force)), 8 * 1e-10) << kind;
      EXPECT_LT(largest_difference(run.signal("rack.pto_power"), own.signal("rack.pto_power")), 1e-9) << kind;
      // ½ 8 N/m (0.1 m)² = 0.04 J to begin with, of which e^(−0.4·6) = 9 % is left.
      EXPECT_GT(dissipated(own, "pto.dissipated"), 0.03);
    }
}

// A force that is held through the step is late by half of it: first order. Errors at three steps tell the order.
TEST(JointControllers, OfForcesAloneAreOfFirstOrderInTheStep) {
  std::vector<double> errors;
  for (const double step : {0.02, 0.01, 0.005}) {
    const std::string text = swinging("slider", of_slider, step);
    const auto own = simulate(parse(text)),
               run = ruled(text, [](const JointSample&now) { return Command{spring_and_damper(now).force}; });
    errors.push_back(largest_difference(run.signal("rack.stroke"), own.signal("rack.stroke")));
  }
  EXPECT_LT(errors.back(), 2e-3);  // half a step of 5 ms at 0.2 m/s, and the negative damping k h/2 = 0.02 N s/m of 0.8
  for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_NEAR(std::log2(errors[i - 1] / errors[i]), 1, 0.1) << i;
}

// What is set supplies what it does not take; kinetic energy at the start was none, 0.04 J of the spring are supplied
// from outside as it pulls.
TEST(JointControllers, CloseTheLedger) {
  const std::string text = swinging("slider", "", 0.005);
  const auto run = ruled(text, [](const JointSample& now) { return Command{8 * now.coordinate + 0.8 * now.rate}; });
  const double residual = dissipated(run, "residual"), turnover = dissipated(run, "turnover");
  EXPECT_GT(turnover, 0.02);
  EXPECT_LT(std::abs(residual), 1e-3 * turnover);  // trapezia of powers, (ω h)²/12 = 8e-6 each, and the jumps at steps
  const double supplied = dissipated(run, "pto.controlled.supplied"), kinetic = dissipated(run, "kinetic");
  EXPECT_NEAR(supplied, kinetic, 1e-3 * turnover);
  EXPECT_EQ(dissipated(run, "pto.controlled.dissipated"), 0);
}

TEST(JointControllers, KeepToTheLimitAndTheStopsOfTheScene) {
  const std::string bounded =
      "[joint.pto]\nforce_limit = \"0.5 N\"\nstops = { upper = \"0.15 m\", stiffness = \"8000 N/m\", damping = \"0 N "
      "s/m\" }\n";
  const auto run = ruled(swinging("slider", bounded, 0.005), [](const JointSample&) { return Command{-1000}; });
  const auto &force = run.signal("rack.pto_force"), &stroke = run.signal("rack.stroke");
  EXPECT_EQ(force.front(), -0.5) << "it is asked where the run begins, and its 1000 N are cut to the limit";
  const double highest = *std::max_element(stroke.begin(), stroke.end());
  // ½ k d² = 0.5 N × (0.05 m + d) holds at the stop: d = 2.6 mm.
  EXPECT_GT(highest, 0.15);
  EXPECT_LT(highest, 0.1527);
  for (std::size_t i = 0; i < force.size(); ++i)
    EXPECT_EQ(force[i], -0.5 + 8000 * std::max(0.0, stroke[i] - 0.15)) << i;
}

TEST(JointControllers, OfAPlainJointActAlongItsCoordinate) {
  // A constant moment of −0.2 N m against the angle turns 2 kg m² by ½ 0.1 t² from where it is.
  const auto run = ruled(swinging("hinge", "", 0.05), [](const JointSample&) { return Command{-0.2}; });
  const auto& angle = run.signal("rack.angle");
  for (std::size_t i = 0; i < angle.size(); ++i)
    EXPECT_NEAR(angle[i], 0.1 + 0.05 * run.time[i] * run.time[i], 1e-9) << i;  // Newton's residual over 120 steps
  EXPECT_THAT(run.signal("rack.pto_moment"), Each(-0.2));
}

TEST(JointControllers, LeaveWhatActsWhereTheySayNothing) {
  const auto run = ruled(swinging("slider", "", 0.05), [](const JointSample& now) -> std::optional<Command> {
    if (now.run.time() < 1.99 || now.run.time() > 2.01) return {};
    return Command{-2};
  });
  const auto& force = run.signal("rack.pto_force");
  for (std::size_t i = 0; i < force.size(); ++i) EXPECT_EQ(force[i], run.time[i] < 1.99 ? 0 : -2) << run.time[i];
}

TEST(JointControllers, ReadTheRunAndTheirOwnJoint) {
  std::vector<double> time, coordinate, rate, heard;
  const auto run = ruled(swinging("slider", of_slider, 0.05), [&](const JointSample& now) -> std::optional<Command> {
    EXPECT_EQ(now.joint, "rack");
    time.push_back(now.run.time());
    coordinate.push_back(now.coordinate);
    rate.push_back(now.rate);
    heard.push_back(now.run["rack.stroke"]);
    EXPECT_EQ(now.rate, now.run.velocity("m")[0]);
    return spring_and_damper(now);
  });
  EXPECT_EQ(time.size(), 121u) << "where the run begins, and at the end of each of 120 steps";
  EXPECT_EQ(time.front(), 0);
  EXPECT_EQ(coordinate, heard);
  for (std::size_t i = 0; i < run.time.size(); ++i) EXPECT_EQ(coordinate[2 * i], run.signal("rack.stroke")[i]) << i;
  EXPECT_THAT(rate, Contains(Le(-0.1)));
}

/// Two racks, one with twice the displacement.
const std::string two_racks =
    water +
    "[[body]]\nname = \"m\"\nmass = \"2 kg\"\ncentre_of_gravity = \"(0, 0, 0) m\"\nradii_of_gyration = \"(1, 1, 1) "
    "m\"\ncopies = { count = 2, step = \"(0, 9, 0) m\" }\n"
    "[[joint]]\nname = \"rack\"\nkind = \"slider\"\nbetween = [\"ground\", \"m1\"]\nat = \"(0, 0, 0) m\"\naxis = "
    "\"x\"\n"
    "[[joint]]\nname = \"racks\"\nkind = \"slider\"\nbetween = [\"ground\", \"m2\"]\nat = \"(0, 9, 0) m\"\naxis = "
    "\"x\"\n"
    "[[joint]]\nname = \"eye\"\nkind = \"ball\"\nbetween = [\"m1\", \"ground\"]\nat = \"(0, 0, 0) m\"\n"
    "[ask]\nrun = { duration = \"1 s\", every = \"0.1 s\" }\n";

TEST(JointControllers, AreAskedForEachJointThatTheirNameStandsFor) {
  std::string text = two_racks;
  text.erase(text.find("[[joint]]\nname = \"eye\""), text.find("[ask]") - text.find("[[joint]]\nname = \"eye\""));
  const auto run = ruled(
      text, [](const JointSample& now) { return Command{now.joint == "rack" ? -2.0 : -4.0}; }, "rack*");
  EXPECT_NEAR(run.signal("rack.stroke").back(), 0.5, 1e-9);  // ½ (F/m) t², m = 2 kg
  EXPECT_NEAR(run.signal("racks.stroke").back(), 1.0, 1e-9);
}

TEST(JointControllers, ThatAskForNoNumberEndTheRunAndKeepIt) {
  const auto run = ruled(swinging("slider", of_slider, 0.05), [](const JointSample& now) {
    Command out = spring_and_damper(now);
    if (now.run.time() > 2.98) out.damping = std::nan("");
    return out;
  });
  EXPECT_THAT(run.stopped,
              AllOf(HasSubstr("the controller of \"rack\""), HasSubstr("slopes 8 and nan"), HasSubstr("at t = 3 s")));
  EXPECT_EQ(run.time.size(), 30u) << "0 to 2.9 s";
  const auto at_once = ruled(swinging("slider", "", 0.05), [](const JointSample&) -> std::optional<Command> {
    throw hydro::NumericsError("it has lost its way");
  });
  EXPECT_EQ(at_once.stopped, "it has lost its way");
  EXPECT_EQ(at_once.time.size(), 1u);
}

TEST(JointControllers, OfWhatCannotBeRuledAreRefused) {
  const auto nothing = [](const JointSample&) -> std::optional<Command> { return {}; };
  const auto refused = [&](const std::string& text, const std::string& joint, const auto& what) {
    EXPECT_THAT([&] { ruled(text, nothing, joint); }, ThrowsMessage<hydro::InputError>(what)) << joint;
  };
  refused(two_racks, "gear", AllOf(HasSubstr("no joint \"gear\""), HasSubstr("joints are: rack, racks, eye")));
  refused(two_racks, "eye", AllOf(HasSubstr("joint \"eye\" is of kind \"ball\""), HasSubstr("test.toml:")));
  refused(swinging("slider", "prescribed = { amplitude = \"0.1 m\", period = \"3 s\" }\n", 0.05), "rack",
          HasSubstr("moves as `prescribed`"));
  EXPECT_THAT(
      [&] {
        simulate_controlled(parse(two_racks), {}, {}, {{"rack", nothing}, {"racks", nothing}, {"rack*", nothing}},
                            nullptr);
      },
      ThrowsMessage<hydro::InputError>(HasSubstr("two controllers rule the joint \"rack\"")));
}

}  // namespace
}  // namespace joint_control_test
