/// Loads over time on nodes of lines and on bodies, and lines that several nodes hold before they are let go.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"
#include "support/refused.hpp"

namespace line_loads_test {
namespace {

using namespace froude;
using froude_test::parse;
using support::refused;
using testing::HasSubstr;

constexpr double g = 9.81;
const std::string water = "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"infinite\"\n";
const std::string ask = "[ask]\nrun = { duration = \"4 s\", every = \"0.02 s\" }\n[solve]\nstep = \"5 ms\"\n";

/// A bob of 2 kg on a link of 1 m without mass, under a load.
std::string bob(const std::string& load) {
  return water +
         "[[line]]\nname = \"p\"\nfrom = \"(0, 0, 0) m\"\nnode_mass = \"2 kg\"\nlink = [{ length = \"1 m\", mass = \"0 "
         "kg\" }]\n[[line.load]]\nnode = 1\nforce = \"(3, 4, 0) N\"\n" +
         load + ask;
}

TEST(LineLoads, HoldABobAsideByTheAngleOfForceAndWeight) {
  const auto run = simulate(parse(bob("")));
  const double slope = std::hypot(5, 2 * g);
  for (const std::size_t i : {std::size_t{0}, run.time.size() - 1}) {
    EXPECT_NEAR(run.signal("p.node1.x")[i], 3 / slope, 1e-9);
    EXPECT_NEAR(run.signal("p.node1.y")[i], 4 / slope, 1e-9);
    EXPECT_NEAR(run.signal("p.node1.z")[i], -2 * g / slope, 1e-9);
  }
}

// What acts at t = 0 acts on the rest before; and without it the bob is a pendulum whose energy stays.
TEST(LineLoads, LetABobGoWhoseEnergyIsThenItsOwn) {
  const auto run = simulate(parse(bob("until = \"1.003 s\"\n")));  // within a step
  const auto& kinetic = run.signal("energy.p.kinetic");
  const auto& height = run.signal("p.node1.z");
  const double slope = std::hypot(5, 2 * g), start = -2 * g / slope;
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    const bool held = run.time[i] < 1.003;
    EXPECT_NEAR(kinetic[i], held ? 0 : 2 * g * (start - height[i]), 1e-8);  // J, of 0.6
  }
  EXPECT_GT(*std::max_element(kinetic.begin(), kinetic.end()), 0.9 * 2 * g * (start + 1)) << "it swings through";
  EXPECT_NEAR(run.signal("energy.p.residual").back(), 0, 1e-9);
}

// What a residual is held against is seen at each step, not at samples alone.
TEST(LineLoads, TurnOverAsMuchHoweverRarelyTheyAreKept) {
  std::string rarely = bob("until = \"1 s\"\n");
  const auto often = simulate(parse(rarely));
  rarely.replace(rarely.find("0.02 s"), 6, "2 s");
  EXPECT_DOUBLE_EQ(simulate(parse(rarely)).turnover(), often.turnover());
  EXPECT_GT(often.turnover(), 0.1);  // J
}

TEST(LineLoads, AreSuppliedWhereTheyMoveANode) {
  const auto run =
      simulate(parse(bob("from = \"0.317 s\"\nramp_up = \"1.2 s\"\nuntil = \"2.5 s\"\nramp_down = \"1 s\"\n")));
  EXPECT_EQ(run.signal("p.node1.x").front(), 0);
  EXPECT_GT(run.signal("p.node1.x")[100], 0.1);
  EXPECT_GT(run.signal("energy.p.supplied")[100], 0.1);
  EXPECT_NEAR(run.signal("energy.p.residual").back(), 0, 1e-9);
}

TEST(LineLoads, SayWhatTheyCannotBe) {
  EXPECT_THAT(refused([] { parse(bob("from = \"1 s\"\nramp_up = \"2 s\"\nuntil = \"2 s\"\n")); }),
              HasSubstr("[[line.load]] until = \"2 s\" ends the load before it has risen, at 3 s"));
  EXPECT_THAT(refused([] { parse(bob("ramp_down = \"2 s\"\n")); }), HasSubstr("until"));
  std::string beyond = bob("");
  beyond.replace(beyond.find("node = 1"), 8, "node = 2");
  EXPECT_THAT(refused([&] { parse(beyond); }), HasSubstr("is not a free node: the line has 1 segments"));
}

/// Four links of 0.5 m between places 1 m apart.
std::string loop(const std::string& release) {
  return water +
         "[[line]]\nname = \"d\"\nfrom = \"(0, 0, 0) m\"\nto = \"(1, 0, 0) m\"\nlength = \"3 m\"\nsegments = 6\n"
         "mass_per_length = \"1 kg/m\"\n" +
         release + ask;
}

TEST(LinesLetGo, StartWithEveryNodeThatWasHeldWhereItWas) {
  const auto run = simulate(parse(loop(
      "[line.release]\nnode = 3\nat = \"(0.5, 0.2, -0.6) m\"\nalso = [{ node = 2, at = \"(0.2, 0.2, -0.2) m\" }]\n")));
  const double reach = std::hypot(0.3, 0.4);  // m, of the link between: half a metre
  ASSERT_NEAR(reach, 0.5, 1e-15);
  for (const auto& [name, at] : {std::pair{"d.node2.x", 0.2},
                                 {"d.node2.y", 0.2},
                                 {"d.node2.z", -0.2},
                                 {"d.node3.x", 0.5},
                                 {"d.node3.y", 0.2},
                                 {"d.node3.z", -0.6}})
    EXPECT_NEAR(run.signal(name).front(), at, 1e-12) << name;
  EXPECT_NEAR(run.signal("energy.d.kinetic").front(), 0, 1e-12);
  EXPECT_GT(run.signal("energy.d.kinetic")[20], 0.1) << "nothing holds it any more";
  EXPECT_NEAR(run.signal("energy.d.residual").back(), 0, 1e-8);
}

TEST(LinesLetGo, HoldEachNodeOnce) {
  const std::string twice =
      loop("[line.release]\nnode = 2\nat = \"(0.2, 0.2, -0.2) m\"\nalso = [{ node = 2, at = \"(0, 0, -1) m\" }]\n");
  EXPECT_THAT(refused([&] { parse(twice); }), HasSubstr("holds node 2 twice"));
}

/// A body that slides along x alone, without springs.
std::string sledge(const std::string& load, const std::string& step = "5 ms") {
  return water + "[[body]]\nname = \"s\"\nmass = \"2 kg\"\nradii_of_gyration = \"(1, 1, 1) m\"\nfree = [\"surge\"]\n" +
         "[[load]]\non = \"s\"\nforce = \"(6, 0, 0) N\"\n" + load +
         "[ask]\nrun = { duration = \"4 s\", every = \"0.02 s\" }\n[solve]\nstep = \"" + step + "\"\n";
}

/// Two bobs in waves of 20 m, half a wave apart.
std::string in_waves(const std::string& more) {
  std::string out =
      water + "[waves]\nkind = \"regular\"\nheight = \"0.4 m\"\nperiod = \"3.58 s\"\nheading = \"0 deg\"\n";
  for (const int i : {0, 1})
    out += fmt::format(
        "[[line]]\nname = \"p{}\"\nfrom = \"({}, 0, -0.5) m\"\nnode_mass = \"20 kg\"\ndiameter = \"0.1 m\"\n"
        "link = [{{ length = \"1 m\", mass = \"8 kg\" }}]\nmorison = {{ cd = 1.2, ca = 1.0 }}\n{}",
        i, 10 * i, more);
  return out + ask;
}

// λ = 2πg/ω² is 20.0 m: the second bob is in a trough where the first is in a crest, unless both take waves at one
// place.
TEST(WavesOfLines, AtOnePlaceMoveLinesAlikeWhereverTheyAre) {
  const auto apart = simulate(parse(in_waves("")));
  const auto alike = simulate(parse(in_waves("[line.waves]\nat = \"(0, 0, 0) m\"\n")));
  double opposite = 0, largest = 0;
  for (std::size_t i = 0; i < alike.time.size(); ++i) {
    const double first = alike.signal("p0.node1.x")[i], second = alike.signal("p1.node1.x")[i] - 10;
    EXPECT_NEAR(first, second, 1e-12);
    opposite = std::max(opposite, std::abs(apart.signal("p0.node1.x")[i] - (apart.signal("p1.node1.x")[i] - 10)));
    largest = std::max(largest, std::abs(first));
  }
  EXPECT_GT(largest, 0.01);
  EXPECT_GT(opposite, largest);
}

TEST(WavesOfLines, AreRefusedWhereNothingTakesThemAndBelowTheBed) {
  std::string dry = bob("");
  dry.insert(dry.find("[[line.load]]"), "[line.waves]\nat = \"(0, 0, 0) m\"\n");
  EXPECT_THAT(refused([&] { parse(dry); }), HasSubstr("nothing of the water acts on it"));
  std::string below = in_waves("[line.waves]\nat = \"(0, 0, -30) m\"\n");
  below.replace(below.find("infinite"), 8, "20 m");
  EXPECT_THAT(refused([&] { simulate(parse(below)); }), HasSubstr("below the bed"));
}

/// A bob of 20 kg on a link of 1 m without mass, in a stream of 0.5 m/s.
std::string in_stream(const std::string& more) {
  return water +
         "[current]\nvelocity = \"(0.5, 0, 0) m/s\"\n[[line]]\nname = \"p\"\nfrom = \"(0, 0, -1) m\"\nnode_mass = \"20 "
         "kg\"\nlink = [{ length = \"1 m\", mass = \"0 kg\" }]\n" +
         more + ask;
}
const std::string cylinder = "length = \"1.2 m\"\ndiameter = \"0.1 m\"\ncd = 2.0\nca = 1.0\n";

// ½ρC_D Dℓ U² = 30 N against 20 kg of weight, however the link hangs: a rod is loaded across it alone.
TEST(BobCylinders, HangAsideByTheirDragOverTheirWeight) {
  const auto run = simulate(parse(in_stream("[line.bob_cylinders]\n" + cylinder)));
  EXPECT_NEAR(run.signal("p.node1.x").front(), std::sin(std::atan(30 / (20 * g))), 1e-7);
  EXPECT_NEAR(run.signal("p.node1.x").back(), run.signal("p.node1.x").front(), 1e-6);
}

TEST(BobCylinders, AreRefusedBesideOtherLoadsOfTheSameWater) {
  EXPECT_THAT(
      refused([&] {
        parse(in_stream("diameter = \"0.1 m\"\nmorison = { cd = 1, ca = 1 }\n[line.bob_cylinders]\n" + cylinder));
      }),
      HasSubstr("beside [line.morison]"));
  EXPECT_THAT(
      refused([&] { parse(in_stream("diameter = \"0.1 m\"\nbuoyancy = true\n[line.bob_cylinders]\n" + cylinder)); }),
      HasSubstr("beside buoyancy"));
}

TEST(BodyLoads, PushASledgeByTheirImpulse) {
  const auto run =
      simulate(parse(sledge("from = \"0.313 s\"\nramp_up = \"0.5 s\"\nuntil = \"1.507 s\"\nramp_down = \"0.8 s\"\n")));
  // 6 N for 1.507 − 0.313 s, less half of the ramp up and with half of the one down.
  const double impulse = 6 * (1.194 - 0.25 + 0.4), velocity = impulse / 2;
  const auto& x = run.signal("s.surge");
  const std::size_t last = x.size() - 1;
  // Corners within a step of 5 ms leave its square of their force a second, (5e-3)² · 12 N/s over eight: 4e-5 N s.
  EXPECT_NEAR((x[last] - x[last - 50]) / 1.0, velocity, 1e-4);
  EXPECT_NEAR(run.signal("energy.load.supplied").back(), velocity * velocity, 5e-4);
  EXPECT_EQ(x[15], 0) << "at 0.3 s nothing has begun";
}

// 20 N on a mooring of 100 N/m, let go after 5 s: what acts at t = 0 acts on the rest before, too.
TEST(BodyLoads, ThatEndLaterHoldTheEquilibriumThatARunStartsIn) {
  const auto run = simulate(
      parse(water +
            "[[body]]\nname = \"b\"\nmass = \"30 kg\"\ncentre_of_gravity = \"(0, 0, 0) m\"\nfree = [\"surge\"]\n"
            "[[mooring]]\non = \"b\"\nkind = \"linear\"\nstiffness = { surge = \"100 N/m\" }\n"
            "[[load]]\non = \"b\"\nforce = \"(20, 0, 0) N\"\nuntil = \"5 s\"\nramp_down = \"0.5 s\"\n"
            "[[load]]\non = \"b\"\nforce = \"(7, 0, 0) N\"\nfrom = \"8 s\"\nramp_up = \"0.5 s\"\n"
            "[ask]\nrun = { start = \"equilibrium\", duration = \"10 s\", every = \"0.5 s\", of = [\"b.surge\"] }\n"
            "[solve]\nstep = \"0.02 s\"\n"));
  const auto& x = run.signal("b.surge");
  for (std::size_t i = 0; run.time[i] <= 5; ++i) EXPECT_NEAR(x[i], 0.2, 1e-6) << run.time[i];  // 1e-9 of the weight
  EXPECT_LT(*std::min_element(x.begin(), x.end()), -0.1) << "let go it swings";
}

// A motion without beginning has no time at which a load begins.
TEST(BodyLoads, OverTimeAreNoPartOfASteadyMotion) {
  std::string steady = sledge("until = \"1 s\"\nramp_down = \"1 s\"\n");
  steady.replace(steady.find("every = "), 8, "start = \"steady\", every = ");
  steady += "[waves]\nkind = \"regular\"\nheight = \"1 m\"\nperiod = \"5 s\"\nheading = \"0 deg\"\n";
  EXPECT_THAT(refused([&] { steady_run(parse(steady)); }),
              HasSubstr("[[load]] is left out, force and moment that rise and fall straight"));
}

TEST(BodyLoads, NeitherJumpNorHideWithinAStep) {
  EXPECT_THAT(refused([] { parse(sledge("from = \"1 s\"\n")); }), HasSubstr("give it a ramp_up"));
  EXPECT_THAT(refused([] { parse(sledge("until = \"1 s\"\n")); }), HasSubstr("give it a ramp_down"));
  EXPECT_THAT(refused([] { simulate(parse(sledge("until = \"1 s\"\nramp_down = \"10 ms\"\n", "20 ms"))); }),
              HasSubstr("a step of 0.02 s misses a load that rises or falls over 0.01 s"));
}

}  // namespace
}  // namespace line_loads_test
