#include "compile/compile.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "answers/simulate.hpp"
#include "apps/compile/scenes.hpp"
#include "compile/signal_list.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"

namespace compile_test {
namespace {

using namespace froude;
using froude_test::parse;
using froude_test::water;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string waves = R"([waves]
kind = "jonswap"
hs = "1 m"
tp = "6 s"
heading = "0 deg"
)";
const std::string run_ask = R"([ask]
run = { duration = "10 s", every = "0.1 s" }
)";

std::string module_text(const std::string& name, const std::string& position, const std::string& hydrodynamics,
                        const std::string& cog = "(0, 0, 1.31) m") {
  return fmt::format(R"([[body]]
name = "{}"
position = "{}"
mass = "9088 kg"
centre_of_gravity = "{}"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
[body.hydrodynamics]
{}
)",
                     name, position, cog, hydrodynamics);
}

TEST(Compile, CorrectsTheRestoringMatrixForTheCentreOfGravity) {
  const auto C44 = [&](const std::string& cog) {
    const auto s =
        parse(water + module_text("m", "(0, 0, 0) m", "file = \"pontoon1.nc\"\nhydrostatics = true", cog) + run_ask);
    return compile::prepare(s).hydrostatics.at(0).stiffness(1, 1);  // of heave, roll and pitch
  };
  // (P12) about the reference point: −m g z; then moved to a centre of gravity straight above it, which leaves
  // rotations as they are.
  EXPECT_NEAR(C44("(0, 0, 1.31) m") - C44("(0, 0, 2.31) m"), 9088 * 9.81,
              1e-3 * 9088 * 9.81);  // the mesh displaces 9088 kg to 1e-6
}

// A module carried 100 m down the waves answers as the one at the origin, later.
TEST(Compile, CarriesASingleBodyToItsPlaceWithThePhaseOfTheWave) {
  const auto xi = [&](const std::string& position) {
    const auto s = parse(
        water +
        module_text(
            "m", position,
            "file = \"pontoon1.nc\"\nhydrostatics = true\nexcitation = true\nradiation = { accept_error = 0.02 }") +
        "[[mooring]]\non = \"m\"\nkind = \"linear\"\nstiffness = { surge = \"4 kN/m\", sway = \"4 kN/m\", yaw = \"9 kN "
        "m/rad\" }\n"
        "[ask]\nrao = { periods = \"4 s .. 4 s, 1 value\", heading = \"0 deg\" }\n");
    const auto p = compile::prepare(s);
    return Eigen::VectorXcd(
        dynamics::frequency::response_amplitudes(compile::frequency_model(p), p.groups, s.rao->omega, 0).col(0));
  };
  const double omega = 2 * std::numbers::pi / 4,
               k = hydro::waves::wavenumber(
                   omega, {.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(14)});
  const Eigen::VectorXcd here = xi("(0, 0, 0) m"), there = xi("(100, 40, 0) m");
  EXPECT_LT((there - here * std::polar(1.0, -100 * k)).norm(), 1e-9 * here.norm());
}

TEST(Compile, SaysWhichBodyOfTheFileIsMissing) {
  const auto text =
      water + waves + module_text("m", "(0, 0, 0) m", "file = \"pontoon5.nc\"\nbody = 7\nexcitation = true") + run_ask;
  EXPECT_THAT([&] { compile::prepare(parse(text)); },
              ThrowsMessage<hydro::InputError>(
                  AllOf(HasSubstr("body 7"), HasSubstr("holds 5 bodies"), HasSubstr("test.toml:"))));
}

TEST(Compile, RefusesFactsOfWamitBesideAnotherFormatAlsoWhereTheyAreTheUsualOnes) {
  for (const auto* fact : {"ulen = \"1 m\"", "iperout = 1"})
    EXPECT_THAT(
        [&] {
          compile::prepare(parse(
              water + waves +
              module_text("m", "(0, 0, 0) m", fmt::format("file = \"pontoon1.nc\"\nexcitation = true\n{}", fact)) +
              run_ask));
        },
        ThrowsMessage<hydro::InputError>(HasSubstr("is given, but this is no set of WAMIT files")));
}

TEST(Compile, WantsToKnowWhichBodyOfSeveral) {
  const auto text =
      water + waves + module_text("m", "(0, 0, 0) m", "file = \"pontoon5.nc\"\nexcitation = true") + run_ask;
  EXPECT_THAT([&] { compile::prepare(parse(text)); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("holds 5 bodies"), HasSubstr("body = 1"))));
}

TEST(Compile, RefusesDataOfAnotherDepth) {
  std::string text =
      water + waves + module_text("m", "(0, 0, 0) m", "file = \"pontoon1.nc\"\nexcitation = true") + run_ask;
  text.replace(text.find("14 m"), 4, "20 m");
  const auto scene = parse(text);
  EXPECT_THAT([&] { compile::time_model(scene, compile::prepare(scene)); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("for 14 m of water in 20 m of water"),
                                                     HasSubstr("compute the coefficients for 20 m"))));
}

TEST(Compile, RefusesBodiesThatStandElsewhereThanInTheData) {
  std::string text = water + waves;
  for (int i = 1; i <= 5; ++i)
    text += module_text(fmt::format("m{}", i), fmt::format("({}, 0, 0) m", i == 4 ? 12.0 : -26 + 13.0 * (i - 1)),
                        "file = \"pontoon5.nc\"\nexcitation = true");
  EXPECT_THAT(
      [&] { compile::prepare(parse(text + run_ask)); },
      ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("\"m4\" is at x = 12"), HasSubstr("must stand as they stood"))));
}

/// The same sea, spread about a heading.
std::string spread_text(const std::string& heading, const std::string& spreading) {
  std::string text = water + waves + "spreading = " + spreading + "\n" +
                     module_text("m", "(0, 0, 0) m", "file = \"pontoon1.nc\"\nexcitation = true") + run_ask;
  return text.replace(text.find("0 deg"), 5, heading);
}

TEST(Compile, GivesEachWaveOfASpreadSeaTheExcitationOfItsOwnHeading) {
  const auto scene = parse(spread_text("45 deg", "{ kind = \"wrapped-normal\", deviation = \"8 deg\" }"));
  const auto prepared = compile::prepare(scene);
  const auto model = compile::time_model(scene, prepared);
  // Sway of the load at one instant, component by component with the coefficients of its own heading. The module is
  // symmetric, so at 45 degrees surge and sway are alike and a wrong heading would show in their difference.
  double surge = 0, sway = 0;
  const double t = 3.0;
  for (const auto& w : model.water.sea->components()) {
    const Eigen::VectorXcd X = prepared.groups[0].table.excitation(w.omega, w.heading);
    const std::complex<double> turn = std::polar(w.amplitude, w.phase + w.omega * t);
    surge += (turn * X[0]).real();
    sway += (turn * X[1]).real();
  }
  EXPECT_GT(std::abs(surge - sway), 1.0);  // N: the headings do differ
  dynamics::State state = model.start;
  state.time = t;
  dynamics::Workspace workspace(model.model, state);
  const Eigen::VectorXd load = -model.model.residual(state, Eigen::VectorXd::Zero(6), workspace);  // at rest: the loads
  EXPECT_NEAR(load[0], surge, 1e-6 * std::abs(surge) + 1e-6);
  EXPECT_NEAR(load[1], sway, 1e-6 * std::abs(sway) + 1e-6);
}

TEST(Compile, RefusesWavesFromWhereTheDataHaveNone) {
  const auto scene = parse(spread_text("0 deg", "{ kind = \"cosn\", n = 2 }"));  // data from 0 to 90 degrees
  EXPECT_THAT([&] { compile::time_model(scene, compile::prepare(scene)); },
              ThrowsMessage<hydro::InputError>(HasSubstr("heading")));
}

TEST(Compile, RefusesASeaOutsideTheData) {
  std::string text =
      water + waves + module_text("m", "(0, 0, 0) m", "file = \"pontoon1.nc\"\nexcitation = true") + run_ask;
  text.replace(text.find("6 s"), 3, "2 s");      // peak at 3.14 rad/s, data up to 4
  text.replace(text.find("1 m\""), 3, "0.3 m");  // at 1 m such a sea would break
  EXPECT_THAT([&] { compile::time_model(parse(text), compile::prepare(parse(text))); },
              ThrowsMessage<hydro::InputError>(
                  AllOf(HasSubstr("outside the frequencies of the data"), HasSubstr("wider band"))));
}

TEST(Compile, RefusesToLineariseAboutAPlaceThatIsNoRest) {
  const std::string text =
      water + module_text("a", "(0, 0, 0) m", "file = \"pontoon1.nc\"\nexcitation = true\nhydrostatics = true") +
      "[[connector]]\nbetween = [\"a\", \"ground\"]\nends = [\"(6, 0, 0) m\", \"(20, 0, 0) m\"]\nkind = "
      "\"axial\"\nstiffness = \"5 kN/m\"\nrest_length = \"10 m\"\n"
      "[ask]\nrao = { periods = \"4 s .. 5 s, 2 values\", heading = \"0 deg\" }\n";
  EXPECT_THAT([&] { compile::frequency_model(compile::prepare(parse(text))); },
              ThrowsMessage<hydro::InputError>(
                  AllOf(HasSubstr("not in equilibrium"), HasSubstr("a.pitch"), HasSubstr("as placed"))));
}

TEST(Compile, RefusesAStepThatDoesNotDivideTheSamples) {
  const std::string text =
      water + waves +
      module_text("m", "(0, 0, 0) m", "file = \"pontoon1.nc\"\nhydrostatics = true\nexcitation = true") + run_ask +
      "[solve]\nstep = \"0.03 s\"\n";
  EXPECT_THAT([&] { compile::time_model(parse(text), compile::prepare(parse(text))); },
              ThrowsMessage<hydro::InputError>(AllOf(HasSubstr("does not divide"), HasSubstr("0.025 s"))));
}

// Promise: what a scene does not name is not there. Each effect named adds exactly its own kind, evaluated; nothing
// else exists.
TEST(Compile, MakesOnlyTheEffectsThatAreNamed) {
  const auto effects = [&](const std::string& hydrodynamics, const std::string& more) {
    std::vector<std::string> names;
    for (const auto& [effect, count] :
         simulate(parse(water + waves + module_text("m", "(0, 0, 0) m", "file = \"pontoon1.nc\"\n" + hydrodynamics) +
                        more + run_ask))
             .evaluations) {
      EXPECT_GT(count, 100u) << effect;
      names.push_back(effect);
    }
    return names;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(effects("hydrostatics = true", ""), (Names{"hydrostatics"}));
  EXPECT_EQ(effects("hydrostatics = true\nexcitation = true", ""), (Names{"hydrostatics", "excitation"}));
  EXPECT_EQ(effects("radiation = { accept_error = 0.02 }\nhydrostatics = true", ""),
            (Names{"hydrostatics", "radiation"}));
  EXPECT_EQ(effects("hydrostatics = true",
                    "[[member]]\non = \"m\"\nfrom = \"(0, 0, -1) m\"\nto = \"(0, 0, 0) m\"\ndiameter = \"1 m\"\ndrag = "
                    "{ cd = 1.0 }\n"),
            (Names{"hydrostatics", "drag"}));
  EXPECT_EQ(effects("hydrostatics = true",
                    "[[mooring]]\non = \"m\"\nkind = \"linear\"\nstiffness = { surge = \"1 kN/m\" }\n"),
            (Names{"hydrostatics", "mooring"}));
}

// The sea of a run is the same at any output distance, and the elevation the run reports is that sea.
TEST(Compile, GivesTheSameRunForTheSameSeed) {
  const std::string text =
      water + waves +
      module_text(
          "m", "(0, 0, 0) m",
          "file = \"pontoon1.nc\"\nhydrostatics = true\nexcitation = true\nradiation = { accept_error = 0.02 }") +
      run_ask;
  EXPECT_EQ(simulate(parse(text)).signal("m.heave"), simulate(parse(text)).signal("m.heave"));
}

}  // namespace
}  // namespace compile_test
