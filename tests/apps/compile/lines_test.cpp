#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "apps/compile/scenes.hpp"
#include "compile/compile.hpp"
#include "dynamics/line/catenary.hpp"
#include "froude/simulate.hpp"
#include "hydro/base/error.hpp"

namespace {

using namespace froude;
using froude_test::parse;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string water = "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"14 m\"\n";
const std::string ask = "[ask]\nrun = { duration = \"2 s\", every = \"0.01 s\" }\n";
const std::string loop =
    "[[line]]\nname = \"d\"\nfrom = \"(0, 0, 0) m\"\nto = \"(2, 0, 0) m\"\nlength = \"5 m\"\nsegments = 5\n"
    "mass_per_length = \"10 kg/m\"\n";

TEST(Lines, ExampleOfTheDropperComesThroughItsGroupAndItsEnergyAddsUp) {
  const auto record = simulate(scene::read(std::filesystem::path(FROUDE_SOURCE_DIR) / "examples/dropper.toml"));
  EXPECT_EQ(record.stopped, "");
  EXPECT_EQ(record.halvings, 0);
  const double supplied = record.signal("energy.dropper.supplied").back();
  EXPECT_GT(supplied, 1000);
  EXPECT_LT(std::abs(record.signal("energy.dropper.residual").back()), 1e-6 * supplied);
}

TEST(Lines, AloneInASceneStayAtRestWhereNothingMovesThem) {
  const auto record = simulate(parse(water + loop + ask));
  EXPECT_EQ(record.stopped, "");
  for (const char* name : {"d.node2.x", "d.node2.y", "d.node2.z", "d.link3.tension", "d.link2.polar"}) {
    const auto& v = record.signal(name);
    EXPECT_NEAR(*std::max_element(v.begin(), v.end()), *std::min_element(v.begin(), v.end()), 1e-9) << name;
  }
  // Half of the weight of 50 kg hangs on either end, and a pull to the middle.
  EXPECT_GT(record.signal("d.from.force").back(), 25 * 9.81);
  EXPECT_NEAR(record.signal("d.from.force").back(), record.signal("d.to.force").back(), 1e-9);
}

TEST(Lines, StandBesideBodiesInTheSameRun) {
  const auto both =
      simulate(parse(water + loop +
                     "[[body]]\nname = \"b\"\nposition = \"(0, 0, 5) m\"\nmass = \"3 kg\"\nfree = [\"heave\"]\n"
                     "weight = true\n" +
                     ask));
  EXPECT_NEAR(both.signal("b.heave").back(), -9.81 * 2, 1e-6);
  EXPECT_NEAR(both.signal("d.node2.z").front(), both.signal("d.node2.z").back(), 1e-9);
}

TEST(Lines, AreLetGoFromWhereTheyAreHeld) {
  const std::string pendulum =
      "[[line]]\nname = \"p\"\nfrom = \"(0, 0, 0) m\"\n[[line.link]]\nlength = \"1 m\"\nmass = \"2 kg\"\n"
      "[line.release]\nnode = 1\nat = \"(0.01, 0, -0.99995) m\"\n";
  const auto record = simulate(parse(water + pendulum + ask));
  const double omega = std::sqrt(1.5 * 9.81);  // a uniform rod about its end
  EXPECT_NEAR(record.signal("p.node1.x").front(), 0.01, 1e-9);
  EXPECT_NEAR(record.signal("p.node1.x").back(), 0.01 * std::cos(2 * omega), 2e-5);  // (ωh)²/12 of 8 rad
}

TEST(Lines, FollowAPathAtTheirEnd) {
  const auto folder = std::filesystem::temp_directory_path() / "froude_lines_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "path.csv") << "time [s],x [m],y [m],z [m]\n0,2,0,0\n1,2.2,0,0.1\n2,2,0,0.2\n";
  const auto scene =
      scene::parse(water + loop + "[line.lead]\nend = \"to\"\nfile = \"path.csv\"\n" + ask, folder / "scene.toml");
  const auto record = simulate(scene);
  EXPECT_EQ(record.stopped, "");
  EXPECT_NEAR(record.signal("d.node5.x").at(100), 2.2, 1e-12);
  EXPECT_NEAR(record.signal("d.node5.z").back(), 0.2, 1e-12);
  EXPECT_NE(record.signal("energy.d.supplied").back(), 0);
  std::filesystem::remove_all(folder);
}

TEST(Lines, TakeTheSchemeThatTheSceneNames) {
  const auto lost = [](const std::string& scheme) {
    const auto record = simulate(parse(water + loop + "[line.release]\nnode = 2\nat = \"(0.5, 0.3, -1.2) m\"\n" + ask +
                                       "[solve.integrator]\nlines = \"" + scheme + "\"\n"));
    return std::abs(record.signal("energy.d.residual").back());
  };
  EXPECT_LT(lost("energy_momentum"), 1e-9);
  EXPECT_GT(lost("gamma\"\ngamma = 1.0 #"), 1);
  EXPECT_GT(lost("semi_implicit_euler"), 1e-6);
}

TEST(Lines, SayWhatCannotBe) {
  const auto refuses = [](const std::string& text, const std::string& what) {
    EXPECT_THAT([&] { simulate(parse(text)); }, ThrowsMessage<hydro::InputError>(HasSubstr(what))) << text;
  };
  std::string far = loop;
  far.replace(far.find("(2, 0, 0)"), 9, "(6, 0, 0)");
  refuses(water + far + ask, "1 m more than the 5 m");
  refuses(water + loop + "diameter = \"50 mm\"\n" + ask, "acts on nothing");
  refuses(water + loop + "diameter = \"50 mm\"\npartial_immersion = true\n" + ask, "nothing of the water");
  refuses(water + loop + "morison = { cd = 1, ca = 1 }\n" + ask, "acts only beside \"diameter\"");
  refuses(water + loop + "[line.release]\nnode = 5\nat = \"(0, 0, 0) m\"\n" + ask, "not a free node");
  refuses(water + loop + ask + "[solve.integrator]\ngamma = 0.6\n", "acts only with lines");
  refuses(water + "[[line]]\nfrom = \"(0, 0, 0) m\"\nlength = \"5 m\"\nsegments = 3\n" + ask, "mass_per_length");
  refuses("schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"infinite\"\n" + loop +
              "diameter = \"50 mm\"\n[line.bed]\nstiffness = \"1 MPa/m\"\n" + ask,
          "infinitely deep");
}

TEST(Lines, SagWhereTheSceneSaysSo) {
  const std::string chain =
      "[[line]]\nname = \"c\"\nfrom = \"(30, 0, -14) m\"\nto = \"(0, 0, 0) m\"\nlength = \"36 m\"\nsegments = 6\n"
      "mass_per_length = \"10 kg/m\"\ndiameter = \"30 mm\"\naxial_stiffness = \"1 MN\"\nsags = true\nbuoyancy = true\n"
      "[line.bed]\nstiffness = \"3 MPa/m\"\n";
  const std::string alike = "[solve.integrator]\nlines = \"generalized_alpha\"\n";
  const auto record = simulate(parse(water + chain + ask + alike));
  const double weight = (10 - 1000 * std::numbers::pi / 4 * 0.03 * 0.03) * 9.81;
  const auto exact = dynamics::catenary({36, weight, 1e6, true}, 30, 14);
  // Six segments; the parabola of (D88) on slopes of up to 60 degrees.
  EXPECT_NEAR(record.signal("c.to.force").back() / exact.fairlead(), 1, 2e-3);
  EXPECT_THAT([&] { simulate(parse(water + chain + ask)); },
              ThrowsMessage<hydro::InputError>(HasSubstr("segments that sag")));
}

TEST(Lines, ArePlanned) {
  const auto scene = parse(water + loop + ask);
  const auto model = compile::time_model(scene, compile::prepare(scene));
  ASSERT_EQ(model.plan.size(), 1u);
  EXPECT_EQ(model.plan[0].effect, "line d");
  EXPECT_THAT(model.plan[0].size, HasSubstr("5 segments"));
}

}  // namespace
