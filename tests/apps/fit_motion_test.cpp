// `froude fit` of numbers of a scene, by running it; by the function of main.cpp.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include "answers/simulate.hpp"
#include "fit_fixture.hpp"
#include "froude/commands.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/override.hpp"
#include "scene/scene.hpp"
#include "support/coloured_noise.hpp"

namespace fit_test {
namespace {

using hydro::InputError;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST_F(Fit, OfASceneFindsTheDampingThatAnIndependentRecordHas) {
  const auto j = nlohmann::json::parse(
      told({.scene = examples / "pendulums.toml", .output = folder / "p.toml", .picture = folder / "p.svg"}, true));
  const auto& parameter = j["parameter"];
  EXPECT_TRUE(holds(parameter["line_damping_linear"], 0.006)) << j.dump(1);  // as make_pendulums.py says
  EXPECT_TRUE(holds(parameter["line_damping_quadratic"], 0.004)) << j.dump(1);
  for (const auto& [name, one] : parameter.items()) EXPECT_FALSE(one.contains("profile_interval")) << name;
  for (const auto& s : j["signal"]) EXPECT_NEAR(s["rms"].get<double>(), 0.01, 0.0015);  // the noise, and nothing else
  EXPECT_NEAR(j["samples_in_band"].get<double>(), 0.95, 0.03);                          // 600 samples: three deviations
  for (const auto& s : j["signal"])
    EXPECT_LT(s["widest_band_of_fit"].get<double>(), s["widest_band_of_sample"].get<double>());
  EXPECT_THAT(hydro::io::read_text(folder / "p.svg"), HasSubstr("95 % band of the fit"));
  EXPECT_THAT(hydro::io::read_text(folder / "p.toml"), HasSubstr("line_damping_linear = \"0.00"));
}

// Three records at two rates, one of them uneven, one with a start that is fitted to it alone; as make_swings.py says.
TEST_F(Fit, OfSeveralRecordsHasTheTruthInItsIntervalsAndFitsTheOneHeldBack) {
  const auto fitted = folder / "swings_fit.toml";
  const auto j = nlohmann::json::parse(
      told({.scene = examples / "swings.toml", .output = fitted, .picture = folder / "swings.svg"}, true));
  EXPECT_TRUE(holds(j["parameter"]["line_damping_linear"], 0.006)) << j.dump(1);
  EXPECT_TRUE(holds(j["parameter"]["line_damping_quadratic"], 0.004)) << j.dump(1);
  EXPECT_TRUE(holds(j["parameter"]["line_release_at_x_of_second"], 0.2)) << j.dump(1);
  EXPECT_TRUE(holds(j["parameter"]["line_release_at_z_of_second"], -0.8)) << j.dump(1);
  ASSERT_EQ(j["record"].size(), 3u);
  EXPECT_EQ(j["record"][2]["file"], "third.csv");
  // Rows before the release are not fitted; what is left is the noise, 0.01 rad, whose rms of 190 samples is good to 5
  // %.
  EXPECT_EQ(j["record"][2]["signal"][0]["samples"], 190);
  for (const auto& record : j["record"])
    for (const auto& signal : record["signal"]) EXPECT_NEAR(signal["rms"].get<double>(), 0.01, 0.002) << record;
  EXPECT_THAT(hydro::io::read_text(folder / "swings.svg"), AllOf(HasSubstr("first.csv"), HasSubstr("third.csv")));

  const auto held_back = nlohmann::json::parse(told(
      {.scene = examples / "held_back.toml", .picture = folder / "held.svg", .predict = true, .at = fitted}, true));
  EXPECT_EQ(held_back["parameter"][0]["value"], j["parameter"]["line_damping_linear"]["value"]);
  for (const auto& signal : held_back["signal"]) {
    EXPECT_NEAR(signal["rms"].get<double>(), 0.01, 0.0015) << signal;
    EXPECT_GT(signal["explained"].get<double>(), 0.998) << signal;
  }
  EXPECT_THAT(hydro::io::read_text(folder / "held.svg"), HasSubstr("predicted"));
  // The scene's own damping is another: what it explains is much less.
  const auto guessed = nlohmann::json::parse(told({.scene = examples / "held_back.toml", .predict = true}, true));
  EXPECT_GT(guessed["signal"][0]["rms"].get<double>(), 0.1);
}

// At 0.01 s the linear damping is a half-width too large, which the caution says and the interval holds. Without a step
// the fit divides the one that the samples would have until no value moves by a fifth of a half-width.
TEST_F(Fit, OfASceneCountsTheErrorOfItsSteps) {
  const auto with = [&](const char* step) {
    const auto scene = changed("swings.toml", "title", "title");  // with all files beside it
    std::string text = hydro::io::read_text(examples / "swings_scene.toml");
    const std::string own = "step = \"0.0025 s\"";
    text.replace(text.find(own), own.size(), step);
    hydro::io::write_atomically(folder / "swings_scene.toml", text);
    return nlohmann::json::parse(told({.scene = scene}, true));
  };
  const auto given = with("step = \"0.01 s\""), chosen = with("");
  ASSERT_EQ(given["cautions"].size(), 1u) << given.dump(1);
  EXPECT_THAT(given["cautions"][0].get<std::string>(),
              AllOf(HasSubstr("line.damping.linear too large by 0.0002"), HasSubstr("steps divided by 4")));
  EXPECT_EQ(given["steps_divided_by"], 1);
  EXPECT_FALSE(chosen.contains("cautions")) << chosen.dump(1);
  EXPECT_GT(chosen["steps_divided_by"], 1);
  for (const auto& j : {given, chosen}) {
    EXPECT_TRUE(holds(j["parameter"]["line_damping_linear"], 0.006)) << j.dump(1);
    EXPECT_TRUE(holds(j["parameter"]["line_damping_quadratic"], 0.004)) << j.dump(1);
  }
  // What the coarse steps are said to do is what the short ones do, to what is left of theirs.
  const auto& coarse = given["parameter"]["line_damping_linear"];
  const double moved =
      chosen["parameter"]["line_damping_linear"]["value"].get<double>() - coarse["value"].get<double>();
  EXPECT_NEAR(coarse["shift_of_short_steps"].get<double>(), moved, 0.2 * std::abs(moved));
}

TEST_F(Fit, OfSeveralRecordsSaysWhatIsWrongWithOne) {
  const auto refuses = [&](const char* from, const char* to, const char* with) {
    const auto scene = changed("swings.toml", from, to);
    EXPECT_THAT([&] { told({.scene = scene}); }, ThrowsMessage<InputError>(HasSubstr(with))) << to;
  };
  refuses("swings/second.csv", "swings/secnd.csv", "is no file");
  refuses("swings/second.csv\"", "swings/first.csv\"", "two records are called \"first\"");
  refuses("value = \"0.35 m\"", "value = \"0.35 s\"", "has another dimension");
  refuses("line.release.at.x\", value", "line.release.at.w\", value", "line.release.at.w");
  refuses("{ key = \"line.release.at.z\", value", "{ key = \"line.release.at.x\", value", "set twice");
  refuses("{ key = \"line.release.at.x\", value", "{ key = \"line.damping.linear\", value", "has another dimension");
  refuses("{ key = \"line.release.at.x\", first = \"0.25 m\", lowest = \"0 m\", highest = \"0.5 m\" }",
          "{ key = \"line.damping.linear\" }", "fitted to all records already");
  refuses("start = \"0.4 s\"", "start = \"-40 s\"", "the run begins at -40 s and the first row comes at 0 s");
  refuses("start = \"0.4 s\"", "start = \"0.4 s\"\nend = \"0.3 s\"", "must be later than the start");
  refuses("start = \"0.4 s\"", "start = \"0.4 s\"\nend = \"0.5 s\"", "there are 3 samples");
  refuses("channels =", "files = [\"pendulums.csv\"]\nchannels =", "files");
}

TEST_F(Fit, PredictsByAnEarlierFitOfTheSameNumbersAlone) {
  const auto refuses = [&](const froude::FitArguments& arguments, const char* with) {
    EXPECT_THAT([&] { told(arguments); }, ThrowsMessage<InputError>(HasSubstr(with)));
  };
  const auto write = [&](const char* name, const char* text) {
    hydro::io::write_atomically(folder / name, text);
    return folder / name;
  };
  const auto scene = examples / "held_back.toml";
  const char* linear = "[parameter.a]\nkey = \"line.damping.linear\"\nunit = \"kg/s\"\n";
  refuses({.scene = scene, .predict = true, .at = write("none.toml", "a = 1\n")}, "has no tables [parameter");
  refuses({.scene = scene, .predict = true, .at = write("no.toml", linear)}, "has no value");
  refuses({.scene = scene, .predict = true, .at = write("one.toml", (std::string(linear) + "value = 0.006\n").c_str())},
          "this fit has no \"line.damping.quadratic\"; it has line.damping.linear");
  refuses({.scene = scene,
           .predict = true,
           .at = write("unit.toml", "[parameter.a]\nkey = \"line.damping.linear\"\nunit = \"m\"\nvalue = 1.0\n")},
          "is in m, and in kg/s in the scene");
  refuses({.scene = examples / "pendulums.toml", .predict = true}, "[model] has a window");
  refuses({.scene = examples / "restoring.toml", .predict = true}, "no scene that tells a record by itself");
  // Grams a second are a thousandth of the scene's unit.
  const auto grams = write("grams.toml",
                           "[parameter.a]\nkey = \"line.damping.linear\"\nunit = \"g/s\"\nvalue = 6.0\n"
                           "[parameter.b]\nkey = \"line.damping.quadratic\"\nunit = \"kg/m\"\nvalue = 0.004\n");
  const auto j = nlohmann::json::parse(told({.scene = scene, .predict = true, .at = grams}, true));
  EXPECT_NEAR(j["parameter"][0]["value"].get<double>(), 0.006, 1e-15);
}

// Where a body lies along the waves, the arm of a point on it, and the phase of the waves of a record whose clock
// nobody set: from two records of a scene with other numbers in it.
TEST_F(Fit, OfASceneInWavesFindsPhasePositionAndTheArmOfAPoint) {
  std::filesystem::copy(examples.parent_path() / "data/pontoon1.nc", folder / "pontoon1.nc");
  const std::string text = R"(schema = 1
[water]
density = "1000 kg/m^3"
depth = "14 m"
[waves]
kind = "regular"
height = "0.4 m"
period = "4 s"
phase = "0 deg"
heading = "0 deg"
[[body]]
name = "m"
mass = "9088 kg"
centre_of_gravity = "(0, 0, 1.31) m"
radii_of_gyration = "(4.6, 4.6, 6.4) m"
position = "(1.2, 0, 0) m"
free = ["heave", "pitch"]
[body.hydrodynamics]
file = "pontoon1.nc"
hydrostatics = true
excitation = true
radiation = { memory_tolerance = 1e-2, accept_error = 0.05, method = "poles" }
[[point]]
name = "mark"
on = "m"
at = "(2.5, 0, 1) m"
gives = "position"
[ask]
run = { duration = "30 s", every = "0.1 s", of = ["m.heave", "mark.z"] }
[solve]
step = "0.05 s"
accept_error = true
)";
  hydro::io::write_atomically(folder / "scene.toml", text);
  constexpr double noise = 2e-3;
  for (const auto& [file, phase] : {std::pair{"first.csv", 40.0}, std::pair{"second.csv", 200.0}}) {
    const froude::Run run = froude::simulate(froude::scene::parse_with(
        text, folder / "scene.toml", {{"waves.phase", phase}, {"body.m.position.x", 1.5}, {"point.mark.at.x", 3}}));
    const auto e = froude_test::ar1_noise(2 * run.time.size(), 0, noise, static_cast<std::uint64_t>(phase));
    std::string rows = "t [s],heave [m],mark [m]\n";
    for (std::size_t i = 0; i < run.time.size(); ++i)
      rows += fmt::format("{:.1f},{:.6f},{:.6f}\n", run.time[i], run.signal("m.heave")[i] + e[2 * i],
                          run.signal("mark.z")[i] + e[2 * i + 1]);
    hydro::io::write_atomically(folder / file, rows);
  }
  hydro::io::write_atomically(folder / "fit.toml", R"(schema = 1
[data]
channels = { time = "t" }
signal = [
  { column = "heave", of = "m.heave", deviation = "2 mm" },
  { column = "mark", of = "mark.z", deviation = "2 mm" },
]
[[data.record]]
file = "first.csv"
set = [{ key = "waves.phase", value = "40 deg" }]
[[data.record]]
file = "second.csv"
parameter = [{ key = "waves.phase", first = "180 deg" }]
[model]
kind = "motion"
scene = "scene.toml"
parameter = [{ key = "body.m.position.x" }, { key = "point.mark.at.x" }]
[ask]
)");
  const auto j = nlohmann::json::parse(told({.scene = folder / "fit.toml"}, true));
  for (const auto& [name, truth, good] :
       {std::tuple{"body_m_position_x", 1.5, 0.03}, std::tuple{"point_mark_at_x", 3.0, 0.03},
        std::tuple{"waves_phase_of_second", 200.0, 2.0}}) {
    const auto& q = j["parameter"][name];
    const double error = q["standard_error"];
    EXPECT_LT(error, good / 2) << q;
    EXPECT_LT(std::abs(q["value"].get<double>() - truth), 4 * error) << q;  // chance does so once in 16 000 times
  }
}

TEST_F(Fit, OfASceneGivesProfilesWhereAsked) {
  const auto scene = changed("pendulums.toml", "[ask]", "[ask]\nprofile = true");
  const auto j = nlohmann::json::parse(told({.scene = scene}, true));
  for (const auto& [name, truth] : {std::pair{"line_damping_linear", 0.006}, {"line_damping_quadratic", 0.004}}) {
    const auto &plain = j["parameter"][name]["interval"], &profile = j["parameter"][name]["profile_interval"];
    EXPECT_LT(profile[0].get<double>(), truth);  // as make_pendulums.py says
    EXPECT_GT(profile[1].get<double>(), truth);
    const double width = plain[1].get<double>() - plain[0].get<double>();
    for (const std::size_t end : {0u, 1u})  // nearly linear
      EXPECT_NEAR(profile[end].get<double>(), plain[end].get<double>(), 0.15 * width) << name;
  }
  EXPECT_THAT([&] { told({.scene = changed("pendulums.toml", "[ask]", "[ask]\nprofile = true\nlaw = \"best\"")}); },
              ThrowsMessage<InputError>(HasSubstr("does not apply to a fit of kind \"motion\"")));
}

TEST_F(Fit, OfASceneSaysWhichKeyItCannotFind) {
  EXPECT_THAT([&] { told({.scene = changed("pendulums.toml", "damping.linear", "damping.linaer")}); },
              ThrowsMessage<InputError>(HasSubstr("did you mean \"linear\"?")));
  EXPECT_THAT([&] { told({.scene = changed("pendulums.toml", "chain.link2", "chain.link3")}); },
              ThrowsMessage<InputError>(HasSubstr("chain.link3.polar")));
  EXPECT_THAT([&] { told({.scene = changed("pendulums.toml", "0.6 deg", "0.6 m")}); },
              ThrowsMessage<InputError>(HasSubstr("an angle is needed")));
}

TEST_F(Fit, OfASceneWhoseSearchHasNoEndTellsNothing) {
  const auto scene = changed("pendulums.toml", "window = \"2 s\"", "window = \"2 s\"\niterations = 1");
  std::ostringstream out, err;
  const froude::FitArguments arguments{.scene = scene, .output = folder / "p.toml", .picture = folder / "p.svg"};
  EXPECT_THAT(
      [&] {
        froude::fit(arguments, {out, err, false});
      },
      ThrowsMessage<hydro::NumericsError>(AllOf(HasSubstr("no value is told"),
                                                HasSubstr("all 1 of its iterations are used up"),
                                                HasSubstr("iterations, now 1"), HasSubstr("starts"))));
  EXPECT_THAT(out.str(), AllOf(HasSubstr("differs by"), testing::Not(HasSubstr("interval"))));
  EXPECT_FALSE(std::filesystem::exists(folder / "p.toml"));
  EXPECT_THAT(hydro::io::read_text(folder / "p.svg"), AllOf(HasSubstr("no fit"), testing::Not(HasSubstr("band"))));
}

TEST_F(Fit, OfASceneWhoseResidualsContradictTheStatedDeviationTellsNothing) {
  // The noise is 0.01 rad.
  const auto scene = changed("pendulums.toml", "\"chain.link2.polar\", deviation = \"0.6 deg\"",
                             "\"chain.link2.polar\", deviation = \"0.003 rad\"");
  try {
    told({.scene = scene, .output = folder / "p.toml"}, true);
    ADD_FAILURE() << "values were told";
  } catch (const froude::CheckFailed& e) {
    EXPECT_THAT(e.told().rule(),
                AllOf(HasSubstr("chain.link2.polar differs by 0.01"), HasSubstr("stated as 0.003 rad")));
    EXPECT_EQ(e.told().where().line, 9);  // that of the deviation
    EXPECT_THAT(e.told().remedy(), AllOf(HasSubstr("state the deviation"), HasSubstr("accept = [\"residuals\"]")));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "p.toml"));
  std::string text = hydro::io::read_text(scene);
  text.replace(text.find("[ask]"), 5, "[ask]\naccept = [\"residuals\"]");
  hydro::io::write_atomically(scene, text);
  const auto j = nlohmann::json::parse(told({.scene = scene}, true));
  ASSERT_EQ(j["accepted"].size(), 1u);
  EXPECT_THAT(j["accepted"][0].get<std::string>(),
              AllOf(HasSubstr("chain.link2.polar"), HasSubstr("made from these residuals, 3.")));
  EXPECT_LT(j["parameter"]["line_damping_linear"]["interval"][0].get<double>(), 0.006);  // as make_pendulums.py says
  EXPECT_GT(j["parameter"]["line_damping_linear"]["interval"][1].get<double>(), 0.006);
  EXPECT_THAT([&] { told({.scene = changed("oscillation.toml", "[ask]", "[ask]\naccept = [\"residuals\"]")}); },
              ThrowsMessage<InputError>(HasSubstr("does not apply to a fit of kind \"morison\"")));
}

TEST_F(Fit, OfASceneMayBeginAtSeveralPoints) {
  const auto scene = changed("pendulums.toml", "window = \"2 s\"", "window = \"2 s\"\nstarts = 2");
  EXPECT_THAT([&] { told({.scene = scene}); }, ThrowsMessage<InputError>(HasSubstr("no bounds between which")));
  std::string text = hydro::io::read_text(scene);
  for (const std::string unit : {"kg/s", "kg/m"}) {
    const std::string lowest = "lowest = \"1e-6 " + unit + "\"";
    text.replace(text.find(lowest), lowest.size(), lowest + ", highest = \"0.05 " + unit + "\"");
  }
  hydro::io::write_atomically(scene, text);
  const auto j = nlohmann::json::parse(told({.scene = scene}, true));
  EXPECT_EQ(j["starts"]["tried"], 2);
  EXPECT_EQ(j["starts"]["agree"], 2);  // both find what the windows tell: the second search hands them on anew
  EXPECT_LT(j["parameter"]["line_damping_linear"]["interval"][0].get<double>(), 0.006);
  EXPECT_GT(j["parameter"]["line_damping_linear"]["interval"][1].get<double>(), 0.006);
}

}  // namespace
}  // namespace fit_test
