#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "answers/simulate.hpp"
#include "apps/compile/same_water.hpp"
#include "apps/compile/scenes.hpp"
#include "compile/compile.hpp"
#include "compile/kept.hpp"
#include "dynamics/force/fastened_line.hpp"
#include "dynamics/line/catenary.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/synthesis/boxed_field.hpp"
#include "scene/finer.hpp"
#include "support/scratch.hpp"
#include "support/source_dir.hpp"

namespace lines_test {
namespace {

using namespace froude;
using froude_test::expect_same_water;
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
  const auto record = simulate(scene::read(froude_test::source_dir() / "examples/dropper.toml"));
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

// A table is made where it is looked up often enough, one for all runs beside one another; the water is the same.
TEST(Lines, InALongRunReadTheSeaFromATable) {
  auto s = parse(water + "[waves]\nkind = \"jonswap\"\nhs = \"1 m\"\ntp = \"5 s\"\nheading = \"30 deg\"\n" + loop +
                 "diameter = \"50 mm\"\nmorison = { cd = 1, ca = 1 }\n" + ask);
  s.run->duration = 0.2;
  const compile::Prepared prepared = compile::prepare(s);
  const compile::RunWater summed = compile::time_model(s, prepared).water;
  s.run->duration = 100;
  const compile::RunWater tabled = compile::time_model(s, prepared).water;
  EXPECT_EQ(summed.around_lines->tables(), 0);
  EXPECT_EQ(tabled.around_lines->tables(), 1);
  EXPECT_EQ(tabled.around_members, nullptr);
  expect_same_water(*summed.of_lines, *tabled.of_lines);
  const std::size_t made = prepared.kept->water_of_lines().made();
  compile::time_model(scene::with_finer_lines(s, 2), prepared);
  EXPECT_EQ(prepared.kept->water_of_lines().made(), made) << "twice as many segments are at rest almost there";
}

/// A bob on a link without mass, as a film sees it: a place and a velocity.
std::string filmed(const std::string& start) {
  return water +
         "[[line]]\nname = \"p\"\nfrom = \"(0, 0, 0) m\"\nnode_mass = \"2 kg\"\nlink = [{ length = \"1 m\", mass = \"0 "
         "kg\" }]\n"
         "[line.start]\n" +
         start + ask + "[solve]\nstep = \"0.0025 s\"\n";
}

TEST(Lines, StartAsTheyWereMeasuredAndSwingOnFromThere) {
  // Small swings: θ = θ₀ cos ωt + θ̇₀/ω sin ωt, ω² = g/L, about the vertical; amplitude 0.06: ω is lower by 2e-4.
  const auto record =
      simulate(parse(filmed("at = [\"(0.05, 0, -0.99875) m\"]\nvelocity = [\"(0.1, 0, 0.005) m/s\"]\n")));
  const double omega = std::sqrt(9.80665);
  for (const std::size_t i : {std::size_t{0}, std::size_t{50}, std::size_t{120}, std::size_t{200}}) {
    const double t = record.time[i];
    EXPECT_NEAR(record.signal("p.node1.x")[i], 0.05 * std::cos(omega * t) + 0.1 / omega * std::sin(omega * t), 1e-4)
        << t;
  }
  EXPECT_NEAR(record.signal("p.node1.y").back(), 0, 1e-12);
}

TEST(Lines, StartAsTheyWereMeasuredWithLinksBroughtToTheirLengths) {
  const auto measured = parse(filmed("at = [\"(0.606, 0, -0.808) m\"]\n"));  // 1 % too far out
  const auto record = simulate(measured);
  EXPECT_NEAR(record.signal("p.node1.x").front(), 0.6, 1e-9);
  EXPECT_NEAR(record.signal("p.node1.z").front(), -0.8, 1e-9);
  EXPECT_THAT([] { simulate(parse(filmed("at = [\"(0.66, 0, -0.88) m\"]\n"))); },
              ThrowsMessage<hydro::InputError>(
                  AllOf(HasSubstr("link 1 is 1.1 m long where the line starts"), HasSubstr("3 %"))));
  EXPECT_THAT([] { parse(filmed("at = [\"(0.6, 0, -0.8) m\", \"(1, 0, -1) m\"]\n")); },
              ThrowsMessage<hydro::InputError>(HasSubstr("has 2 nodes, the line has 1 that are not held")));
  EXPECT_THAT([] { parse(filmed("at = [\"(0.6, 0, -0.8)\"]\n")); },
              ThrowsMessage<hydro::InputError>(HasSubstr("unit")));
  EXPECT_THAT([] { parse(filmed("at = [\"(0.6, 0, -0.8) m\"]\n[line.release]\nnode = 1\nat = \"(1, 0, 0) m\"\n")); },
              ThrowsMessage<hydro::InputError>(HasSubstr("so does [line.release]")));
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

// The place is brought to the length of the link, from which rounding, 1e-17 m, must not keep it.
TEST(Lines, AreLetGoFromWhereverALinkReaches) {
  for (int i = 1; i < 60; ++i) {
    const double angle = 0.05 * i;
    const auto record = simulate(
        parse(water + "[[line]]\nname = \"p\"\nfrom = \"(0.3, 0.1, 2) m\"\n[[line.link]]\nlength = \"1.1 m\"\n" +
              fmt::format("mass = \"2 kg\"\n[line.release]\nnode = 1\nat = \"({:.6f}, 0.1, {:.6f}) m\"\n",
                          0.3 + 1.1 * std::cos(angle), 2 - 1.1 * std::sin(angle)) +
              "[ask]\nrun = { duration = \"0.02 s\", every = \"0.01 s\" }\n"));
    EXPECT_EQ(record.stopped, "") << angle;
    EXPECT_NEAR(record.signal("p.link1.polar").front(), angle, 2e-6) << "not mirrored where the link goes towards -x";
  }
}

TEST(Lines, TellWhereAPlaceOfReleaseWasBrought) {
  const auto record = simulate(
      parse(water +
            "[[line]]\nname = \"p\"\nfrom = \"(0, 0, 0) m\"\n[[line.link]]\nlength = \"1 m\"\nmass = \"2 kg\"\n"
            "[line.release]\nnode = 1\nat = \"(0.9995, 0, 0) m\"\n" +
            ask));
  EXPECT_THAT(record.notes, testing::Contains(testing::AllOf(HasSubstr("line p"), HasSubstr("0.0005 m"))));
}

TEST(Lines, FollowAPathAtTheirEnd) {
  const auto folder = support::scratch_folder() / "froude_lines_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "path.csv") << "time [s],x [m],y [m],z [m]\n0,2,0,0\n1,2.2,0,0.1\n2,2,0,0.2\n";
  const auto scene = scene::parse(water + loop + "[line.prescribed]\nend = \"to\"\nfile = \"path.csv\"\n" + ask,
                                  folder / "scene.toml");
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
  const std::string body =
      "[[body]]\nname = \"b\"\nmass = \"10 kg\"\ncentre_of_gravity = \"(0, 0, 0) m\"\n"
      "radii_of_gyration = \"(1, 1, 1) m\"\n";
  refuses(water + body + loop +
              "axial_stiffness = \"1 kN\"\non = { from = \"b\" }\n[line.lyapunov]\nfrom = \"0.5 s\"\n" + ask,
          "which goes on from accelerations too");
}

TEST(Lines, SagWhereTheSceneSaysSo) {
  const std::string chain =
      "[[line]]\nname = \"c\"\nfrom = \"(30, 0, -14) m\"\nto = \"(0, 0, 0) m\"\nlength = \"36 m\"\nsegments = 6\n"
      "mass_per_length = \"10 kg/m\"\ndiameter = \"30 mm\"\naxial_stiffness = \"1 MN\"\ncatenary_segments = "
      "true\nbuoyancy = true\n"
      "[line.bed]\nstiffness = \"3 MPa/m\"\n";
  const std::string alike = "[solve.integrator]\nlines = \"generalized_alpha\"\n";
  const auto record = simulate(parse(water + chain + ask + alike));
  const double weight = (10 - 1000 * std::numbers::pi / 4 * 0.03 * 0.03) * 9.81;
  const auto exact = dynamics::catenary({36, weight, 1e6, true}, 30, 14);
  // Six segments; the parabola of (D88) on slopes of up to 60 degrees.
  EXPECT_NEAR(record.signal("c.to.force").back() / exact.fairlead(), 1, 2e-3);
  EXPECT_THAT([&] { simulate(parse(water + chain + ask)); },
              ThrowsMessage<hydro::InputError>(HasSubstr("catenary segments")));
}

TEST(Lines, AreSteppedByRosenbrockWhereTheyStretch) {
  const std::string chain =
      "[[line]]\nname = \"c\"\nfrom = \"(30, 0, -14) m\"\nto = \"(0, 0, 0) m\"\nlength = \"36 m\"\nsegments = 6\n"
      "mass_per_length = \"10 kg/m\"\ndiameter = \"30 mm\"\naxial_stiffness = \"1 MN\"\nbuoyancy = true\n";
  const std::string waves = "[waves]\nkind = \"regular\"\nheight = \"1 m\"\nperiod = \"4 s\"\nheading = \"0 deg\"\n",
                    wet = "[line.morison]\ncd = 1.2\nca = 1.0\n";
  const auto pull = [&](const std::string& integrator, double h) {
    const auto record =
        simulate(parse(water + waves + chain + wet + ask + fmt::format("[solve]\nstep = \"{} s\"\n", h) +
                       "[solve.integrator]\n" + integrator));
    EXPECT_EQ(record.stopped, "");
    return record.signal("c.to.force").back();
  };
  const double exact = pull("lines = \"generalized_alpha\"\n", 1e-4);
  EXPECT_NEAR(pull("lines = \"rosenbrock\"\n", 0.01) / exact, 1, 1e-4);
  EXPECT_NEAR(pull("lines = \"rosenbrock\"\nline_tolerance = 1e-7\n", 0.01) / exact, 1, 1e-5);
  const auto refuses = [&](const std::string& text, const std::string& what) {
    EXPECT_THAT([&] { simulate(parse(text)); }, ThrowsMessage<hydro::InputError>(HasSubstr(what))) << text;
  };
  const std::string own = "[solve.integrator]\nlines = \"rosenbrock\"\n";
  refuses(water + loop + ask + own, "not made for inextensible segments");
  refuses(water + chain + "bending_stiffness = \"10 N m^2\"\n" + ask + own, "bending");
  refuses(water + chain + ask + own + "line_tolerance = 0\n", "line_tolerance");
  refuses(water + chain + ask + "[solve.integrator]\nline_tolerance = 1e-4\n", "lines = \"rosenbrock\"");
  refuses(water + chain + "[line.lyapunov]\nfrom = \"0.5 s\"\n" + ask + own, "no neighbours in steps of rosenbrock");
}

// w L⁴/8EI of a beam clamped level, a little more than a hundredth of its length; and w L²/2 at the clamp.
TEST(Lines, BendAsBeamsWhereTheyAreClamped) {
  const auto beam = [](const std::string& more) {
    return "[[line]]\nname = \"b\"\nfrom = \"(0, 0, 0) m\"\nlength = \"2 m\"\nsegments = 40\n"
           "mass_per_length = \"1 kg/m\"\nbending_stiffness = \"1000 N m^2\"\n" +
           more;
  };
  const auto record = simulate(parse(water + beam("clamp = { from = \"x\" }\n") + ask));
  const double w = 9.81;
  EXPECT_NEAR(record.signal("b.node40.z").back() / (-w * 16 / 8 / 1000), 1, 2e-3);
  EXPECT_NEAR(record.signal("b.from.moment").back() / (w * 2), 1, 1e-3);
  EXPECT_NEAR(record.signal("b.node1.curvature").back() / (w * 1.95 * 1.95 / 2 / 1000), 1, 1e-3);
  // Without a clamp it hangs down; as a part that is not stiff it hangs down from where it begins.
  EXPECT_NEAR(simulate(parse(water + beam("") + ask)).signal("b.node40.z").back(), -2, 1e-9);
  const auto refuses = [&](const std::string& more, const std::string& what) {
    EXPECT_THAT([&] { simulate(parse(water + beam(more) + ask)); }, ThrowsMessage<hydro::InputError>(HasSubstr(what)));
  };
  refuses("clamp = { to = \"x\" }\n", "clamps a free end");
  refuses("diameter = \"50 mm\"\naxial_stiffness = \"1 MN\"\ncatenary_segments = true\nbuoyancy = true\n",
          "no straight axis");
}

// A rod that is damped beyond swinging: the slower root of s² + (3b/m) s + 3g/2ℓ = 0.
TEST(Lines, TellHowFastNeighboursPart) {
  const std::string rod =
      "[[line]]\nname = \"p\"\nfrom = \"(0, 0, 0) m\"\n[[line.link]]\nlength = \"1 m\"\nmass = \"2 kg\"\n"
      "[line.damping]\nlinear = \"8 kg/s\"\n[line.lyapunov]\nfrom = ";
  const std::string longer = "[ask]\nrun = { duration = \"10 s\", every = \"0.02 s\" }\n[solve]\nstep = \"0.01 s\"\n";
  const auto record = simulate(parse(water + rod + "\"4 s\"\n" + longer));
  ASSERT_EQ(record.exponents.size(), 1u);
  const dynamics::Exponent& e = record.exponents.front().exponent;
  EXPECT_NEAR(e.value, -6 + std::sqrt(36 - 1.5 * 9.81), 1e-4);  // s³h²/12 of the midpoint rule
  EXPECT_EQ(e.from, 4);
  const auto& parting = record.signal("p.parting");
  EXPECT_NEAR((parting.back() - parting.at(200)) / 6, e.value, 1e-9);
  const auto refuses = [](const std::string& text, const std::string& what) {
    EXPECT_THAT([&] { simulate(parse(text)); }, ThrowsMessage<hydro::InputError>(HasSubstr(what))) << text;
  };
  refuses(water + rod + "\"9.8 s\"\n" + longer, "fewer than 20 samples");
  refuses(water + rod + "\"4 s\"\n" + longer + "[solve.integrator]\nlines = \"generalized_alpha\"\n",
          "has no neighbours in steps of generalized_alpha");
}

class LinesByTable : public testing::Test {
 protected:
  LinesByTable() : folder(support::scratch_folder() / "lines_by_table") { std::filesystem::create_directories(folder); }
  ~LinesByTable() override { std::filesystem::remove_all(folder); }
  froude::Run run(const std::string& morison, const std::string& table, const std::string& more = "") const {
    std::ofstream(folder / "table.csv") << table;
    return simulate(scene::parse(water +
                                     "[waves]\nkind = \"regular\"\nheight = \"0.4 m\"\nperiod = \"4 s\"\n"
                                     "heading = \"0 deg\"\n" +
                                     more + loop + "diameter = \"50 mm\"\n[line.morison]\n" + morison + ask,
                                 folder / "scene.toml"));
  }
  std::filesystem::path folder;
};

TEST_F(LinesByTable, MoveAsWithTheSameNumbersGiven) {
  const auto table = run("file = \"table.csv\"\n", "KC, cd, ca\n0.01, 1.3, 0.8\n100, 1.3, 0.8\n"),
             given = run("cd = 1.3\nca = 0.8\n", "");
  for (const char* name : {"d.node2.x", "d.link3.tension"})
    EXPECT_NEAR(table.signal(name).back() / given.signal(name).back(), 1, 1e-12) << name;
  EXPECT_GT(std::abs(table.signal("d.node2.x").back() - table.signal("d.node2.x").front()), 1e-3);
  const auto other = run("file = \"table.csv\"\n", "KC, cd, ca\n0.01, 1.3, 0.8\n100, 2.6, 0.8\n");
  EXPECT_GT(std::abs(other.signal("d.link3.tension").back() / given.signal("d.link3.tension").back() - 1), 1e-4);
  EXPECT_THAT(other.notes,
              testing::Contains(AllOf(HasSubstr("line d: C_D "), HasSubstr("C_A 0.8 by table.csv at KC "))));
}

TEST_F(LinesByTable, RefuseWhatTheTableDoesNotHold) {
  const auto refuses = [&](const std::string& morison, const std::string& table, const std::string& what,
                           const std::string& more = "") {
    EXPECT_THAT([&] { run(morison, table, more); }, ThrowsMessage<hydro::InputError>(HasSubstr(what))) << what;
  };
  const std::string file = "file = \"table.csv\"\n", narrow = "KC, cd, ca\n20, 1.3, 0.8\n30, 1.3, 0.8\n",
                    reynolds = "KC, Re, cd, ca\n0.1, 1e3, 1, 1\n90, 1e3, 1, 1\n0.1, 1e7, 1, 1\n90, 1e7, 1, 1\n";
  refuses(file, narrow, "and the table goes from 20 to 30");
  refuses(file, reynolds, "needs a viscosity");
  refuses(file + "viscosity = \"1e-6 m^2/s\"\n", narrow, "has no column Re");
  refuses(file + "viscosity = \"1 m^2/s\"\n", reynolds, "Re is ");
  refuses("cd = 1\n", narrow, "needs the key \"ca\"");
  refuses(file, narrow, "together with a current", "[current]\nvelocity = \"(1, 0, 0) m/s\"\n");
  run(file + "viscosity = \"1e-6 m^2/s\"\n", reynolds);
}

// Pulled aside along the bed and let go, it comes back; with friction it lies where it was put. (D95)
TEST(Lines, LieWhereTheyArePutByFrictionOfTheBed) {
  const auto nearest = [](const std::string& friction) {
    const auto record = simulate(
        parse(water + ask +
              "[[line]]\nname = \"d\"\nfrom = \"(0, 0, -13) m\"\nto = \"(10, 0, -13) m\"\nlength = \"11 m\"\n"
              "segments = 10\nmass_per_length = \"10 kg/m\"\ndiameter = \"50 mm\"\naxial_stiffness = \"1 MN\"\n"
              "axial_damping = \"3 kN s\"\n[line.bed]\nstiffness = \"1 MPa/m\"\ndamping = \"0.1 MPa s/m\"\n" +
              friction + "[line.release]\nnode = 5\nat = \"(5, 0.2, -14) m\"\n"));
    const auto y = record.signal("d.node5.y");
    return *std::min_element(y.begin(), y.end());
  };
  EXPECT_GT(nearest("friction = 1.0\n"), 0.19);
  EXPECT_LT(nearest(""), 0.15);
}

/// A body that may only surge, heavy beside its two chains.
std::string between(const std::string& chains, const std::string& more = "") {
  return water + "[[body]]\nname = \"b\"\nmass = \"2000 t\"\nfree = [\"surge\"]\ninitial.surge = \"0.3 m\"\n" + more +
         chains + "[ask]\nrun = { duration = \"30 s\", every = \"0.1 s\" }\n";
}
std::string chain_of_nodes(const std::string& name, int side, const std::string& more = "catenary_segments = true\n") {
  return fmt::format(
      "[[line]]\nname = \"{}\"\nfrom = \"({}, 0, 0) m\"\nto = \"({}, 0, -14) m\"\non = {{ from = \"b\" }}\n"
      "length = \"40 m\"\nsegments = 20\nmass_per_length = \"8 kg/m\"\ndiameter = \"36 mm\"\nbuoyancy = true\n"
      "axial_stiffness = \"30 MN\"\n{}[line.bed]\nstiffness = \"30 MPa/m\"\n",
      name, side, side * 38, more);
}

// 640 kg of chain on a body of 2000 t that swings in half a minute: the chains' own motion is of no account, and their
// pull is that of the catenary in its static shape.
TEST(Lines, OnAHeavySlowBodyPullAsCatenaries) {
  const std::string catenary =
      "[[mooring]]\nname = \"c\"\non = \"b\"\nkind = \"catenary\"\nfrom = \"(±1, 0, 0) m\"\nto = \"(±38, 0, -14) m\"\n"
      "length = \"40 m\"\nmass_per_length = \"8 kg/m\"\ndiameter = \"36 mm\"\naxial_stiffness = \"30 MN\"\non_bed = "
      "true\n";
  const auto static_shape = simulate(parse(between(catenary)));
  const auto nodes = simulate(parse(between(chain_of_nodes("fore", 1) + chain_of_nodes("aft", -1))));
  EXPECT_EQ(nodes.stopped, "");
  const auto &a = static_shape.signal("b.surge"), &b = nodes.signal("b.surge");
  EXPECT_LT(*std::min_element(a.begin(), a.end()), 0.1);                          // it does swing
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 6e-3) << i;  // segments of 2 m; mass of the chains
}

// A weight of 5 kg let go a metre above where its rope is straight falls free for half the time, then snaps.
TEST(Lines, CountTheirSnaps) {
  const std::string rope =
      "[[line]]\nname = \"r\"\nfrom = \"(0, 0, 0) m\"\nto = \"(0, 0, 0) m\"\non = { to = \"w\" }\nlength = \"2 "
      "m\"\nsegments = 1\n"
      "mass_per_length = \"10 g/m\"\naxial_stiffness = \"20 kN\"\ntension_only = true\n"
      "snaps = { slack_below = \"1 N\", snap_above = \"500 N\" }\n";
  const auto record = simulate(
      parse(water +
            "[[body]]\nname = \"w\"\nposition = \"(0, 0, -2) m\"\nmass = \"5 kg\"\nweight = true\nfree = [\"heave\"]\n"
            "initial.heave = \"1 m\"\n" +
            rope + "[ask]\nrun = { duration = \"0.9 s\", every = \"2 ms\" }\n"));
  ASSERT_EQ(record.snaps.size(), 1u);
  const auto& s = record.snaps.front();
  // Falls √(2/g) = 0.4515 s, is caught for half a period, √(M/k) π and a little, and flies up as long again.
  const double k = 1e4, caught = std::numbers::pi * std::sqrt(5 / k), fall = std::sqrt(2 / 9.81);
  EXPECT_NEAR(s.slack_share, (0.9 - caught) / 0.9, 0.01);
  EXPECT_EQ(s.snaps, 1);
  EXPECT_NEAR(s.at, fall + caught / 2, 4e-3);
  EXPECT_NEAR(s.largest_tension, 5 * 9.81 + std::sqrt(5 * k * 2 * 9.81 + std::pow(5 * 9.81, 2)), 20);
  EXPECT_EQ(s.link, 1);
}

TEST(Lines, ExampleOnAModuleFloatsAndItsEnergyAddsUp) {
  const auto record = simulate(scene::read(froude_test::source_dir() / "examples/chained.toml"));
  EXPECT_EQ(record.stopped, "");
  EXPECT_EQ(record.halvings, 0);
  const auto found = [&](const std::string& name) {
    return std::find_if(record.energy.begin(), record.energy.end(), [&](const auto& e) { return e.first == name; })
        ->second;
  };
  EXPECT_LT(std::abs(found("residual")), 2e-2 * found("turnover"));
  // It begins where the pull is that of the catenary; 12 catenary segments have it to some 0.1 %.
  const double weight = (8 - 1000 * std::numbers::pi / 4 * 0.036 * 0.036) * 9.81;
  const auto at = dynamics::catenary({48, weight, 30e6, true}, 44.8, 12.9 + record.signal("module.heave").front());
  EXPECT_NEAR(record.signal("fore.from.force").front() / at.fairlead(), 1, 5e-3);
  ASSERT_EQ(record.snaps.size(), 1u);
  EXPECT_EQ(record.snaps.front().line, "fore");
  EXPECT_GT(record.snaps.front().largest_tension, record.signal("fore.from.force").front());
}

TEST(Lines, OnBodiesSayWhatCannotBe) {
  const auto refuses = [](const std::string& text, const std::string& what) {
    EXPECT_THAT([&] { simulate(parse(text)); }, ThrowsMessage<hydro::InputError>(HasSubstr(what))) << text;
  };
  const std::string one = chain_of_nodes("fore", 1);
  std::string other = one, rigid = one;
  other.replace(other.find("from = \"b\""), 10, "from = \"c\"");
  refuses(between(other), "\"c\"");
  rigid.replace(rigid.find("axial_stiffness = \"30 MN\"\ncatenary_segments = true\n"), 51, "");
  refuses(between(rigid), "axial_stiffness");
  refuses(between(one) + "[solve.integrator]\nname = \"energy_momentum\"\n", "cannot step a body together with line");
  refuses(between(one) + "[solve.integrator]\nlines = \"generalized_alpha\"\n", "acts on no line");
  refuses(between(one + "[line.release]\nnode = 2\nat = \"(0, 0, -3) m\"\n"), "begins with it");
}

// A line that hangs from its first end: each segment carries what is below its middle, the first end all of it.
TEST(Lines, InPartsHangWithTheWeightOfEach) {
  const std::string parts = R"([[line]]
name = "d"
from = "(0, 0, -1) m"
axial_stiffness = "1 GN"
diameter = "20 mm"
buoyancy = true
[[line.part]]
length = "4 m"
segments = 2
mass_per_length = "10 kg/m"
[[line.part]]
length = "6 m"
segments = 3
mass_per_length = "3 kg/m"
diameter = "50 mm"
axial_stiffness = "1 MN"
)";
  const auto record = simulate(parse(water + parts + ask));
  const double pi = std::numbers::pi, above = 4 * (10 - 1000 * pi / 4 * 4e-4) * 9.81,
               below = 6 * (3 - 1000 * pi / 4 * 25e-4) * 9.81;
  EXPECT_NEAR(record.signal("d.from.force").front(), above + below, 1e-8 * above);  // equilibrium stops at 1e-10 or so
  EXPECT_NEAR(record.signal("d.link3.tension").front(), below * 5 / 6, 1e-8 * above);
  // Strains: of the first part 4e-7, of the second T/EA.
  EXPECT_NEAR(record.signal("d.node5.z").front(), -1 - 10 - below / 2 * 6 / 1e6 - (below + above / 2) * 4 / 1e9, 1e-9);
}

TEST(Lines, GrowHeavierAndWider) {
  const std::string bare = R"([[line]]
name = "d"
from = "(0, 0, -1) m"
length = "10 m"
segments = 5
mass_per_length = "3 kg/m"
diameter = "50 mm"
buoyancy = true
)";
  const std::string growth =
      "[line.growth]\nthickness = \"25 mm\"\ndensity = \"1300 kg/m^3\"\nfrom = \"3.5 m\"\nto = \"8.5 m\"\n";
  const auto top = [](const auto& record) { return record.signal("d.from.force").front(); };
  // Middles of segments 3 and 4, at 5 and 7 m, lie inside; that of 2, at 3 m, and of 5, at 9 m, do not.
  const double layer = std::numbers::pi / 4 * (0.1 * 0.1 - 0.05 * 0.05) * 4;
  EXPECT_NEAR(top(simulate(parse(water + bare + growth + ask))) - top(simulate(parse(water + bare + ask))),
              layer * (1300 - 1000) * 9.81, 1e-8);
  const auto refuses = [&](const std::string& text, const std::string& what) {
    EXPECT_THAT([&] { parse(water + text + ask); }, ThrowsMessage<hydro::InputError>(HasSubstr(what)));
  };
  refuses(bare + "[line.growth]\nthickness = \"25 mm\"\ndensity = \"1300 kg/m^3\"\nto = \"12 m\"\n",
          "of a line of 10 m");
}

bool has_lines_on_bodies(const dynamics::Model& model) {
  return std::any_of(model.forces().begin(), model.forces().end(), [](const auto& kind) {
    return dynamic_cast<const dynamics::FastenedLineKind*>(kind.get()) != nullptr;
  });
}

TEST(Lines, AreNotMadeWhereTheSceneNamesNone) {
  const auto scene = parse(between(""));
  const auto model = compile::time_model(scene, compile::prepare(scene));
  EXPECT_TRUE(model.lines.empty());
  EXPECT_FALSE(has_lines_on_bodies(model.model));
  const auto with = parse(between(chain_of_nodes("fore", 1)));
  EXPECT_TRUE(has_lines_on_bodies(compile::time_model(with, compile::prepare(with)).model));
}

TEST(Lines, ArePlanned) {
  const auto scene = parse(water + loop + ask);
  const auto model = compile::time_model(scene, compile::prepare(scene));
  ASSERT_EQ(model.plan.size(), 2u);
  EXPECT_EQ(model.plan[0].effect, "step");
  EXPECT_EQ(model.plan[1].effect, "line d");
  EXPECT_THAT(model.plan[1].size, HasSubstr("5 segments"));
}

}  // namespace
}  // namespace lines_test
