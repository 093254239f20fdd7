#include "compile/cylinders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "compile/compile.hpp"
#include "hydro/base/error.hpp"
#include "hydro/cylinders/solve.hpp"
#include "scenes.hpp"
#include "support/kept_folder.hpp"
#include "support/source_dir.hpp"

namespace cylinders_test {
namespace {

using namespace froude;
using froude_test::parse;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Two cylinders of 1 m radius and draught, 8 m apart; the origins of the bodies are half a metre above still water.
std::string scene_text(const std::string& cylinders, const std::string& further = {}) {
  return fmt::format(R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "5 m"
[[body]]
name = "c"
copies = {{ count = 2, step = "(8, 0, 0) m" }}
position = "(1, 2, 0.5) m"
mass = "3141.6 kg"
free = ["surge", "heave", "pitch"]
centre_of_gravity = "(0, 0, -1) m"
radii_of_gyration = "(1, 1, 1) m"
[body.hydrodynamics]
excitation = true
radiation = {{}}
hydrostatics = true
{}
[body.hydrodynamics.cylinders]
{}
[ask]
rao = {{ periods = "3 s .. 5 s, 3 values", heading = "0 deg" }}
)",
                     further, cylinders);
}

const std::string cylinders = R"(at = "(0, 0, -0.5) m"
diameter = "2 m"
draught = "1 m"
frequencies = "1 rad/s .. 3 rad/s, 9 values"
)";

TEST(CylindersInAScene, MayLieUnderWaterOrStandOnTheSeaBed) {
  const scene::Scene discs = scene::read(froude_test::source_dir() / "examples/discs.toml");
  const auto prepared = compile::prepare(discs);
  ASSERT_EQ(prepared.groups.size(), 1u);
  const auto& c = prepared.groups[0].table.coefficients();
  EXPECT_NEAR(*c.body[1].displaced_volume, std::numbers::pi * 16 * 0.8, 1e-9);
  EXPECT_NO_THROW(compile::frequency_model(prepared));
  // Four cylinders in the same place that reach the bed: no weight, no restoring matrix, and no waves by heave.
  std::string text = scene_text(cylinders);
  text.replace(text.find("\"1 m\"\nfreq"), 5, "\"to the sea bed\"");
  EXPECT_THAT([&] { compile::prepare(parse(text)); },
              ThrowsMessage<hydro::InputError>(HasSubstr("no restoring matrix")));
  text.erase(text.find("hydrostatics = true\n"), 20);
  const auto piles = compile::solve_cylinders(parse(text), {0, 1}).coefficients;
  EXPECT_EQ(piles.A[0](2, 2), 0);
  EXPECT_GT(piles.A[0](0, 0), 0);
}

TEST(CylindersInAScene, AreSolvedTogetherWhereTheyStandAboutTheirCentresOfGravity) {
  const scene::Scene scene = parse(scene_text(cylinders));
  const auto prepared = compile::prepare(scene);
  ASSERT_EQ(prepared.groups.size(), 1u);
  const auto& ours = prepared.groups[0].table.coefficients();
  std::vector<hydro::cylinders::CylinderBody> bodies;
  for (const double x : {1.0, 9.0})
    bodies.push_back({"c", {x, 2, -0.5}, Eigen::Vector3d(x, 2, -0.5), {{{x, 2}, 1, 1.0}}});
  const auto expected = hydro::cylinders::solve(bodies, scene.water, ours.omega, {0}, {.tolerance = 1e-5}).coefficients;
  for (std::size_t w = 0; w < ours.omega.size(); ++w) {
    // The scene asks for 1e-2 and takes a tenth of that.
    EXPECT_LT((ours.A[w] - expected.A[w]).cwiseAbs().maxCoeff(), 1e-3 * expected.A[w].maxCoeff());
    EXPECT_LT((ours.B[w] - expected.B[w]).cwiseAbs().maxCoeff(), 1e-3 * expected.A[w].maxCoeff());
  }
  EXPECT_LT((ours.X[0] - expected.X[0]).cwiseAbs().maxCoeff(), 1e-3 * expected.X[0].cwiseAbs().maxCoeff());
  // Its weight is that of the water it displaces, so the restoring matrix is that of the layout.
  EXPECT_LT((*ours.C - *expected.C).cwiseAbs().maxCoeff(), 1e-4 * expected.C->maxCoeff());
}

// A short-crested sea goes anywhere: its headings are solved beside those asked for, and between them lines are near.
TEST(CylindersInAScene, AreSolvedForAllHeadingsOfASpreadSea) {
  const scene::Scene scene = parse(scene_text(cylinders) + R"([waves]
kind = "jonswap"
hs = "0.1 m"
tp = "4 s"
heading = "180 deg"
spreading = { kind = "cos2s", s = 4 }
)");
  const auto prepared = compile::prepare(scene);
  const double degree = std::numbers::pi / 180, heading = 238.169 * degree;  // one that a run drew
  const Eigen::VectorXcd ours = prepared.groups.at(0).table.excitation(2, heading);
  hydro::cylinders::Options options{.tolerance = 1e-5};
  std::vector<hydro::cylinders::CylinderBody> bodies;
  for (const double x : {1.0, 9.0})
    bodies.push_back({"c", {x, 2, -0.5}, Eigen::Vector3d(x, 2, -0.5), {{{x, 2}, 1, 1.0}}});
  const auto exact = hydro::cylinders::solve(bodies, scene.water, {2}, {heading}, options).coefficients;
  // A chord over 5 degrees of e^{ikL cos β} is off by (kL)²(5°)²/8, at k = 0.45 and L = 8, where the other's waves
  // come from, 1.2 %.
  EXPECT_LT((ours - exact.X[0].col(0)).cwiseAbs().maxCoeff(), 0.012 * exact.X[0].cwiseAbs().maxCoeff());
}

// A wide one between four slender ones: each type has its own draught.
TEST(CylindersInAScene, MayBeOfSeveralSizesInOneBody) {
  std::string text = scene_text(R"(at = "(±3, ±3, -0.5) m"
diameter = "0.8 m"
draught = "1.5 m"
others = [{ at = "(0, 0, -0.5) m", diameter = "3 m", draught = "2 m", top = "0.5 m" }]
frequencies = "1 rad/s .. 3 rad/s, 3 values"
)");
  text.replace(text.find("(8, 0, 0)"), 9, "(20, 0, 0)");
  const auto solved = compile::solve_cylinders(parse(text), {0, 1});
  const double expected = std::numbers::pi * (4 * 0.4 * 0.4 * 1.5 + 1.5 * 1.5 * 1.5);
  EXPECT_NEAR(*solved.coefficients.body[0].displaced_volume, expected, 1e-12 * expected);
  EXPECT_LT(solved.check.haskind, 1e-3);
  text.replace(text.find("\"0.5 m\" }]"), 10, "\"2.5 m\" }]");
  EXPECT_THAT([&] { parse(text); },
              ThrowsMessage<hydro::InputError>(HasSubstr("[[body.hydrodynamics.cylinders.others]]")));
}

TEST(CylindersInAScene, HaveTheirCostToldBeforeTheyAreSolved) {
  const scene::Scene scene = parse(scene_text(cylinders));
  const auto plan = compile::plan_cylinders(scene, compile::bodies_of_cylinders(scene));
  EXPECT_EQ(plan.cylinders, 2u);
  EXPECT_EQ(plan.bodies, 2u);
  EXPECT_EQ(plan.frequencies, 9u);
  EXPECT_GT(plan.cost.unknowns, 2);
  EXPECT_THAT(plan.method(), HasSubstr("by elimination"));
  EXPECT_THAT(plan.size(), AllOf(HasSubstr("2 cylinders in 2 bodies"), HasSubstr("MB, about")));
}

TEST(CylindersInAScene, AreSolvedWhereTheProgramChooses) {
  const scene::Scene scene = parse(scene_text(cylinders + "frequency_tolerance = 1e-2\n"));
  const auto bodies = compile::bodies_of_cylinders(scene);
  const auto plan = compile::plan_cylinders(scene, bodies);
  EXPECT_THAT(plan.size(), HasSubstr("9 frequencies and more where they are needed, about "));
  const auto s = compile::solve_cylinders(scene, bodies);
  EXPECT_LE(s.check.unseen, 1e-2);
  EXPECT_GT(s.check.solved_omega.size(), 9u);
  // "Within a factor of two", as plans are meant to be.
  EXPECT_LE(static_cast<double>(s.check.solved_omega.size()), 2.0 * plan.cost.frequencies);
  EXPECT_GE(2.0 * static_cast<double>(s.check.solved_omega.size()), plan.cost.frequencies);
  EXPECT_THAT(s.coefficients.notes.back(), HasSubstr("by rational interpolation"));
  std::string few = cylinders;
  few.replace(few.find("9 values"), 8, "4 values");
  EXPECT_THAT([&] { compile::plan_cylinders(parse(scene_text(few + "frequency_tolerance = 1e-2\n")), bodies); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("test.toml:"), HasSubstr("5 at least"))));
}

TEST(CylindersInAScene, AreSolvedOnceForAllLaterStartsOfTheProgram) {
  const support::KeptFolder kept(std::filesystem::path(testing::TempDir()) / "kept_cylinders");
  const scene::Scene scene = parse(scene_text(cylinders));
  const auto bodies = compile::bodies_of_cylinders(scene);
  const auto first = compile::coefficients_of_cylinders(scene, bodies);
  const auto again = compile::coefficients_of_cylinders(scene, bodies);
  EXPECT_EQ(again.A, first.A);
  EXPECT_EQ(again.X, first.X);
  EXPECT_THAT(again.notes.back(), HasSubstr("solved before"));
  const auto plan = compile::plan_cylinders(scene, bodies);
  EXPECT_EQ(plan.seconds(), 0);
  EXPECT_THAT(plan.method(), HasSubstr("solved before and kept in"));
  EXPECT_THAT(plan.size(), HasSubstr("none of which is to be done again"));
  // Another tolerance asks for other bits.
  scene::Scene finer = scene;
  finer.accuracy.value /= 10;
  EXPECT_GT(compile::plan_cylinders(finer, bodies).seconds(), 0);
  scene::Scene chosen = scene;
  for (auto& body : chosen.bodies) body.hydrodynamics->cylinders->frequency_tolerance = 0.01;
  EXPECT_GT(compile::plan_cylinders(chosen, bodies).seconds(), 0);
}

TEST(CylindersInAScene, TellWhichAreSolvedTogetherOnlyIfTheyAskForTheSame) {
  std::string other = cylinders;
  other.replace(other.find("9 values"), 8, "5 values");
  std::string text = scene_text(cylinders);
  const auto begin = text.find("[[body]]"), end = text.find("[ask]");
  std::string second = scene_text(other).substr(begin, end - begin);
  second.replace(second.find("\"c\""), 3, "\"d\"");
  second.replace(second.find("(1, 2, 0.5)"), 11, "(1, 20, 0.5)");
  text.insert(end, second);
  EXPECT_THAT(
      [&] {
        const scene::Scene scene = parse(text);
        compile::plan_cylinders(scene, compile::bodies_of_cylinders(scene));
      },
      ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("test.toml:"), HasSubstr("different frequencies"))));
}

TEST(CylindersInAScene, AreGivenInsteadOfAFile) {
  EXPECT_THAT([] { parse(scene_text(cylinders, "file = \"pontoon1.nc\"")); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("file"), HasSubstr("cylinders"))));
}

TEST(CylindersInAScene, StandAtTheHeightOfStillWater) {
  std::string lifted = cylinders;
  lifted.replace(lifted.find("-0.5"), 4, "0");
  EXPECT_THAT([&] { parse(scene_text(lifted)); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("test.toml:"), HasSubstr("still water is at -0.5 m"))));
}

TEST(CylindersInAScene, AreRefusedAtTheirPlaceIfTheyReachTheBottom) {
  std::string deep = cylinders;
  deep.replace(deep.find("\"1 m\""), 5, "\"6 m\"");
  EXPECT_THAT([&] { compile::prepare(parse(scene_text(deep))); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("test.toml:"), HasSubstr("reaches the bottom"))));
}

}  // namespace
}  // namespace cylinders_test
