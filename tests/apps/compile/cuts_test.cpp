// What segments of lines and pieces of members leave out of a run is told: against closed forms, and against lines that
// are cut eight times finer. (E4)
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <numeric>
#include <variant>

#include "answers/simulate.hpp"
#include "hydro/base/error.hpp"
#include "scene/finer.hpp"
#include "support/run_errors.hpp"

namespace cuts_test {
namespace {

using namespace froude;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// The linear damping of each node, kg/s: what a node at one metre a second feels.
double damping_of(const scene::Line& line) {
  return -line.node.share * line.node.forces.at(0)->force({0, {0, 0, 0}, {1, 0, 0}}, nullptr).x();
}

scene::Scene parse(const std::string& text) { return scene::parse(text, "scene.toml"); }

const std::string water = "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"100 m\"\n";

/// A rope of 10 m and 2 kg/m from the origin.
std::string rope(int segments, const std::string& more, const std::string& ask) {
  return water +
         fmt::format(
             "[[line]]\nname = \"rope\"\nfrom = \"(0, 0, 0) m\"\nlength = \"10 m\"\nsegments = {}\n"
             "mass_per_length = \"2 kg/m\"\n",
             segments) +
         more + "[ask]\n" + ask;
}

/// What the source of this name makes of each signal.
const std::vector<double>& told(const froude::Run& run, const std::string& source) {
  const auto at =
      std::find_if(run.error.sources.begin(), run.error.sources.end(), [&](const auto& s) { return s.name == source; });
  if (at == run.error.sources.end()) throw std::runtime_error("the run has no error of " + source);
  return at->of_signal;
}

double told(const froude::Run& run, const std::string& source, const std::string& signal) {
  const auto at = std::find_if(run.signals.begin(), run.signals.end(), [&](const auto& s) { return s.name == signal; });
  if (at == run.signals.end()) throw std::runtime_error("no signal " + signal);
  return told(run, source)[static_cast<std::size_t>(at - run.signals.begin())];
}

// In still air a rope hangs at rest: the step makes no error, and the segments make one that is known.
const std::string at_rest = "run = { duration = \"1 s\", every = \"0.1 s\" }\n[solve]\nstep = \"0.05 s\"\n";

TEST(Cuts, TheLargestTensionOfAHangingRopeIsTheWeightBelowTheMiddleOfItsFirstLink) {
  for (const int n : {5, 10}) {
    const auto run = simulate(parse(rope(n, "", at_rest)));
    // (1 - 1/(2n)) of the weight, of order 1, for which the estimate is exact.
    EXPECT_NEAR(told(run, "segments", "rope.largest_tension"), 1 / (2.0 * n) / (1 - 1 / (2.0 * n)), 1e-9);
    EXPECT_NEAR(told(run, "segments", "rope.from.force"), 0, 1e-9);  // all of the weight, whatever the segments
    // The middle link has its mean tension in its middle, as both halves together have.
    EXPECT_NEAR(told(run, "segments", "rope.link3.tension"), 0, 1e-9);
    EXPECT_THAT(run.warnings(), Contains(AllOf(HasSubstr("rope.largest_tension is off"),
                                               HasSubstr("from the segments that the scene gives"))));
  }
}

TEST(Cuts, ASagIsOffByWhatTheCatenaryHas) {
  // Length S = 10 m between ends 6 m apart: S = 2 a sinh(3/a), the sag a (cosh(3/a) - 1).
  double a = 1;
  for (int i = 0; i < 100; ++i) a = 3 / std::asinh(5 / a);
  const double sag = a * (std::cosh(3 / a) - 1);
  for (const int n : {10, 20}) {
    const auto run = simulate(parse(rope(n, "to = \"(6, 0, 0) m\"\n", at_rest)));
    const std::string middle = fmt::format("rope.node{}.z", n / 2);
    const double off = std::abs(-run.signal(middle).back() - sag) / sag;
    // Of order 2 the estimate is 2 (1 - 1/4) of the error; the next order is 1/n^2 of it, some per cent.
    EXPECT_NEAR(told(run, "segments", middle) / off, 1.5, 0.1) << n;
    EXPECT_GT(off, 1e-4);
  }
}

/// Let go with its free end 6 m aside, it swings in water for some two periods.
std::string swinging(int segments) {
  return rope(segments,
              fmt::format("diameter = \"50 mm\"\nbuoyancy = true\nmass_at = \"nodes\"\n[line.morison]\ncd = 1.2\nca = "
                          "1.0\n[line.damping]\nlinear = \"{} kg/s\"\n[line.release]\nnode = {}\nat = \"(6, 0, -7) "
                          "m\"\n",
                          8.0 / segments, segments),
              "run = { duration = \"8 s\", every = \"0.1 s\" }\n[solve]\nstep = \"0.02 s\"\naccept_error = true\n");
}

TEST(Cuts, TheErrorOfASwingingRopeIsToldWithinAFactorFour) {
  const auto coarse = parse(swinging(6));
  const auto run = simulate(coarse), fine = simulate(parse(swinging(48)));
  const auto sizes = support::sizes(run);
  int judged = 0;
  for (std::size_t i = 0; i < run.signals.size(); ++i) {
    const auto& s = run.signals[i];
    const auto names = scene::names_where_finer(coarse, 8, s.name);
    std::vector<double> reference(s.values.size(), 0.0);
    for (const auto& name : names)
      for (std::size_t k = 0; k < reference.size(); ++k)
        reference[k] += fine.signal(name)[k] / static_cast<double>(names.size());
    // Tensions, places and energies; rates and directions of links have waves of half a segment's length in them, which
    // no cut has right. What is off by less than 1e-3 is the sum of errors that cancel. Extremes are told farthest off,
    // whose errors may change their sign from N to 2N: 2 |e(N) - e(2N)| is then more than three times e(N).
    const bool sure = s.name.ends_with(".z") || s.name.ends_with(".x") || s.name.ends_with("force") ||
                      s.name.ends_with("tension") || s.name.ends_with("stored") || s.name.ends_with("kinetic");
    const double error = support::relative_error(s.values, reference, sizes[i], reference.size());
    if (!sure || !(error > 1e-3)) continue;
    ++judged;
    EXPECT_LT(told(run, "segments")[i] / error, 4) << s.name << " " << error;
    EXPECT_GT(told(run, "segments")[i] / error, 1.0 / 4) << s.name << " " << error;
  }
  EXPECT_GT(judged, 12);
}

TEST(Cuts, OddAndEvenMakeNoDifference) {
  const auto even = simulate(parse(swinging(8))), odd = simulate(parse(swinging(7)));
  // The errors of 7 and 8 segments are some (8/7)^2 apart.
  EXPECT_NEAR(told(odd, "segments", "rope.from.force") / told(even, "segments", "rope.from.force"), 1.3, 0.35);
}

/// Each run fills half of what those before it left of the progress, so the last value before the end counts them.
int runs_made(const std::string& text) {
  double last = 0;
  simulate(parse(text), [&](double share) { last = share < 1 ? share : last; });
  return static_cast<int>(std::lround(-std::log2(1 - last)));
}

TEST(Cuts, ScenesWithoutLinesOrMembersPayNothing) {
  const std::string ask = "run = { duration = \"4 s\", every = \"0.1 s\" }\n[solve]\nstep = \"0.025 s\"\n";
  const std::string bob = "[[body]]\nname = \"bob\"\nmass = \"10 kg\"\nfree = [\"heave\"]\nweight = true\n";
  const std::string links =
      "[[line]]\nname = \"rope\"\nfrom = \"(0, 0, 0) m\"\nnode_mass = \"1 kg\"\nlink = [{ length = \"1 m\", mass = "
      "\"1 kg\" }, { length = \"1 m\", mass = \"1 kg\" }]\n";
  EXPECT_EQ(runs_made(water + bob + "[ask]\n" + ask), 3);    // steps h, 2h and 4h
  EXPECT_EQ(runs_made(water + links + "[ask]\n" + ask), 3);  // two rods: nothing stands for anything
  EXPECT_EQ(runs_made(rope(4, "node_mass = \"1 kg\"\n", ask)), 3);
  EXPECT_EQ(runs_made(rope(4, "", ask)), 4);
}

TEST(Cuts, FinerLinesKeepTheirMassesPlacesAndMeetings) {
  const auto whole = parse(
      water +
      "[[line]]\nname = \"main\"\nfrom = \"(0, 0, 0) m\"\nto = \"(5, 0, 0) m\"\ndiameter = \"0.1 m\"\nbuoyancy = "
      "true\n[[line.part]]\nlength = \"3 m\"\nsegments = 3\nmass_per_length = \"2 kg/m\"\n[[line.part]]\nlength = \"4 "
      "m\"\nsegments = 2\nmass_per_length = \"12 kg/m\"\n[line.growth]\nthickness = \"1 cm\"\ndensity = \"1300 "
      "kg/m^3\"\nto = \"2 m\"\n[line.damping]\nlinear = \"4 kg/s\"\n"
      "[[line]]\nname = \"hook\"\non = { from = \"main.node3\" }\nlink = [{ length = \"1 m\", mass = \"3 kg\" }]\n"
      "diameter = \"0.1 m\"\nbuoyancy = true\n[line.damping]\nlinear = \"4 kg/s\"\n"
      "[ask]\nrun = { duration = \"1 s\", every = \"0.1 s\" }\n");
  const auto fine = scene::with_finer_lines(whole, 2);
  ASSERT_EQ(fine.lines[0].segments.size(), 10);
  EXPECT_EQ(fine.lines[1].segments.size(), 1);  // a link that is listed
  EXPECT_EQ(fine.lines[1].from.meets->node, 6);
  EXPECT_EQ(damping_of(fine.lines[0]), 2);
  EXPECT_EQ(damping_of(fine.lines[1]), 4);
  const auto mass = [](const scene::Line& l) {
    return std::accumulate(l.segments.begin(), l.segments.end(), 0.0,
                           [](double m, const auto& s) { return m + s.mass; });
  };
  EXPECT_NEAR(mass(fine.lines[0]), mass(whole.lines[0]), 1e-12);
  // Growth reaches 2 m along 3 m: over 2 of 3 segments, and over 4 of 6.
  EXPECT_NEAR(mass(whole.lines[0]) - (3 * 2 + 4 * 12), 1300 * std::numbers::pi * 0.01 * 0.11 * 2, 1e-9);
  // A uniform rod has m l^2 / 12.
  EXPECT_NEAR(fine.lines[0].segments[9].inertia, 12.0 * 1 * 1 / 12, 1e-12);
  EXPECT_THAT(scene::names_where_finer(whole, 2, "main.node3.curvature"), ElementsAre("main.node6.curvature"));
  EXPECT_THAT(scene::names_where_finer(whole, 2, "main.link4.tension"),
              ElementsAre("main.link7.tension", "main.link8.tension"));
  for (const char* same : {"main.largest_tension", "hook.link1.tension", "hook.node1.z", "energy.main.stored"})
    EXPECT_THAT(scene::names_where_finer(whole, 2, same), ElementsAre(same));
}

/// A pile of 20 m under the surface, on a heavy sledge that waves hardly move: of waves of 4 s, k = w^2/g.
std::string pile(const std::string& morison, const std::string& ask) {
  return water +
         "[waves]\nkind = \"regular\"\nheight = \"0.2 m\"\nperiod = \"4 s\"\nheading = \"0 deg\"\nramp = \"4 "
         "s\"\n[[body]]\nname = \"sledge\"\nmass = \"1e6 kg\"\nfree = [\"surge\"]\n"
         "[[mooring]]\non = \"sledge\"\nkind = \"linear\"\nstiffness = { surge = \"1e5 N/m\" }\n"
         "[[member]]\non = \"sledge\"\nfrom = \"(0, 0, -20) m\"\nto = \"(0, 0, 0) m\"\ndiameter = \"0.5 m\"\n" +
         fmt::format("morison = {{ {} }}\n[ask]\n{}", morison, ask) +
         "run = { duration = \"20 s\", every = \"0.1 s\", of = [\"sledge.surge\"] }\n";
}

/// By how much Gauss' two points of n pieces miss the integral of e^{kz} from -20 m to 0, relative to what they give.
double missed_by(int n) {
  const double k = std::pow(2 * std::numbers::pi / 4, 2) / 9.81, half = k * 20 / n / 2;
  return std::sinh(half) / half / std::cosh(half / std::sqrt(3)) - 1;
}

TEST(Cuts, TheErrorOfGivenPiecesOfAPileIsThatOfItsDepthIntegral) {
  // All that moves the sledge is the inertia load, which goes as e^{kz}: all of its motion is off by as much.
  for (const int n : {2, 4, 8}) {
    const auto run = simulate(parse(pile(fmt::format("cd = 0, ca = 1, pieces = {}", n), "accuracy = 1e-3\n")));
    // Of order 4: 2 (1 - 1/16) of the error; the next order is (kD)^2/60 of it.
    EXPECT_NEAR(told(run, "pieces", "sledge.surge") / missed_by(n), 1.875, n == 2 ? 0.1 : 0.02) << n;
    EXPECT_EQ(run.error.total(0) > 1e-3, !run.warnings().empty());
    if (n == 2) {
      EXPECT_THAT(run.warnings(), Contains(HasSubstr("from the pieces that the scene gives")));
    }
  }
}

/// A pole that dips into still water at 3 m/s, askew, as a heavy body takes it along: impacts, one a piece.
std::string dipping_pole(int pieces) {
  return "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ndepth = \"infinite\"\n"
         "[[body]]\nname = \"b\"\nmass = \"1e9 kg\"\ncentre_of_gravity = \"(0, 0, 0) m\"\n"
         "radii_of_gyration = \"(5, 5, 5) m\"\nposition = \"(0, 0, 0.3) m\"\n"
         "initial_velocity = { heave = \"-3 m/s\" }\nfree = [\"heave\"]\n"
         "[[member]]\nname = \"p\"\non = \"b\"\nfrom = \"(-1, 0, 0) m\"\nto = \"(1, 0, 0.5) m\"\n"
         "diameter = \"0.5 m\"\nloads = true\n" +
         fmt::format("slamming = {{ model = \"goda\", begins = \"submerged\", pieces = {} }}\n", pieces) +
         "[ask]\nrun = { duration = \"0.6 s\", every = \"0.005 s\", of = [\"p.slamming_force_*\", "
         "\"p.slamming_moment_*\"] }\n"
         "accuracy = 2e-2\n";
}

TEST(Cuts, TheStepIsRefinedIntoWhatGivenPiecesLeaveOfTheAccuracy) {
  const auto fine = simulate(parse(dipping_pole(300)));
  const std::size_t worst = fine.error.worst();
  EXPECT_GT(told(fine, "pieces")[worst], 0.5 * 2e-2);  // no small part of what is asked
  EXPECT_LE(fine.error.total(worst), 2e-2);
  EXPECT_THAT(fine.warnings(), IsEmpty());
  // A hundred leave nothing: no step mends that.
  const auto coarse = simulate(parse(dipping_pole(100)));
  EXPECT_GT(told(coarse, "pieces")[coarse.error.worst()], 2e-2);
  EXPECT_THAT(coarse.warnings(), ElementsAre(HasSubstr("most of it from the pieces that the scene gives")));
}

TEST(Cuts, AWarningNamesWhatTheSceneGivesAndNoStepThatItDoesNot) {
  froude::Run run;
  run.signals = {{"x", "m", "", {0, 1}}};
  run.error.asked = 2e-2;
  run.error.sources = {{.name = "step", .how = "", .of_signal = {0.018}, .given = false},
                       {.name = "pieces", .how = "", .of_signal = {0.014}, .given = true}};
  EXPECT_THAT(run.warnings(), ElementsAre(AllOf(HasSubstr("0.014 of it from the pieces that the scene gives"),
                                                Not(HasSubstr("step")))));
  run.error.sources[0].given = true;
  EXPECT_THAT(run.warnings(), ElementsAre(HasSubstr("most of it from the step that the scene gives")));
}

TEST(Cuts, PiecesThatTheProgramChoosesAreWithinHalfOfWhatIsAsked) {
  for (const char* load : {"cd = 0, ca = 1", "cd = 50, ca = 0"})
    for (const double asked : {1e-1, 1e-2}) {
      const auto run = simulate(parse(pile(load, fmt::format("accuracy = {}\n", asked))));
      EXPECT_LE(told(run, "quadrature", "sledge.surge"), asked / 2) << load << " " << asked;
      EXPECT_LE(run.error.total(0), asked);
      EXPECT_THAT(run.warnings(), IsEmpty());
    }
}

TEST(Cuts, TooFewPiecesOfTheProgramAreMadeMore) {
  // Of drag, which goes as e^{2kz}, the rule of (D44) leaves all that is asked, and the step wants some of it too.
  const auto run = simulate(parse(pile("cd = 50, ca = 0", "accuracy = 1e-2\n")));
  EXPECT_THAT(run.notes, Contains(HasSubstr("times as many pieces as were chosen first")));
  const auto taken = simulate(parse(pile("cd = 50, ca = 0", "accuracy = 1e-2\n") + "[solve]\naccept_error = true\n"));
  EXPECT_THAT(taken.notes, Not(Contains(HasSubstr("times as many pieces"))));
  EXPECT_GT(told(taken, "quadrature", "sledge.surge"), 0.5e-2);
}

TEST(Cuts, AWatchedNodeIsTheSameOneWhereALineIsFiner) {
  const std::string text = water +
                           "[[body]]\nname = \"m\"\nmass = \"2 kg\"\nfree = [\"surge\"]\n"
                           "[[connector]]\nname = \"spring\"\nkind = \"axial\"\nbetween = [\"m\", \"ground\"]\n"
                           "ends = [\"(0, 0, 0) m\", \"(10, 0, 0) m\"]\nstiffness = \"0.5 N/m\"\nrest_length = \"as "
                           "placed\"\n[connector.switch]\nwatch = \"rope.node3.x\"\nevery = \"10 s\"\nwindow = \"60 "
                           "s\"\nhysteresis = \"0.001 Hz\"\nsettings = [{ from = \"0 s\", stiffness = \"0.6 N/m\" }]\n"
                           "[[line]]\nname = \"rope\"\nfrom = \"(0, 0, 0) m\"\nlength = \"10 m\"\nsegments = 4\n"
                           "mass_per_length = \"2 kg/m\"\n[ask]\nrun = { duration = \"90 s\", every = \"0.1 s\" }\n";
  const auto fine = scene::with_finer_lines(parse(text), 2);
  EXPECT_EQ(std::get<scene::AxialConnector>(fine.connectors[0].kind).switching->watch.value, "rope.node6.x");
}

TEST(Cuts, WhereTheFinerLineHasNoRunAWarningSaysSo) {
  // One link, whose middle at -5 m has a Keulegan-Carpenter number of 15; those at -7.5 m of two have 11, which no row
  // of the table has.
  const std::filesystem::path folder = testing::TempDir();
  std::ofstream(folder / "cuts_by_kc.csv") << "KC, cd, ca\n13, 2, 1\n30, 2, 1\n";
  const auto run = simulate(scene::parse(
      water + "[waves]\nkind = \"regular\"\nheight = \"1 m\"\nperiod = \"6 s\"\nheading = \"0 deg\"\nramp = \"6 s\"\n"
              "[[line]]\nname = \"rope\"\nfrom = \"(0, 0, 0) m\"\nlength = \"10 m\"\nsegments = 1\n"
              "mass_per_length = \"14 kg/m\"\ndiameter = \"0.12 m\"\n[line.morison]\nfile = \"cuts_by_kc.csv\"\n[ask]\n"
              "run = { duration = \"12 s\", every = \"0.1 s\" }\n",
      folder / "scene.toml"));
  EXPECT_THAT(run.warnings(), Contains(AllOf(HasSubstr("no error is estimated of segments"), HasSubstr("segment 2"))));
  EXPECT_EQ(run.error.sources.size(), 1);
}

}  // namespace
}  // namespace cuts_test
