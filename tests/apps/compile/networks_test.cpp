// Lines that meet, in scenes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"
#include "hydro/base/error.hpp"

namespace networks_test {
namespace {

using namespace froude;
using froude_test::parse;
using froude_test::water;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string ask = "[ask]\nrun = { duration = \"2 s\", every = \"0.02 s\" }\n";

std::string line(const std::string& name, const std::string& ends, double length, int segments,
                 const std::string& more = "") {
  return fmt::format("[[line]]\nname = \"{}\"\n{}\nlength = \"{} m\"\nsegments = {}\nmass_per_length = \"2 kg/m\"\n{}",
                     name, ends, length, segments, more);
}
const std::string knot = "[[junction]]\nname = \"knot\"\n";

/// Two legs of 4 m from (±3, 0, 0) and 2 m below them.
std::string bridle(const std::string& junction = knot, const std::string& more = "") {
  return water + junction + line("left", "from = \"(-3, 0, 0) m\"\non = { to = \"knot\" }", 4, 4, more) +
         line("right", "from = \"(3, 0, 0) m\"\non = { to = \"knot\" }", 4, 4, more) +
         line("tail", "on = { from = \"knot\" }", 2, 2, more);
}

TEST(Networks, ExampleOfTheLonglineRidesItsWavesAndItsEnergyAddsUp) {
  const auto record = simulate(scene::read(froude_test::examples / "longline.toml"));
  EXPECT_EQ(record.stopped, "");
  EXPECT_EQ(record.halvings, 0);
  const double supplied = record.signal("energy.west_anchor.supplied").back();
  EXPECT_GT(std::abs(supplied), 100);
  EXPECT_LT(std::abs(record.signal("energy.west_anchor.residual").back()), 1e-6 * std::abs(supplied));
  // The float, 0.7 m, stays at a surface that goes 0.4 m up and down.
  const auto &z = record.signal("float.z"), &surface = record.signal("wave.elevation");
  EXPECT_GT(*std::max_element(z.begin(), z.end()), 0.3);
  EXPECT_LT(*std::max_element(surface.begin(), surface.end()), 0.41);
  EXPECT_LT(*std::max_element(z.begin(), z.end()), 0.5);
}

TEST(Networks, HangAtRestAndStaySo) {
  const auto record = simulate(parse(bridle() + ask));
  EXPECT_EQ(record.stopped, "");
  for (const char* name : {"knot.z", "tail.node2.z", "left.link4.tension"}) {
    const auto& v = record.signal(name);
    EXPECT_NEAR(*std::max_element(v.begin(), v.end()), *std::min_element(v.begin(), v.end()), 1e-8) << name;
  }
  EXPECT_NEAR(record.signal("knot.x").back(), 0, 1e-9);
  EXPECT_EQ(record.signal("left.node4.z"), record.signal("knot.z"));
  EXPECT_EQ(record.signal("right.node4.z"), record.signal("tail.node0.z"));
  EXPECT_NEAR(record.signal("tail.link1.tension").back(), (4 - 1) * 9.81, 1e-7);  // half of the first link is above it
}

TEST(Networks, MeetAtANodeOfALineAsAtAJunction) {
  const std::string whole = line("span", "from = \"(-3, 0, 0) m\"\nto = \"(3, 0, 0) m\"", 8, 8) +
                            line("tail", "on = { from = \"span.node4\" }", 2, 2);
  const auto a = simulate(parse(water + whole + ask)), b = simulate(parse(bridle() + ask));
  EXPECT_NEAR(a.signal("span.node4.z").back(), b.signal("knot.z").back(), 1e-8);
  EXPECT_NEAR(a.signal("tail.node2.z").back(), b.signal("tail.node2.z").back(), 1e-8);
  EXPECT_NEAR(a.signal("span.link2.tension").back(), b.signal("left.link2.tension").back(), 1e-6);
}

// A sphere of a quarter of a cubic metre's lift draws its single line up.
TEST(Networks, MayBeOneLineWithAFloat) {
  const std::string buoy =
      "[[junction]]\nname = \"buoy\"\nmass = \"50 kg\"\ndiameter = \"0.8 m\"\nbuoyancy = true\npartial_immersion = "
      "true\n";
  const auto record =
      simulate(parse(water + buoy + line("rope", "from = \"(0, 0, -14) m\"\non = { to = \"buoy\" }", 13.5, 9) + ask));
  EXPECT_EQ(record.stopped, "");
  EXPECT_NEAR(record.signal("buoy.z").back(), -0.5, 1e-9);  // the rope is inextensible, and is straight
  // What of the sphere is 0.1 m above the water's surface is out: all is under, and lifts.
  const double V = M_PI / 6 * 0.512;
  EXPECT_NEAR(record.signal("rope.from.force").back(), 9.81 * (1000 * V - 50 - 27), 1e-6);
}

// It began above the water, on top of its rope, which stood there as a pressed column.
TEST(Networks, LetAFloatOnALongRopeDownToTheSurface) {
  const std::string buoy =
      "[[junction]]\nname = \"buoy\"\nmass = \"50 kg\"\ndiameter = \"0.8 m\"\nbuoyancy = true\npartial_immersion = "
      "true\n";
  const auto record =
      simulate(parse(water + buoy + line("rope", "from = \"(0, 0, -14) m\"\non = { to = \"buoy\" }", 20, 20) + ask));
  // Both ends carry the slack rope between them, the float 17 m of it less what it lies above the surface, to half of
  // a link.
  const double h = 0.4 - record.signal("buoy.z").front(), share = h * h * (1.2 - h) / (4 * 0.064);
  EXPECT_NEAR(share * 1000 * M_PI / 6 * 0.512, 50 + 17 * 2, 0.5 * 2 + 0.1);
  EXPECT_GT(record.signal("rope.link1.tension").front(), 0);
}

// 2 m down to where the end is tied, then a loop of 6 m, each strand of which hangs 3 m with its own weight.
TEST(Networks, MayBeALasso) {
  const auto record =
      simulate(parse(water + line("lasso", "from = \"(0, 0, 0) m\"\non = { to = \"lasso.node4\" }", 8, 16) + ask));
  EXPECT_EQ(record.stopped, "");
  EXPECT_NEAR(record.signal("lasso.node4.z").back(), -2, 1e-8);
  EXPECT_NEAR(record.signal("lasso.node10.z").back(), -5, 1e-8);
  EXPECT_EQ(record.signal("lasso.node16.z"), record.signal("lasso.node4.z"));
  EXPECT_NEAR(record.signal("lasso.link5.tension").back(), 2.75 * 2 * 9.81, 1e-5);  // to the middle of the link
  EXPECT_NEAR(record.signal("lasso.link16.tension").back(), 2.75 * 2 * 9.81, 1e-5);
}

TEST(Networks, HoldABodyByABridle) {
  const std::string body =
      "[[body]]\nname = \"b\"\nmass = \"100 kg\"\nfree = [\"surge\", \"heave\"]\nposition = \"(0, 0, -6) m\"\nweight = "
      "true\n";
  const std::string elastic = "axial_stiffness = \"200 kN\"\naxial_damping = \"2 kN s\"\n";
  const auto record = simulate(
      parse(water + body + knot + line("left", "from = \"(-3, 0, 0) m\"\non = { to = \"knot\" }", 4, 4, elastic) +
            line("right", "from = \"(3, 0, 0) m\"\non = { to = \"knot\" }", 4, 4, elastic) +
            line("tail", "from = \"(0, 0, 0) m\"\non = { from = \"b\", to = \"knot\" }", 2, 2, elastic) +
            "[ask]\nrun = { start = \"equilibrium\", duration = \"2 s\", every = \"0.02 s\" }\n"));
  EXPECT_EQ(record.stopped, "");
  EXPECT_NEAR(record.signal("tail.from.force").back(), 100 * 9.81, 1e-4);
  const auto& z = record.signal("knot.z");
  EXPECT_NEAR(z.front(), z.back(), 1e-6);
  // Straight legs would reach √7 m down; these stretch by half a percent and sag a little.
  EXPECT_NEAR(z.back(), -std::sqrt(7.0), 0.03);
}

// Lines that meet have neighbours as one: the tail of a Y swings as regularly as a pendulum when it swings little.
TEST(Networks, HaveAnExponentTogether) {
  const auto record = simulate(parse(bridle(knot, "") + "[line.lyapunov]\nfrom = \"1 s\"\n" +
                                     "[ask]\nrun = { duration = \"20 s\", every = \"0.02 s\" }\n"));
  EXPECT_EQ(record.stopped, "");
  ASSERT_EQ(record.exponents.size(), 1u);
  EXPECT_LT(std::abs(record.exponents[0].exponent.value), 0.3);
}

TEST(Networks, SayWhatCannotBe) {
  const auto refuses = [](const std::string& text, const std::string& what) {
    EXPECT_THAT([&] { simulate(parse(text)); }, ThrowsMessage<hydro::InputError>(HasSubstr(what))) << text;
  };
  const std::string span = line("span", "from = \"(-3, 0, 0) m\"\nto = \"(3, 0, 0) m\"", 8, 8);
  refuses(water + knot + span + ask, "no line is on the junction \"knot\"");
  refuses(water + knot + line("a", "from = \"(0, 0, 0) m\"\non = { to = \"knot\" }", 2, 2) + ask,
          "one line alone is on the junction");
  refuses(bridle() + line("b", "on = { from = \"knit\" }", 2, 2) + ask, "did you mean \"knot\"?");
  refuses(water + span + line("b", "on = { from = \"span.node9\" }", 2, 2) + ask, "has the nodes 0 to 8");
  refuses(water + span + line("b", "on = { from = \"span.node8\" }", 2, 2) + ask, "held already");
  refuses(water + span + line("b", "from = \"(0, 0, 0) m\"\non = { from = \"span.node4\" }", 2, 2) + ask,
          "leave it out: the place");
  refuses(water + span + line("b", "", 2, 2) + ask, "needs the key \"from\"");
  refuses(water +
              line("span", "from = \"(-3, 0, 0) m\"\nto = \"(3, 0, 0) m\"", 8, 8, "bending_stiffness = \"3 N m^2\"\n") +
              line("b", "on = { from = \"span.node4\" }", 2, 2) + ask,
          "resists bending");
  refuses(bridle("[[junction]]\nname = \"knot\"\ndiameter = \"1 m\"\n") + ask, "acts on nothing");
  refuses(bridle() + "diameter = \"50 mm\"\nbuoyancy = true\n" + ask, "the water acts on one of them alone");
  std::string far = bridle() + ask;
  far.replace(far.find("(3, 0, 0)"), 9, "(5.5, 0, 0)");
  refuses(far, "0.5 m too short");
  refuses(bridle() + "[line.release]\nnode = 1\nat = \"(0, 0, -4) m\"\n" + ask, "meets others");
  const std::string body = "[[body]]\nname = \"b\"\nmass = \"1 kg\"\nfree = [\"heave\"]\n";
  refuses(body.empty()
              ? ""
              : bridle() + body + line("c", "from = \"(0, 0, 0) m\"\non = { from = \"b\", to = \"knot\" }", 2, 2) + ask,
          "is inextensible, and meets lines that are on a body");
}

}  // namespace
}  // namespace networks_test
