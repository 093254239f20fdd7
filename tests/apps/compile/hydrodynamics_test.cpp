// What a scene takes of coefficients, and what it has to say where their file does not.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>

#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"
#include "compile/compile.hpp"
#include "compile/findings.hpp"
#include "hydro/base/error.hpp"
#include "hydro/potential/formats/writers.hpp"
#include "hydro/potential/operations/operations.hpp"

namespace hydrodynamics_test {
namespace {

using namespace froude;
using hydro::InputError;
using hydro::potential::Coefficients;
using hydro::potential::Finding;
using hydro::potential::Severity;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A hemisphere of radius 5 m on a hinge; WAMIT's files tell neither its volume nor its centres.
std::string hinged(const std::string& facts) {
  return R"(schema = 1
[water]
density = "1000 kg/m^3"
gravity = "9.81 m/s^2"
depth = "infinite"
[[body]]
name = "m"
mass = "200 t"
centre_of_gravity = "(0.5, 0, -2) m"
radii_of_gyration = "(2, 2, 2) m"
[body.hydrodynamics]
file = "hemisphere_r5.1"
reference_point = "(0, 0, 0) m"
hydrostatics = true
)" + facts +
         R"([[joint]]
kind = "hinge"
between = ["ground", "m"]
at = "(8, 0, 0) m"
axis = "y"
[ask]
run = { duration = "1 s", every = "0.1 s" }
)";
}

TEST(Hydrodynamics, InSeaWaterOfDataForFreshWaterTellHowToConvertThem) {
  std::string text = hinged("displaced_volume = \"260 m^3\"\n");
  text.replace(text.find("1000 kg"), 4, "1025");
  text.replace(text.find("hemisphere_r5.1"), 15, "hemisphere_r5.nc");
  text.erase(text.find("reference_point"), std::string("reference_point = \"(0, 0, 0) m\"\n").size());
  EXPECT_THAT([&] { compile::prepare(froude_test::parse(text)); },
              ThrowsMessage<InputError>(HasSubstr("froude bem convert FILE --density-ratio 1.025 -o converted.h5")));
}

TEST(Hydrodynamics, OfABodyOnJointsNeedItsVolume) {
  EXPECT_THAT([] { compile::prepare(froude_test::parse(hinged(""))); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("test.toml:12"), HasSubstr("\"m\" is on joints"),
                                              HasSubstr("displaced_volume"), HasSubstr("centre_of_buoyancy"))));
}

TEST(Hydrodynamics, ActWithTheVolumeAndCentreThatTheSceneStates) {
  const auto prepared = compile::prepare(
      froude_test::parse(hinged("displaced_volume = \"260 m^3\"\ncentre_of_buoyancy = \"(0.1, 0.2, -1.8) m\"\n")));
  ASSERT_EQ(prepared.hydrostatics.size(), 1u);
  const double buoyancy = 1000 * 9.81 * 260;
  EXPECT_NEAR(prepared.hydrostatics[0].lift, buoyancy - 200e3 * 9.81, 1e-6 * buoyancy);
  // (r_b − r_g) × (0, 0, ρgV) = ρgV (r_y, −r_x, 0) with r_b − r_g = (−0.4, 0.2, 0.2) m
  const Eigen::Vector2d expected = buoyancy * Eigen::Vector2d(0.2, 0.4);
  EXPECT_LT((prepared.hydrostatics[0].moment - expected).norm(), 1e-6 * buoyancy);
}

// Masses are given to four digits: 6 N in 2.6 MN were refused on a joint, and taken without one.
TEST(Hydrodynamics, OfABodyOnASliderBalanceToTheDigitsOfItsMass) {
  const auto held = [](const std::string& volume) {
    std::string text = hinged("displaced_volume = \"" + volume + " m^3\"\ncentre_of_buoyancy = \"(0.5, 0, -1.8) m\"\n");
    text.replace(text.find("hinge"), 5, "slider");
    text.replace(text.find("axis = \"y\""), 10, "axis = \"z\"");
    const auto scene = froude_test::parse(text);
    return compile::frequency_model(compile::prepare(scene)).modes();
  };
  EXPECT_EQ(held("200.01"), 6) << "5e-5 of the weight";
  EXPECT_THAT(
      [&] { held("200.04"); },
      ThrowsMessage<InputError>(AllOf(HasSubstr("m.heave feels"), HasSubstr("more than 0.0001 of the weight, 196.2 N"),
                                      HasSubstr("displaces 200040 kg as placed and weighs 200000 kg"))));
}

TEST(Hydrodynamics, RefuseAVolumeThatContradictsTheFile) {
  std::string text = hinged("displaced_volume = \"260 m^3\"\n");
  text.replace(text.find("hemisphere_r5.1"), 15, "hemisphere_r5.nc");
  text.erase(text.find("reference_point"), std::string("reference_point = \"(0, 0, 0) m\"\n").size());
  text.replace(text.find("260"), 3, "300");
  EXPECT_THAT([&] { compile::prepare(froude_test::parse(text)); },
              ThrowsMessage<InputError>(HasSubstr("leave out displaced_volume")));
}

// A gravity centre that is not above that of buoyancy makes a moment, which a matrix about a balance leaves out.
TEST(Hydrodynamics, TellOfABodyThatIsOutOfBalance) {
  const auto notes_of = [](const std::string& centre) {
    return compile::prepare(froude_test::parse(R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "60 m"
[[body]]
name = "buoy"
mass = "603.2 t"
centre_of_gravity = ")" + centre + R"("
radii_of_gyration = "(4, 4, 3) m"
[body.hydrodynamics]
hydrostatics = true
[body.hydrodynamics.cylinders]
at = "(0, 0, 0) m"
diameter = "8 m"
draught = "12 m"
frequencies = "0.5 rad/s .. 0.9 rad/s, 5 values"
[ask]
modes = { longest = "100 s" }
)"))
        .notes;
  };
  EXPECT_THAT(notes_of("(0.5, 0, -8) m"), testing::Contains(HasSubstr("0.5 m beside the vertical")));
  EXPECT_THAT(notes_of("(0, 0, -8) m"), testing::Not(testing::Contains(HasSubstr("beside the vertical"))));
}

/// A module of the pontoons' coefficients at x, with what its hydrodynamics say.
std::string module(const std::string& name, int x, const std::string& hydrodynamics) {
  return fmt::format(
      "[[body]]\nname = \"{}\"\nposition = \"({}, 0, 0) m\"\nmass = \"9088 kg\"\ncentre_of_gravity = \"(0, 0, 1.31) "
      "m\"\nradii_of_gyration = \"(4.6, 4.6, 6.4) m\"\n[body.hydrodynamics]\n{}\n",
      name, x, hydrodynamics);
}
std::string from(const std::string& file, const std::string& more = "") {
  return fmt::format("file = \"{}\"\nexcitation = true\nradiation = {{}}\n{}", file, more);
}
compile::Prepared prepared_of(const std::string& bodies) {
  return compile::prepare(
      froude_test::parse(froude_test::water + bodies + "[ask]\nmodes = { shortest = \"1 s\", longest = \"20 s\" }\n"));
}
using Sets = std::vector<std::vector<int>>;

TEST(Interaction, IsRefusedWhereNoWavesCanPass) {
  // One body's file for three bodies: nothing in it says what one does to another.
  const auto three = [](const std::string& more) {
    return module("a", 0, from("pontoon1.nc", more)) + module("b", 13, from("pontoon1.nc", more)) +
           module("c", 26, from("pontoon1.nc", more));
  };
  EXPECT_THAT([&] { prepared_of(three("")); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("test.toml:23:"), HasSubstr("no waves pass between a and b"),
                                              HasSubstr("\"pontoon1.nc\" holds no coupling of the two"),
                                              HasSubstr("froude bem solve"), HasSubstr("interaction = \"self\""))));
  EXPECT_THAT([&] { prepared_of(three("interaction = \"full\"")); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("test.toml:26:"), HasSubstr("interaction = \"full\""))));
  const auto said = prepared_of(three("interaction = \"self\""));
  EXPECT_EQ(said.sharing_waves, (Sets{{0}, {1}, {2}}));
  EXPECT_THAT(said.notes, testing::Contains("no waves pass between a, b and c, as the scene says"));
}

TEST(Interaction, IsRefusedBetweenFilesThatDoNotKnowEachOther) {
  const auto scene = [](const std::string& of_pair, const std::string& of_other) {
    return module("a", 0, from("pontoon5.nc", "body = 1\n" + of_pair)) +
           module("b", 13, from("pontoon5.nc", "body = 2\n" + of_pair)) +
           module("c", 39, from("pontoon1.nc", of_other));
  };
  EXPECT_THAT([&] { prepared_of(scene("", "")); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("no waves pass between a and c"), HasSubstr("pontoon5.nc"),
                                              HasSubstr("pontoon1.nc"), HasSubstr("computed one without the other"))));
  // Either side may say it: those of one file go on feeling each other.
  for (const auto& [of_pair, of_other] : {std::pair{"", "interaction = \"self\""}, {"interaction = \"file\"", ""}}) {
    const auto said = prepared_of(scene(of_pair, of_other));
    EXPECT_EQ(said.sharing_waves, (Sets{{0, 1}, {2}})) << of_pair << of_other;
    EXPECT_THAT(said.notes,
                testing::Contains("no waves pass between a and c, as the scene says; they do among a and b"));
    EXPECT_EQ(said.groups.size(), 2u);
  }
}

TEST(Interaction, IsThereWhereAFileHoldsItAndNeedsNoWord) {
  const auto prepared =
      prepared_of(module("a", 0, from("pontoon5.nc", "body = 1")) + module("b", 13, from("pontoon5.nc", "body = 2")));
  EXPECT_EQ(prepared.sharing_waves, (Sets{{0, 1}}));
  for (const auto& note : prepared.notes) EXPECT_THAT(note, testing::Not(HasSubstr("no waves pass")));
  // A file of several bodies without blocks between them, as `froude bem convert --array` makes, holds none.
  std::string name = (std::filesystem::temp_directory_path() / "froude-test-XXXXXX").string();
  const std::filesystem::path folder = ::mkdtemp(name.data());
  const auto five = hydro::potential::read(froude_test::examples / "data/pontoon5.nc", {});
  const std::string file = (folder / "array.h5").string();
  hydro::potential::write_froude(hydro::potential::without_interaction(five), file);
  EXPECT_THAT([&] { prepared_of(module("a", 0, from(file, "body = 1")) + module("b", 13, from(file, "body = 2"))); },
              ThrowsMessage<InputError>(HasSubstr("\"array.h5\" holds no coupling of the two")));
  std::filesystem::remove_all(folder);
}

TEST(Interaction, OfBodiesThatNameOtherEffectsOfOneFileIsNone) {
  const auto scene = [](const std::string& more) {
    return module("a", 0, from("pontoon5.nc", "body = 1")) +
           module("b", 13, "file = \"pontoon5.nc\"\nbody = 2\nradiation = {}\n" + more);
  };
  EXPECT_THAT([&] { prepared_of(scene("")); },
              ThrowsMessage<InputError>(HasSubstr("they take \"pontoon5.nc\" by different keys")));
  EXPECT_EQ(prepared_of(scene("interaction = \"self\"")).sharing_waves, (Sets{{0}, {1}}));
  // A body that makes no waves has none to share.
  EXPECT_EQ(
      prepared_of(module("a", 0, from("pontoon1.nc")) + module("b", 13, "file = \"pontoon1.nc\"\nhydrostatics = true"))
          .sharing_waves,
      (Sets{{0}}));
}

Severity gravest(const std::vector<Finding>& findings, const std::string& check) {
  Severity worst = Severity::note;
  for (const Finding& f : findings)
    if (f.check == check) worst = std::max(worst, f.severity);
  return worst;
}

TEST(Findings, AreOfTheBodiesAndModesThatAreTaken) {
  Coefficients c = hydro::potential::read(froude_test::examples / "data/box2.nc");
  c.B[5](7, 7) = -c.B[5].diagonal().maxCoeff();  // sway of the second body
  const std::array<bool, 6> all{true, true, true, true, true, true}, heave{false, false, true, false, false, false};
  ASSERT_EQ(gravest(hydro::potential::check(c), "sign of B"), Severity::error);
  EXPECT_EQ(gravest(compile::findings_in(c, {{0, 1}, {all, all}, true}), "sign of B"), Severity::error);
  EXPECT_EQ(gravest(compile::findings_in(c, {{0}, {all}, true}), "sign of B"), Severity::note);
  EXPECT_EQ(gravest(compile::findings_in(c, {{0, 1}, {heave, heave}, true}), "sign of B"), Severity::note);
  EXPECT_EQ(gravest(compile::findings_in(c, {{0, 1}, {all, all}, false}), "sign of B"), Severity::note);
  // What is taken is judged as before, also where something worse is not taken.
  c.B[5](2, 2) = -c.B[5](2, 2);
  EXPECT_EQ(gravest(compile::findings_in(c, {{0}, {all}, true}), "sign of B"), Severity::error);
  EXPECT_EQ(gravest(compile::findings_in(c, {{0, 1}, {heave, heave}, true}), "sign of B"), Severity::error);
}

}  // namespace
}  // namespace hydrodynamics_test
