// Coefficients of deep water in a scene with a bed: how far off they are, and where that is too far.
#include "compile/depth.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"
#include "compile/compile.hpp"
#include "hydro/base/error.hpp"

namespace depth_test {
namespace {

using namespace froude;
using froude_test::parse;
using hydro::InputError;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

/// A floating hemisphere of 5 m radius with coefficients of deep water.
std::string hemisphere(const std::string& depth, const std::string& ask, const std::string& more = "") {
  return "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ngravity = \"9.81 m/s^2\"\ndepth = \"" + depth + "\"\n" + R"(
[[body]]
name = "m"
mass = "261.8 t"
centre_of_gravity = "(0, 0, -2) m"
radii_of_gyration = "(2, 2, 2) m"
free = ["heave"]
initial = { heave = "0.1 m" }
[body.hydrodynamics]
file = "hemisphere_r5.nc"
radiation = {}
hydrostatics = true
)" + more +
         "[ask]\n" + ask;
}
const std::string decay = "run = { duration = \"5 s\", every = \"0.1 s\" }\n";

std::string waves(const std::string& period) {
  return "excitation = true\n[waves]\nkind = \"regular\"\ntheory = \"linear\"\nheight = \"0.1 m\"\nperiod = \"" +
         period + "\"\nheading = \"0 deg\"\n";
}

// The sphere swings at 1.44 rad/s: 16 m are kd = 3.4 there, and 100 m are 21.
TEST(OtherDepth, OfADecayIsJudgedByTheBodysOwnPeriod) {
  const auto record = simulate(parse(hemisphere("100 m", decay)));
  EXPECT_THAT(record.notes, Contains(AllOf(HasSubstr("infinitely deep water in 100 m"), HasSubstr("a free motion"),
                                           HasSubstr("of the added mass in heave"))));
  EXPECT_THAT([] { simulate(parse(hemisphere("16 m", decay))); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("test.toml:15"), HasSubstr("a free motion"),
                                              HasSubstr("compute the coefficients for 16 m"), HasSubstr("rad/s on"))));
  const auto deep = simulate(parse(hemisphere("infinite", decay)));
  EXPECT_THAT(deep.notes, Not(Contains(HasSubstr("coefficients for"))));
  for (std::size_t i = 0; i < deep.time.size(); ++i)
    EXPECT_NEAR(record.signal("m.heave")[i], deep.signal("m.heave")[i], 1e-12) << "the memory is that of the data";
}

TEST(OtherDepth, OfWavesIsJudgedByTheLongest) {
  EXPECT_THAT(simulate(parse(hemisphere("100 m", decay, waves("7 s")))).notes, Contains(HasSubstr("at 0.8976 rad/s")));
  EXPECT_THAT(
      [] { simulate(parse(hemisphere("100 m", decay, waves("14 s")))); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("at 0.4488 rad/s, the longest waves"), HasSubstr("0.01 is allowed"))));
  const auto rao = [](const std::string& longest) {
    return respond(
        parse(hemisphere("100 m", "rao = { periods = \"4 s .. " + longest + ", 4 values\" }\n", waves("5 s"))));
  };
  EXPECT_THAT(rao("9 s").notes, Contains(HasSubstr("the longest waves asked for")));
  EXPECT_THAT([&] { rao("20 s"); }, ThrowsMessage<InputError>(HasSubstr("the longest waves asked for")));
}

TEST(OtherDepth, TooNearToTheHullIsRefusedWhateverTheWaves) {
  EXPECT_THAT([] { compile::prepare(parse(hemisphere("12 m", decay))); },
              ThrowsMessage<InputError>(HasSubstr("the bed so near to the hull changes the added mass in heave")));
}

TEST(OtherDepth, OfWhatTakesHydrostaticsAloneDoesNotMatter) {
  std::string still = hemisphere("12 m", decay);
  still.erase(still.find("radiation = {}\n"), 15);
  EXPECT_TRUE(compile::prepare(parse(still)).other_depths.empty());
}

// Against the exact solution for a cylinder in both waters. The estimates are of first order in what the bed does.
TEST(OtherDepth, IsEstimatedAsItIs) {
  const auto cylinder = [](const std::string& depth) {
    return compile::prepare(parse(
        "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ngravity = \"9.81 m/s^2\"\ndepth = \"" + depth + "\"\n" + R"(
[[body]]
name = "m"
mass = "392.7 t"
centre_of_gravity = "(0, 0, -2) m"
radii_of_gyration = "(2, 2, 2) m"
[body.hydrodynamics]
radiation = {}
[body.hydrodynamics.cylinders]
at = "(0, 0, 0) m"
diameter = "10 m"
draught = "5 m"
frequencies = "0.6 rad/s .. 3.6 rad/s, 16 values"
[ask]
)" + decay));
  };
  const auto deep = cylinder("infinite"), bed = cylinder("30 m");
  const auto& far = deep.groups[0].table;
  const auto& near = bed.groups[0].table;
  for (const double omega : {0.8, 1.0, 1.2}) {
    const double off = std::abs(near.damping(omega)(2, 2) / far.damping(omega)(2, 2) - 1);
    const double told = compile::depth_error(omega, 9.81, 30, 0);
    EXPECT_LT(off, 1.5 * told + 0.01) << omega << ": the near field is in the damping too";
    EXPECT_GT(off, 0.1 * told) << omega << ": of the right order, " << told;
  }
  const auto scene = parse(hemisphere("30 m", decay));
  const double told =
      compile::other_depth(scene, far.coefficients(), {392.7}, {Eigen::Vector3d::Zero()}, {}).near_field;
  const double off = std::abs(near.added_mass(3.6)(2, 2) / far.added_mass(3.6)(2, 2) - 1);
  EXPECT_GT(told, off / 2);
  EXPECT_LT(told, off * 2);
}

}  // namespace
}  // namespace depth_test
