// `froude fit` of what holds and slows a body: decays, springs, brakes, forced oscillations; by the function of
// main.cpp.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "answers/simulate.hpp"
#include "fit_fixture.hpp"
#include "froude/commands.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"
#include "scene/scene.hpp"

namespace fit_test {
namespace {

using hydro::InputError;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST_F(Fit, OfStiffnessHasTheTruthInItsIntervalsAndIsWhatASceneTakes) {
  const auto j = nlohmann::json::parse(told({.scene = examples / "restoring.toml"}, true));
  EXPECT_TRUE(holds(j["stiffness"], 820)) << j["stiffness"];  // the values that make_restoring.py put in
  EXPECT_TRUE(holds(j["cubic"], 450)) << j["cubic"];
  EXPECT_THAT(j["coefficients"]["stiffness"].get<std::string>(), testing::EndsWith(" N/m"));
  EXPECT_THAT(j["coefficients"]["cubic"].get<std::string>(), testing::EndsWith(" N/m^3"));
  told({.scene = examples / "restoring.toml", .picture = folder / "curve.svg"});
  EXPECT_THAT(hydro::io::read_text(folder / "curve.svg"), AllOf(HasSubstr("restoring_1.csv"), HasSubstr("fitted")));
  EXPECT_THAT([&] { told({.scene = changed("restoring.toml", "[\"stiffness\", \"cubic\"]", "[\"cubic\"]")}); },
              ThrowsMessage<InputError>(HasSubstr("leaves the stiffness out")));
  EXPECT_THAT([&] { told({.scene = changed("restoring.toml", "[\"stiffness\", \"cubic\"]", "[\"cd\"]")}); },
              ThrowsMessage<InputError>(HasSubstr("does not apply to a fit of kind \"restoring\"")));
}

TEST_F(Fit, OfADecayHasTheTruthInItsIntervals) {
  const auto run = nlohmann::json::parse(told({.scene = examples / "decay.toml"}, true))["run"][0];
  EXPECT_TRUE(holds(run["period"], 6.4));  // the values of make_decay.py
  EXPECT_TRUE(holds(run["linear"], 0.02));
  EXPECT_TRUE(holds(run["quadratic"], 0.6));
  const std::string text =
      told({.scene = examples / "decay.toml", .output = folder / "d.toml", .picture = folder / "d.svg"});
  EXPECT_THAT(text, AllOf(HasSubstr("quadratic"), HasSubstr("1/rad"), HasSubstr("AICc"), HasSubstr("white with p")));
  // Noise with a memory of three samples, of which a fortieth of the period takes two; no harmonic of the swing.
  EXPECT_LT(run["residuals"]["harmonic_share"].get<double>(), 0.1);
  EXPECT_THAT(hydro::io::read_text(folder / "d.toml"),
              AllOf(HasSubstr("[coefficients]"), HasSubstr("[run.quadratic]")));
  EXPECT_THAT(hydro::io::read_text(folder / "d.svg"), HasSubstr("residual"));
}

// Decay, fit, coefficients into a scene, decay of that scene: the same coefficients again.
TEST_F(Fit, OfADecayGivesTheDampingThatAFloatingBodyTakes) {
  const auto first =
      nlohmann::json::parse(told({.scene = examples / "decay.toml", .output = folder / "roll.toml"}, true));
  EXPECT_THAT(hydro::io::read_text(folder / "roll.toml"),
              AllOf(HasSubstr("linear_damping = \"265."), HasSubstr(" N m s/rad\""), HasSubstr(" N m s^2/rad^2\"")));
  EXPECT_NEAR(first["coefficients"]["added_mass"].get<double>(), 2490.14, 0.01);  // what the scene has of the water
  std::string scene = hydro::io::read_text(examples.parent_path() / "rolling.toml");
  for (const auto& [from, to] : {std::pair{"schema = 1", "schema = 1\ninclude = \"roll.toml\""},
                                 std::pair{"265.32 N m s/rad", "roll.linear_damping"},
                                 std::pair{"7317.1 N m s^2/rad^2", "roll.quadratic_damping"}})
    scene.replace(scene.find(from), std::string(from).size(), to);
  hydro::io::write_atomically(folder / "scene.toml", scene);
  const froude::Run run = froude::simulate(froude::scene::read(folder / "scene.toml"));
  std::string rows = "t [s],roll [rad]\n";
  for (std::size_t i = 0; i < run.time.size(); ++i)
    rows += fmt::format("{:.10g},{:.12g}\n", run.time[i], run.signal("hull.roll")[i]);
  hydro::io::write_atomically(folder / "decay.csv", rows);
  std::filesystem::copy(examples / "decay.toml", folder / "again.toml");
  const auto again = nlohmann::json::parse(told({.scene = folder / "again.toml"}, true));
  for (const char* name : {"linear", "quadratic"}) {
    const auto& interval = first["run"][0][name]["interval"];
    const double value = again["coefficients"][name];
    EXPECT_LT(interval[0].get<double>(), value) << name;
    EXPECT_GT(interval[1].get<double>(), value) << name;
    EXPECT_NEAR(value, first["coefficients"][name].get<double>(), 0.01 * value) << name;  // steps of the run, 1e-3
  }
  EXPECT_NEAR(again["coefficients"]["period"].get<double>(), first["coefficients"]["period"].get<double>(), 1e-3);
}

TEST_F(Fit, OfADecayTakesItsPartOfARawRecord) {
  // Ten seconds at rest before the body is let go, a spike, and two rows that are missing.
  const auto scene = changed(
      "decay.toml", "[model]",
      "[prepare]\nlongest_gap = \"0.5 s\"\noutliers = { window = \"2 s\" }\nwindow = { kind = \"span\", from = \"10 "
      "s\", to = \"99 s\" }\n[model]");
  std::string text = "t [s],roll [rad]\n";
  for (int j = 0; j < 100; ++j) text += fmt::format("{:.1f},{:.5f}\n", 0.1 * j, 0.157 + 0.0001 * (j % 3));
  const auto table = hydro::io::CsvTable::read(examples / "decay.csv");
  const auto &t = table.column("t"), &roll = table.column("roll");
  for (std::size_t j = 0; j < t.size(); ++j)
    if (j != 300 && j != 301) text += fmt::format("{:.1f},{:.5f}\n", t[j] + 10, j == 500 ? 3.0 : roll[j]);
  hydro::io::write_atomically(folder / "decay.csv", text);
  const auto run = nlohmann::json::parse(told({.scene = scene}, true))["run"][0];
  for (const auto& [name, truth] : {std::pair{"period", 6.4}, {"linear", 0.02}, {"quadratic", 0.6}}) {  // make_decay.py
    EXPECT_LT(run[name]["interval"][0].get<double>(), truth) << name;
    EXPECT_GT(run[name]["interval"][1].get<double>(), truth) << name;
  }
  EXPECT_THAT(run["steps"].dump(), AllOf(HasSubstr("gaps: 2 of"), HasSubstr("outliers: 1 of"), HasSubstr("of angle"),
                                         HasSubstr("window: from 10 s")));
}

TEST_F(Fit, OfADecayIsRepeatedWithEachHalfWhereAsked) {
  const auto run = nlohmann::json::parse(
      told({.scene = changed("decay.toml", "[ask]", "[ask]\nsensitivity = true")}, true))["run"][0];
  ASSERT_EQ(run["variant"].size(), 2u);
  // The first half holds most of what tells the damping; the model is right, so it moves by an error or two.
  for (const char* name : {"period", "linear", "quadratic"})
    EXPECT_LT(std::abs(run["variant"][0][name].get<double>()), 4) << name;
  // Without the quadratic term the halves disagree about the linear one.
  const auto wrong = nlohmann::json::parse(
      told({.scene = changed("decay.toml", "coefficients = [\"linear\", \"quadratic\"]",
                             "coefficients = [\"linear\"]\nsensitivity = true\naccept = [\"residuals\"]")},
           true))["run"][0];
  EXPECT_LT(wrong["variant"][1]["linear"].get<double>(), -4);  // less damping in the small swings
}

TEST_F(Fit, OfADecayGivesProfilesWhereAsked) {
  const auto scene = changed("decay.toml", "[ask]", "[ask]\nprofile = true");
  const auto run = nlohmann::json::parse(told({.scene = scene}, true))["run"][0];
  for (const char* name : {"linear", "quadratic"})
    for (const int end : {0, 1}) {
      const double plain = run[name]["interval"][end].get<double>(),
                   profile = run[name]["profile_interval"][end].get<double>();
      // Nearly linear in the damping: the two differ by a tenth of the width.
      EXPECT_NEAR(profile, plain,
                  0.2 * (run[name]["interval"][1].get<double>() - run[name]["interval"][0].get<double>()));
    }
}

TEST_F(Fit, OfADecayThatIsNoneTellsNothing) {
  const auto scene = changed("decay.toml", "[ask]", "[ask]");
  const auto measured = [&](const auto& roll) {
    std::string text = "t [s],roll [rad]\n";
    for (int j = 0; j < 900; ++j) text += fmt::format("{:.1f},{:.5f}\n", 0.1 * j, roll(0.1 * j));
    hydro::io::write_atomically(folder / "decay.csv", text);
  };
  // Three swings as large as each other: one of them is a third of the whole.
  measured([](double t) { return 0.1 * (std::cos(0.8 * t) + std::cos(t) + std::cos(1.25 * t)); });
  EXPECT_THAT(
      [&] { told({.scene = scene}, true); },
      ThrowsMessage<froude::CheckFailed>(AllOf(HasSubstr("rad rms from decay.csv"), HasSubstr("50 % are the least"),
                                               HasSubstr("accept = [\"residuals\"]"))));
  // A swing whose period halves: of several starts of the search none ends where it is explained.
  measured([](double t) { return 0.2 * std::cos(0.8 * t + 0.004 * t * t); });
  EXPECT_THAT(
      [&] { told({.scene = scene}, true); },
      ThrowsMessage<froude::CheckFailed>(AllOf(HasSubstr("no value is told"), HasSubstr("50 % are the least"))));
}

TEST_F(Fit, OfABrakeGivesWhatASceneOfMotionMayInclude) {
  const auto j = nlohmann::json::parse(
      told({.scene = examples / "friction.toml", .output = folder / "brake.toml", .picture = folder / "f.svg"}, true));
  ASSERT_EQ(j["run"].size(), 4u);
  EXPECT_TRUE(holds(j["together"]["static"], 3.70));  // the means of make_friction.py
  EXPECT_TRUE(holds(j["together"]["dynamic"], 3.00));
  for (const auto& run : j["run"]) EXPECT_GT(run["drop"]["interval"][0].get<double>(), 0);
  EXPECT_THAT(hydro::io::read_text(folder / "brake.toml"), AllOf(HasSubstr("static = \"3.7"), HasSubstr(" N m\"")));
  EXPECT_THAT(hydro::io::read_text(folder / "f.svg"), HasSubstr("sliding"));
  EXPECT_THAT(told({.scene = examples / "friction.toml"}),
              AllOf(HasSubstr("static over 4 tests"), HasSubstr("slips at")));
  EXPECT_THAT([&] { told({.scene = changed("friction.toml", "ramp = \"2 s\"", "ramp = \"20 s\"")}); },
              ThrowsMessage<InputError>(HasSubstr("the record has")));
}

TEST_F(Fit, OfForcedHeaveGivesAddedMassDampingAndPoles) {
  const auto j = nlohmann::json::parse(told({.scene = examples / "radiation.toml",
                                             .output = folder / "r.toml",
                                             .table = folder / "r.csv",
                                             .picture = folder / "r.svg"},
                                            true));
  ASSERT_EQ(j["run"].size(), 9u);
  int held = 0;
  for (const auto& run : j["run"]) {  // the closed form of make_radiation.py
    const double s = run["omega_rad_s"].get<double>(), w2 = 1.2 * 1.2 + 2.8 * 2.8,
                 d = (w2 - s * s) * (w2 - s * s) + 4 * 1.44 * s * s;
    held += holds(run["added_mass"], 60 + 400 * (w2 - s * s) / d) + holds(run["damping"], 2 * 1.2 * 400 * s * s / d);
  }
  EXPECT_GE(held, 15);  // of eighteen intervals of 95 %: fewer than 15 come once in fifty
  EXPECT_NEAR(j["memory"]["added_mass_limit"].get<double>(), 60, 3);
  EXPECT_THAT(hydro::io::read_text(folder / "r.csv"), HasSubstr("damping_low [N s/m]"));
  EXPECT_THAT(hydro::io::read_text(folder / "r.svg"), AllOf(HasSubstr("poles"), HasSubstr("added mass")));
  EXPECT_THAT(told({.scene = examples / "radiation.toml"}),
              AllOf(HasSubstr("pole: decays by"), HasSubstr("harmonics of the force")));
  EXPECT_THAT([&] { told({.scene = changed("radiation.toml", "mass = \"120 kg\"", "inertia = \"120 kg m^2\"")}); },
              ThrowsMessage<InputError>(HasSubstr("does not go with the channel position")));
}

TEST_F(Fit, OfADecayTellsAddedMassWhereTheBodyIsKnown) {
  const auto run = nlohmann::json::parse(told({.scene = examples / "decay.toml"}, true))["run"][0];
  const double omega = 2 * 3.14159265358979 / 6.4;  // of make_decay.py; stiffness and inertia are those of decay.toml
  EXPECT_TRUE(holds(run["water"]["added_mass"], 12000 / (omega * omega) - 9960));
  EXPECT_TRUE(holds(run["water"]["damping"]["linear"], 0.02 * 12000 / (omega * omega)));
  EXPECT_NEAR(run["samples_in_band"].get<double>(), 0.95, 0.03);
  EXPECT_THAT(told({.scene = examples / "decay.toml"}),
              AllOf(HasSubstr("kg m^2"), HasSubstr("samples lie in the band")));
}

TEST_F(Fit, OfSeveralDecaysTellsTheMemoryOfTheWater) {
  const auto j = nlohmann::json::parse(told({.scene = examples / "heave_decays.toml",
                                             .output = folder / "m.toml",
                                             .table = folder / "m.csv",
                                             .picture = folder / "m.svg"},
                                            true));
  ASSERT_EQ(j["run"].size(), 3u);
  const auto& memory = j["together"]["memory"];
  // The water of make_heave_decays.py: 400 N/m over 180 kg.
  EXPECT_TRUE(holds(memory["memory_strength"], 400.0 / 180)) << memory.dump(1);
  EXPECT_TRUE(holds(memory["memory_decay"], 1.2)) << memory.dump(1);
  EXPECT_TRUE(holds(memory["memory_frequency"], std::hypot(1.2, 2.8))) << memory.dump(1);
  EXPECT_TRUE(holds(memory["limit"]["added_mass"], 60)) << memory.dump(1);
  const double s = memory["swing"]["omega_rad_s"].get<double>(), w2 = 1.2 * 1.2 + 2.8 * 2.8,
               d = (w2 - s * s) * (w2 - s * s) + 4 * 1.44 * s * s;
  EXPECT_TRUE(holds(memory["swing"]["added_mass"], 60 + 400 * (w2 - s * s) / d));
  EXPECT_TRUE(holds(memory["swing"]["damping"], 2 * 1.2 * 400 * s * s / d));
  EXPECT_GT(memory["aicc_gained"].get<double>(), 10);
  EXPECT_THAT(hydro::io::read_text(folder / "m.csv"),
              AllOf(HasSubstr("file,let_go_at,rest,first_amplitude [m],period [s],period_low [s]"),
                    HasSubstr("run_2.csv,0.09,-0.002,")));
  EXPECT_THAT(hydro::io::read_text(folder / "m.svg"), AllOf(HasSubstr("added mass"), HasSubstr("at the swing")));
  EXPECT_THAT(hydro::io::read_text(folder / "m.toml"), HasSubstr("memory_strength = "));
  EXPECT_GT(j["over_runs"]["linear"]["prediction"][1].get<double>(), j["over_runs"]["linear"]["value"].get<double>());
  const auto two = changed("heave_decays.toml", "runs = \"heave_decays/runs.csv\"",
                           "files = [\"heave_decays/run_1.csv\", \"heave_decays/run_2.csv\"]");
  std::string text = hydro::io::read_text(two);
  text.replace(text.find("\"memory\""), 8, "\"linear\"");
  text.replace(text.find("start = "), text.find("body = ") - text.find("start = "), "");
  hydro::io::write_atomically(two, text);
  EXPECT_THAT(told({.scene = two}), AllOf(HasSubstr("run_2.csv: 11 half cycles"),
                                          HasSubstr("2 runs with one set of coefficients"), HasSubstr("kg")));
}

TEST_F(Fit, OfOneDecayTellsTheMemoryInWords) {
  const auto one =
      changed("heave_decays.toml", "runs = \"heave_decays/runs.csv\"", "files = \"heave_decays/run_1.csv\"");
  EXPECT_THAT([&] { told({.scene = one}); }, ThrowsMessage<InputError>(HasSubstr("needs two files at least")));
  std::string text = hydro::io::read_text(one);
  text.replace(text.find("together = true"), 15, "");
  hydro::io::write_atomically(one, text);
  EXPECT_THAT(told({.scene = one}),
              AllOf(HasSubstr("by the memory at"), HasSubstr("singular values of the parameters over their errors"),
                    HasSubstr("at infinite frequency"), HasSubstr("memory_strength 2.1")));
}

TEST_F(Fit, OfASliderHasItsFrictionInNewtons) {
  auto scene = changed("friction.toml", "torque = \"M\"", "force = \"M\"");
  EXPECT_THAT([&] { told({.scene = scene}); }, ThrowsMessage<InputError>(HasSubstr("a force is needed")));
  for (const char* number : {"1", "2", "3", "4"}) {
    const auto file = folder / (std::string("friction_") + number + ".csv");
    std::string text = hydro::io::read_text(file);
    text.replace(text.find("M [N m]"), 7, "M [N]");
    hydro::io::write_atomically(file, text);
  }
  const auto j = nlohmann::json::parse(told({.scene = scene, .output = folder / "s.toml"}, true));
  EXPECT_TRUE(holds(j["together"]["static"], 3.70));  // the means of make_friction.py
  EXPECT_THAT(j["coefficients"]["dynamic"].get<std::string>(), testing::EndsWith(" N"));
  EXPECT_THAT(told({.scene = scene}), testing::Not(HasSubstr("N m")));
}

}  // namespace
}  // namespace fit_test
