// Angles of a scene and of its records: what is given is what is told, and what turns is counted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"
#include "compile/control.hpp"
#include "hydro/base/error.hpp"

namespace angles_test {
namespace {

using namespace froude;
using froude_test::parse;
using froude_test::water;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double degree = std::numbers::pi / 180;

/// A wheel of 0.5 kg m² about y, in its hub on the ground.
std::string wheel(const std::string& begins) {
  return "[[body]]\nname = \"wheel\"\ncentre_of_gravity = \"(0, 0, 0) m\"\nmass = \"2 kg\"\n"
         "radii_of_gyration = \"(0.5, 0.5, 0.5) m\"\n" +
         begins + "\n";
}
std::string hub(const std::string& works, const std::string& on = "wheel") {
  return "[[joint]]\nname = \"hub\"\nkind = \"hinge\"\nbetween = [\"ground\", \"" + on +
         "\"]\nat = \"(0, 0, 0) m\"\naxis = \"y\"\n" + works + "\n";
}
std::string ask(const std::string& duration) {
  return "[ask]\nrun = { duration = \"" + duration + "\", every = \"0.01 s\" }\n";
}
const std::string spring = "pto = { stiffness = \"3 N m/rad\" }";

double largest_jump(const std::vector<double>& values) {
  double most = 0;
  for (std::size_t i = 1; i < values.size(); ++i) most = std::max(most, std::abs(values[i] - values[i - 1]));
  return most;
}

// 4 cos √(k/I) t. The step changes periods by (ωh)²/12 = 5e-5, which is 2.5e-3 rad after 5 s.
TEST(Angles, OfAHingeWoundBeyondHalfATurnUnwindIt) {
  const auto record = simulate(parse(water + wheel("initial = { pitch = \"4 rad\" }") + hub(spring) + ask("5 s")));
  ASSERT_EQ(record.stopped, "");
  EXPECT_NEAR(record.signal("hub.angle").front(), 4, 1e-12);
  EXPECT_NEAR(record.signal("hub.pto_moment").front(), 12, 1e-9);
  EXPECT_NEAR(record.signal("energy.pto.stored").front(), 24, 1e-9);
  for (std::size_t i = 0; i < record.time.size(); ++i) {
    const double expected = 4 * std::cos(std::sqrt(3 / 0.5) * record.time[i]);
    ASSERT_NEAR(record.signal("hub.angle")[i], expected, 5e-3) << record.time[i];
    ASSERT_NEAR(record.signal("wheel.pitch")[i], expected, 5e-3) << record.time[i];
    ASSERT_NEAR(record.signal("wheel.yaw")[i], 0, 1e-9) << record.time[i];
  }
}

TEST(Angles, OfAHingeAreCountedTheOtherWayWhereTheGroundIsNamedSecond) {
  std::string turned = hub(spring);
  turned.replace(turned.find("[\"ground\", \"wheel\"]"), 19, "[\"wheel\", \"ground\"]");
  const auto record = simulate(parse(water + wheel("initial = { pitch = \"4 rad\" }") + turned + ask("0.1 s")));
  EXPECT_NEAR(record.signal("hub.angle").front(), -4, 1e-12);
  EXPECT_NEAR(record.signal("energy.pto.stored").front(), 24, 1e-9);
}

TEST(Angles, OfWhatIsCarriedAlongAreWoundWithIt) {
  const std::string rider =
      "[[body]]\nname = \"rider\"\nposition = \"(1, 0, 0) m\"\ncentre_of_gravity = \"(0, 0, 0) m\"\n"
      "mass = \"2 kg\"\nradii_of_gyration = \"(0.5, 0.5, 0.5) m\"\n"
      "[[joint]]\nkind = \"fixed\"\nbetween = [\"wheel\", \"rider\"]\nat = \"(1, 0, 0) m\"\n";
  const auto record =
      simulate(parse(water + wheel("initial = { pitch = \"400 deg\" }") + rider + hub(spring, "rider") + ask("0.1 s")));
  EXPECT_NEAR(record.signal("hub.angle").front(), 400 * degree, 1e-9);
  EXPECT_NEAR(record.signal("rider.pitch").front(), 400 * degree, 1e-9);
}

// At 1 rad/s the stop of √(100/0.5) = 14.1 rad/s is met after 200° and yields by 1/14.1 rad for half a period.
TEST(Angles, OfAHingeMeetAStopBeyondHalfATurn) {
  const auto record =
      simulate(parse(water + wheel("initial_velocity = { pitch = \"1 rad/s\" }") +
                     hub("pto = { stops = { upper = \"200 deg\", stiffness = \"100 N m/rad\" } }") + ask("6 s")));
  const auto& angle = record.signal("hub.angle");
  const double into = 1 / std::sqrt(200.0);
  EXPECT_NEAR(*std::max_element(angle.begin(), angle.end()), 200 * degree + into, 1e-3);
  // (ωh)²/12 of half a period, and where in a step the stop is met: some hundredths of the step at 1 rad/s
  EXPECT_NEAR(angle.back(), 200 * degree - (6 - 200 * degree - std::numbers::pi * into), 5e-3);
}

TEST(Angles, RunOnThroughManyTurns) {
  const auto record =
      simulate(parse(water + wheel("initial_velocity = { pitch = \"20 rad/s\" }") + hub("") + ask("5 s")));
  EXPECT_NEAR(record.signal("hub.angle").back(), 100, 1e-6);
  EXPECT_NEAR(record.signal("wheel.pitch").back(), 100, 1e-6);
  EXPECT_LT(largest_jump(record.signal("wheel.pitch")), 0.21);
  EXPECT_LT(largest_jump(record.signal("wheel.roll")) + largest_jump(record.signal("wheel.yaw")), 1e-6);
}

TEST(Angles, OfAHingeAreCountedWhereAStepIsMoreThanHalfATurn) {
  std::string coarse = ask("2 s");
  coarse.replace(coarse.find("0.01 s"), 6, "0.5 s");
  const auto record = simulate(parse(water + wheel("initial_velocity = { pitch = \"20 rad/s\" }") + hub("") + coarse +
                                     "[solve]\nstep = \"0.5 s\"\n"));
  EXPECT_NEAR(record.signal("hub.angle").back(), 40, 1e-6);
  EXPECT_GT(record.halvings, 0);
}

TEST(Angles, OfALedHingeAreWhereItIsLed) {
  const auto record =
      simulate(parse(water + wheel("") + hub("prescribed = { amplitude = \"5 rad\", period = \"4 s\" }") + ask("4 s")));
  for (std::size_t i = 0; i < record.time.size(); ++i)
    ASSERT_NEAR(record.signal("hub.angle")[i], 5 * std::sin(std::numbers::pi / 2 * record.time[i]), 1e-9);
}

TEST(Angles, GivenAreThoseThatARecordBeginsWith) {
  const auto record = simulate(
      parse(water + wheel("initial = { roll = \"20 deg\", pitch = \"30 deg\", yaw = \"140 deg\" }") + ask("0.1 s")));
  EXPECT_NEAR(record.signal("wheel.roll").front(), 20 * degree, 1e-14);
  EXPECT_NEAR(record.signal("wheel.pitch").front(), 30 * degree, 1e-14);
  EXPECT_NEAR(record.signal("wheel.yaw").front(), 140 * degree, 1e-14);
}

TEST(Angles, ThatAControllerIsToldRunOn) {
  std::vector<double> told;
  const std::string tether =
      "[[connector]]\nname = \"tether\"\nkind = \"axial\"\nbetween = [\"wheel\", \"ground\"]\n"
      "ends = [\"(0, 0, 0) m\", \"(0, 0, 9) m\"]\nstiffness = \"1 N/m\"\nrest_length = \"as placed\"\n";
  simulate(parse(water + wheel("initial_velocity = { pitch = \"2 rad/s\" }") + hub("") + tether + ask("3 s")), {},
           {{"tether", [&](const Sample& sample) -> std::optional<double> {
               told.push_back(sample["wheel.pitch"]);
               return {};
             }}});
  ASSERT_FALSE(told.empty());
  EXPECT_NEAR(told.back(), 6, 1e-6);
}

// Springs of a mooring's matrix and of bushings are by the rotation vector, which ends at half a turn.
TEST(Angles, BeyondHalfATurnEndTheLawsThatCountNone) {
  const std::string mooring =
      "[[mooring]]\nname = \"tie\"\non = [\"wheel\"]\nkind = \"linear\"\nstiffness = { yaw = \"0.1 N m/rad\" }\n";
  const std::string bushing =
      "[[connector]]\nname = \"tie\"\nkind = \"bushing\"\nbetween = [\"wheel\", \"ground\"]\n"
      "ends = [\"(0, 0, 0) m\", \"(0, 0, 0) m\"]\nstiffness = \"(1, 1, 1) N/m\"\n"
      "rotational_stiffness = \"(0.1, 0.1, 0.1) N m/rad\"\n";
  for (const std::string& tie : {mooring, bushing}) {
    const auto turning = simulate(parse(water + wheel("initial_velocity = { yaw = \"2 rad/s\" }") + tie + ask("3 s")));
    EXPECT_THAT(turning.stopped, HasSubstr("more than half a turn")) << tie;
    EXPECT_NEAR(turning.signal("wheel.yaw").back(), std::numbers::pi, 0.03) << "kept up to there";
    const auto swinging = simulate(parse(water + wheel("initial_velocity = { yaw = \"1 rad/s\" }") + tie + ask("9 s")));
    EXPECT_EQ(swinging.stopped, "") << tie;
  }
}

/// A bob 1 m below its pivot, begun aside by 20°.
std::string pendulum(const std::string& sway, const std::string& more = "") {
  return "[[body]]\nname = \"bob\"\nposition = \"(0, 0, -1) m\"\ncentre_of_gravity = \"(0, 0, 0) m\"\n"
         "mass = \"2 kg\"\nradii_of_gyration = \"(0.2, 0.2, 0.2) m\"\nweight = true\n"
         "initial = { roll = \"20 deg\", sway = \"" +
         sway + "\", heave = \"0.0603074 m\" }\n" + more +
         "[[joint]]\nname = \"pivot\"\nkind = \"hinge\"\nbetween = [\"bob\", \"ground\"]\n"
         "at = \"(0, 0, 0) m\"\naxis = \"x\"\n";
}

TEST(Starts, OfWhatJointsHoldNeedNoMoreDigitsThanPeopleWrite) {
  const auto record = simulate(parse(water + pendulum("0.34202 m") + ask("0.1 s")));
  EXPECT_THAT(record.notes, Contains(AllOf(HasSubstr("\"pivot\""), HasSubstr("1.43e-07 m"))));
  EXPECT_NEAR(record.signal("bob.roll").front(), 20 * degree, 2e-7);
  EXPECT_THAT([] { simulate(parse(water + pendulum("0.35 m") + ask("0.1 s"))); },
              ThrowsMessage<hydro::InputError>(
                  AllOf(HasSubstr("open joint \"pivot\" by 0.00798 m"), HasSubstr("carried along"))));
}

TEST(Starts, WithVelocitiesNeedNoMoreDigitsThanPeopleWrite) {
  const auto moving = [](const std::string& speed) {
    return pendulum("0.34202014 m",
                    "initial_velocity = { roll = \"3 rad/s\", sway = \"" + speed + "\", heave = \"1.0260604 m/s\" }\n");
  };
  const auto record = simulate(parse(water + moving("2.819078 m/s") + ask("0.1 s")));
  EXPECT_THAT(record.notes, Contains(AllOf(HasSubstr("\"pivot\""), HasSubstr("m/s"))));
  EXPECT_THAT([&] { simulate(parse(water + moving("2.9 m/s") + ask("0.1 s"))); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("pull at joint \"pivot\""), HasSubstr("m/s"))));
}

}  // namespace
}  // namespace angles_test
