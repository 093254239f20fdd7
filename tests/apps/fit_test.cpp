// `froude fit` through the function that main.cpp calls.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>
#include <utility>

#include "answers/simulate.hpp"
#include "fit_fixture.hpp"
#include "froude/commands.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"
#include "scene/override.hpp"
#include "scene/scene.hpp"
#include "support/coloured_noise.hpp"
#include "support/source_dir.hpp"

namespace fit_test {
namespace {

using hydro::InputError;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::filesystem::path examples = froude_test::source_dir() / "examples/fit";

class Fit : public FitFolder {
 protected:
  /// The example with one text replaced, its data beside it.
  std::filesystem::path changed(const std::string& scene, const std::string& from, const std::string& to) {
    std::string text = hydro::io::read_text(examples / scene);
    text.replace(text.find(from), from.size(), to);
    using Options = std::filesystem::copy_options;
    std::filesystem::copy(examples, folder, Options::recursive | Options::overwrite_existing);
    hydro::io::write_atomically(folder / "changed.toml", text);
    return folder / "changed.toml";
  }
};

TEST_F(Fit, OfStiffnessHasTheTruthInItsIntervalsAndIsWhatASceneTakes) {
  const auto j = nlohmann::json::parse(told({.scene = examples / "restoring.toml"}, true));
  const auto holds = [&](const char* name, double truth) {
    return j[name]["interval"][0].get<double>() < truth && truth < j[name]["interval"][1].get<double>();
  };
  EXPECT_TRUE(holds("stiffness", 820)) << j["stiffness"];  // the values that make_restoring.py put in
  EXPECT_TRUE(holds("cubic", 450)) << j["cubic"];
  EXPECT_THAT(j["coefficients"]["stiffness"].get<std::string>(), testing::EndsWith(" N/m"));
  EXPECT_THAT(j["coefficients"]["cubic"].get<std::string>(), testing::EndsWith(" N/m^3"));
  told({.scene = examples / "restoring.toml", .picture = folder / "curve.svg"});
  EXPECT_THAT(hydro::io::read_text(folder / "curve.svg"), AllOf(HasSubstr("restoring_1.csv"), HasSubstr("fitted")));
  EXPECT_THAT([&] { told({.scene = changed("restoring.toml", "[\"stiffness\", \"cubic\"]", "[\"cubic\"]")}); },
              ThrowsMessage<InputError>(HasSubstr("leaves the stiffness out")));
  EXPECT_THAT([&] { told({.scene = changed("restoring.toml", "[\"stiffness\", \"cubic\"]", "[\"cd\"]")}); },
              ThrowsMessage<InputError>(HasSubstr("does not apply to a fit of kind \"restoring\"")));
}

TEST_F(Fit, OfTheExampleHasTheTruthInItsIntervals) {
  const auto j = nlohmann::json::parse(told({.scene = examples / "oscillation.toml"}, true));
  const auto& run = j["run"][0];
  const auto holds = [&](const char* name, double truth) {
    return run[name]["interval"][0].get<double>() < truth && truth < run[name]["interval"][1].get<double>();
  };
  EXPECT_TRUE(holds("cd", 1.2));  // the values that make_oscillation.py put in
  EXPECT_TRUE(holds("ca", 1.0));
  EXPECT_TRUE(holds("cm", 2.0));
  EXPECT_NEAR(run["kc"].get<double>(), 2 * 3.14159265 * 0.36 / 0.12, 0.05);
  EXPECT_NEAR(run["re"].get<double>(), 2 * 3.14159265 / 4.35 * 0.36 * 0.12 / 1.05e-6, 200);
  EXPECT_LT(run["cd"]["effective_samples"].get<double>(), 500);
}

TEST_F(Fit, WritesItsEstimatesAndAPicture) {
  const std::string text =
      told({.scene = examples / "oscillation.toml", .output = folder / "c.toml", .picture = folder / "c.svg"});
  EXPECT_THAT(text, AllOf(HasSubstr("KC 18.8"), HasSubstr("95 % interval"), HasSubstr("body moving in still water"),
                          HasSubstr("no delay")));
  EXPECT_THAT(hydro::io::read_text(folder / "c.toml"),
              AllOf(HasSubstr("[[run]]"), HasSubstr("[run.cd]"), HasSubstr("interval = [1.")));
  EXPECT_THAT(hydro::io::read_text(folder / "c.svg"), AllOf(HasSubstr("measured"), HasSubstr("fitted")));
}

TEST_F(Fit, OfARawRecordTellsItsStepsAndHasTheTruthInItsIntervals) {
  const auto run = nlohmann::json::parse(told({.scene = examples / "tank.toml"}, true))["run"][0];
  const auto holds = [&](const char* name, double truth) {
    return run[name]["interval"][0].get<double>() < truth && truth < run[name]["interval"][1].get<double>();
  };
  EXPECT_TRUE(holds("cd", 2.4));  // the values that make_tank_run.py put in
  EXPECT_TRUE(holds("ca", 1.1));
  EXPECT_TRUE(holds("delay", 0.12));
  EXPECT_GT(run["cd"]["systematic_error"].get<double>(), 0.009);  // 0.5 mm of 120 mm
  const std::string text = told({.scene = examples / "tank.toml"});
  EXPECT_THAT(text, AllOf(HasSubstr("8.041 Hz in the force"), HasSubstr("V2 has 0.0935"),
                          HasSubstr("10 cycles of full amplitude"), HasSubstr("one deviation of the diameter")));
}

TEST_F(Fit, OfADecayHasTheTruthInItsIntervals) {
  const auto run = nlohmann::json::parse(told({.scene = examples / "decay.toml"}, true))["run"][0];
  const auto holds = [&](const char* name, double truth) {
    return run[name]["interval"][0].get<double>() < truth && truth < run[name]["interval"][1].get<double>();
  };
  EXPECT_TRUE(holds("period", 6.4));  // the values of make_decay.py
  EXPECT_TRUE(holds("linear", 0.02));
  EXPECT_TRUE(holds("quadratic", 0.6));
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

TEST_F(Fit, OfACampaignGivesATableAndALaw) {
  const auto j = nlohmann::json::parse(told({.scene = examples / "batch.toml"}, true));
  ASSERT_EQ(j["run"].size(), 7u);
  const nlohmann::json* kc = nullptr;
  for (const auto& law : j["law"])
    if (law["of"] == "cd" && law["law"] == "ln KC") kc = &law;
  ASSERT_NE(kc, nullptr);
  EXPECT_LT((*kc)["intervals"][1][0].get<double>(), -0.8);  // the slope of make_batch.py
  EXPECT_GT((*kc)["intervals"][1][1].get<double>(), -0.8);
  const std::string text =
      told({.scene = examples / "batch.toml", .table = folder / "t.csv", .picture = folder / "t.svg"});
  EXPECT_THAT(text, AllOf(HasSubstr("cd over 7 runs"), HasSubstr("cross-validation")));
  EXPECT_THAT(hydro::io::read_text(folder / "t.csv"),
              AllOf(HasSubstr("file,amplitude,period,day,KC,Re,beta"), HasSubstr("run_3.csv,0.3,3.6,Monday,15.")));
  EXPECT_THAT(hydro::io::read_text(folder / "t.svg"), AllOf(HasSubstr("95 % interval"), HasSubstr("Re")));
}

TEST_F(Fit, LooksAtCyclesAndAtOtherChoicesWhereAsked) {
  const auto scene =
      changed("tank.toml", "coefficients = [\"cd\", \"ca\"]",
              "coefficients = [\"cd\", \"ca\"]\nsensitivity = true\nintervals = { method = \"cycle clusters\" }");
  const auto run = nlohmann::json::parse(told({.scene = scene}, true))["run"][0];
  ASSERT_EQ(run["variant"].size(), 6u);  // two cutoffs, two bandwidths, two halves
  for (const auto& v : run["variant"])
    EXPECT_LT(std::abs(v["cd"].get<double>()), 4 * run["cd"]["standard_error"].get<double>()) << v["with"];
  EXPECT_THAT([&] { told({.scene = changed("tank.toml", "[ask]", "[ask]\ncycles = true")}); },
              ThrowsMessage<InputError>(HasSubstr("while the delay is being estimated")));
}

TEST_F(Fit, SaysThatAChannelHasTheWrongSign) {
  const auto scene = changed("tank.toml", "\"-V2\"", "\"V2\"");
  EXPECT_THAT([&] { told({.scene = scene}); }, ThrowsMessage<InputError>(HasSubstr("wrong sign")));
}

TEST_F(Fit, OfTowingGivesEachRunAndAllTogether) {
  const std::string text =
      told({.scene = examples / "towing.toml", .output = folder / "t.toml", .picture = folder / "t.svg"});
  EXPECT_THAT(text, AllOf(HasSubstr("1.191"), HasSubstr("1.200"), HasSubstr("1.175"), HasSubstr("1.173"),
                          HasSubstr("1.163"), HasSubstr("together: cd 1.18")));
  EXPECT_THAT(hydro::io::read_text(folder / "t.svg"), HasSubstr("C_D"));
}

TEST_F(Fit, OfRecordsOfTowsGivesTheNumbersOfTheTableThatTheyAreMadeWith) {
  const auto j = nlohmann::json::parse(told({.scene = examples / "tows.toml",
                                             .output = folder / "t.toml",
                                             .table = folder / "t.csv",
                                             .picture = folder / "t.svg"},
                                            true));
  ASSERT_EQ(j["run"].size(), 5u);
  // Means and deviations of make_tows.py, C_D of the means.
  const double cd[] = {1.191, 1.200, 1.175, 1.173, 1.163}, force[] = {25.32, 17.33, 10.44, 5.53, 2.14},
               deviation[] = {0.24, 0.15, 0.12, 0.10, 0.07};
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& run = j["run"][i];
    EXPECT_LT(run["cd"]["interval"][0].get<double>(), cd[i]);
    EXPECT_GT(run["cd"]["interval"][1].get<double>(), cd[i]);
    EXPECT_NEAR(run["force"]["mean"].get<double>(), force[i],
                0.3 * deviation[i]);  // √(2·0.25 s/40 s) = 0.11 of it, and the zero's
    EXPECT_NEAR(run["force"]["deviation"].get<double>(), deviation[i], 0.3 * deviation[i]);  // of 80 independent ones
  }
  EXPECT_THAT(hydro::io::read_text(folder / "t.svg"), AllOf(HasSubstr("steady part"), HasSubstr("C_D")));
  EXPECT_THAT(hydro::io::read_text(folder / "t.csv"), HasSubstr("tow_5.csv,"));
  const std::string text = told({.scene = examples / "tows.toml"});
  EXPECT_THAT(text, AllOf(HasSubstr("coefficient of variation"), HasSubstr("steady part: the carriage moves from"),
                          HasSubstr("cd over 5 runs")));
}

TEST_F(Fit, OfRecordsOfTowsRefusesWhatDoesNotGoTogether) {
  const auto refused = [&](const char* from, const char* to) {
    return [=, this] { told({.scene = changed("tows.toml", from, to)}); };
  };
  EXPECT_THAT(refused("force = [\"-F1\", \"-F2\"]", "force = [\"F1\", \"F2\"]"),
              ThrowsMessage<InputError>(HasSubstr("wrong sign")));
  EXPECT_THAT(refused("time = \"t\", ", ""), ThrowsMessage<InputError>(HasSubstr("does not apply to a fit of kind")));
  EXPECT_THAT(refused("zero_at_rest = true\n", "zero_at_rest = true\ntolerance = 2\n"),
              ThrowsMessage<InputError>(HasSubstr("tolerance")));
  EXPECT_THAT(refused("[prepare]", "[prepare]\ndelay = \"0.1 s\""), ThrowsMessage<InputError>(HasSubstr("delay")));
  EXPECT_THAT(refused("[prepare]", "[prepare]\nwindow = { kind = \"full cycles\" }"),
              ThrowsMessage<InputError>(HasSubstr("must be \"span\"")));
  EXPECT_THAT(refused("coefficients = [\"cd\"]", "coefficients = [\"cd\"]\naccept = [\"residuals\"]"),
              ThrowsMessage<InputError>(HasSubstr("does not act on records")));
}

TEST_F(Fit, OfRegularWavesHasTheTruthInItsIntervals) {
  const auto j = nlohmann::json::parse(
      told({.scene = examples / "waves_runs.toml", .table = folder / "w.csv", .picture = folder / "w.svg"}, true));
  ASSERT_EQ(j["run"].size(), 8u);
  int held = 0;
  for (const auto& run : j["run"]) {
    const double omega = run["omega_rad_s"], r = omega * 1.5 / (2 * M_PI);  // the body of make_waves_runs.py
    const std::complex<double> heave = 1.0 / std::complex<double>(1 - r * r, 2 * 0.15 * r);
    const std::pair<double, double> truth[] = {{std::abs(heave), std::arg(heave)}, {900, 0.3 * omega}};
    for (std::size_t c = 0; c < 2; ++c) {
      const auto& response = run["response"][c];
      const auto& interval = response["rao"]["interval"];
      held += interval[0].get<double>() < truth[c].first && truth[c].first < interval[1].get<double>() ? 1 : 0;
      EXPECT_NEAR(std::remainder(response["phase_rad"].get<double>() - truth[c].second, 2 * M_PI), 0,
                  4 * response["phase_error_rad"].get<double>() + 0.02);  // 3 m of k, known to 1e-3 with the period
    }
    EXPECT_NEAR(run["response"][1]["motion"]["amplitudes"][1].get<double>(), 0.08 * 900 * 0.03, 0.3);
  }
  EXPECT_GE(held, 13);  // 15.2 of 16 expected, with a deviation of 0.9
  ASSERT_EQ(j["repeated"].size(), 2u);
  EXPECT_EQ(j["repeated"][0]["runs"].get<int>(), 3);
  EXPECT_THAT(hydro::io::read_text(folder / "w.svg"), AllOf(HasSubstr("heave RAO"), HasSubstr("by peaks")));
  EXPECT_THAT(hydro::io::read_text(folder / "w.csv"), HasSubstr("run_8.csv,"));
}

TEST_F(Fit, OfRegularWavesRefusesWhatDoesNotGoTogether) {
  const auto refused = [&](const char* from, const char* to) {
    return [=, this] { told({.scene = changed("waves_runs.toml", from, to)}); };
  };
  EXPECT_THAT(refused("end = \"60 m\"", "end = \"22 m\""),
              ThrowsMessage<InputError>(HasSubstr("lies before the gauge")));
  EXPECT_THAT(refused("end = \"60 m\"", "end = \"24 m\""), ThrowsMessage<InputError>(HasSubstr("no three periods of")));
  EXPECT_THAT(refused("[\"heave\", \"F\"]", "[\"heave\", \"heave\"]"), ThrowsMessage<InputError>(HasSubstr("twice")));
  EXPECT_THAT(refused("[\"heave\", \"F\"]", "[\"heav\"]"), ThrowsMessage<InputError>(HasSubstr("heave")));
  EXPECT_THAT(refused("[\"heave\", \"F\"]", "[]"), ThrowsMessage<InputError>(HasSubstr("is empty")));
  EXPECT_THAT(refused("tank = {", "#"), ThrowsMessage<InputError>(HasSubstr("tank")));
  EXPECT_THAT(refused("ramp = \"2 s\"", "ramp = \"2 s\"\nharmonics = 0"),
              ThrowsMessage<InputError>(HasSubstr("between 1 and 20")));
  EXPECT_THAT(refused("[ask]", "[prepare]\nlow_pass = { kind = \"butterworth\", cutoff = \"3 Hz\" }\n[ask]"),
              ThrowsMessage<InputError>(HasSubstr("peaks have a band of their own")));
}

TEST_F(Fit, OfOneRunInRegularWavesDrawsItsRecord) {
  told({.scene = changed("waves_runs.toml", "run_*.csv", "run_3.csv"), .picture = folder / "w.svg"});
  EXPECT_THAT(hydro::io::read_text(folder / "w.svg"), AllOf(HasSubstr("elevation"), HasSubstr("fitted")));
}

TEST_F(Fit, NeedsMoreThanAnAcceleration) {
  const auto scene = changed("oscillation.toml", "position = \"pos\"", "acceleration = \"pos\"");
  EXPECT_THAT([&] { told({.scene = scene}); }, ThrowsMessage<InputError>(HasSubstr("drag needs the velocity")));
}

TEST_F(Fit, WithOtherDerivativesFindsTheSameCoefficients) {
  const auto j = nlohmann::json::parse(told({.scene = examples / "steady.toml"}, true))["run"][0];
  const auto spline = nlohmann::json::parse(
      told({.scene = changed("steady.toml", "fourier series", "smoothing spline")}, true))["run"][0];
  for (const auto& run : {j, spline})
    for (const auto& [name, truth] : {std::pair{"cd", 1.2}, {"ca", 1.0}}) {  // as make_oscillation.py says
      EXPECT_LT(run[name]["interval"][0].get<double>(), truth);
      EXPECT_GT(run[name]["interval"][1].get<double>(), truth);
    }
  EXPECT_THAT(j.dump(), HasSubstr("Fourier series of 2 harmonics of 4.35 s"));
  EXPECT_THAT(spline.dump(), HasSubstr("smoothing spline of degree 5"));
  EXPECT_THAT([&] { told({.scene = changed("steady.toml", "0.5 Hz", "0.2 Hz")}); },
              ThrowsMessage<InputError>(HasSubstr("has no harmonic")));
}

TEST_F(Fit, NamesTheFileAndTheColumnAtFault) {
  EXPECT_THAT([&] { told({.scene = changed("oscillation.toml", "force = \"F\"", "force = \"f\"")}); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("oscillation.csv"), HasSubstr("no column \"f\""))));
  EXPECT_THAT([&] { told({.scene = changed("oscillation.toml", "force = \"F\"", "force = \"pos\"")}); },
              ThrowsMessage<InputError>(HasSubstr("a force is needed")));
}

TEST_F(Fit, OfASceneFindsTheDampingThatAnIndependentRecordHas) {
  const auto j = nlohmann::json::parse(
      told({.scene = examples / "pendulums.toml", .output = folder / "p.toml", .picture = folder / "p.svg"}, true));
  const auto& parameter = j["parameter"];
  const auto holds = [&](const char* name, double truth) {
    const auto& interval = parameter[name]["interval"];
    return interval[0].get<double>() < truth && truth < interval[1].get<double>();
  };
  EXPECT_TRUE(holds("line_damping_linear", 0.006)) << j.dump(1);  // as make_pendulums.py says
  EXPECT_TRUE(holds("line_damping_quadratic", 0.004)) << j.dump(1);
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
  const auto holds = [&](const char* name, double truth) {
    const auto& interval = j["parameter"][name]["interval"];
    return interval[0].get<double>() < truth && truth < interval[1].get<double>();
  };
  EXPECT_TRUE(holds("line_damping_linear", 0.006)) << j.dump(1);
  EXPECT_TRUE(holds("line_damping_quadratic", 0.004)) << j.dump(1);
  EXPECT_TRUE(holds("line_release_at_x_of_second", 0.2)) << j.dump(1);
  EXPECT_TRUE(holds("line_release_at_z_of_second", -0.8)) << j.dump(1);
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
  // A swing whose period halves, of which the search finds no end.
  measured([](double t) { return 0.2 * std::cos(0.8 * t + 0.004 * t * t); });
  EXPECT_THAT(
      [&] { told({.scene = scene}, true); },
      ThrowsMessage<hydro::NumericsError>(AllOf(HasSubstr("decay.csv: no value is told"), HasSubstr("no end"))));
}

TEST_F(Fit, OfTowingRunsThatContradictTheirDeviationsTellsNoMean) {
  const auto scene = changed("towing.toml", "[ask]", "[ask]");
  std::string text = hydro::io::read_text(folder / "towing.csv");
  text.replace(text.find("25.32,0.24"), 10, "20.32,0.24");
  hydro::io::write_atomically(folder / "towing.csv", text);
  std::ostringstream out, err;
  EXPECT_THAT(
      [&] {
        froude::fit({.scene = scene}, {out, err, false});
      },
      ThrowsMessage<froude::CheckFailed>(AllOf(HasSubstr("they scatter"), HasSubstr("allow 2.69 times"))));
  EXPECT_THAT(out.str(), AllOf(HasSubstr("0.843"), testing::Not(HasSubstr("together"))));
  text = hydro::io::read_text(scene);
  text.replace(text.find("[ask]"), 5, "[ask]\naccept = [\"residuals\"]");
  hydro::io::write_atomically(scene, text);
  EXPECT_THAT(told({.scene = scene}), AllOf(HasSubstr("together: cd"), HasSubstr("accepted: the runs scatter")));
}

/// The interval of a coefficient holds the truth.
bool holds(const nlohmann::json& c, double truth) {
  return c["interval"][0].get<double>() < truth && truth < c["interval"][1].get<double>();
}

TEST_F(Fit, OfAMeanCycleHasTheTruthInItsIntervals) {
  const auto run = nlohmann::json::parse(told({.scene = examples / "mean_cycle.toml"}, true))["run"][0];
  EXPECT_TRUE(holds(run["cd"], 1.2));  // as make_oscillation.py says
  EXPECT_TRUE(holds(run["ca"], 1.0));
  EXPECT_THAT(run.dump(), AllOf(HasSubstr("from 50 Hz to 20 Hz"), HasSubstr("over each other")));
  told({.scene = examples / "mean_cycle.toml", .picture = folder / "m.svg"});
  EXPECT_THAT(hydro::io::read_text(folder / "m.svg"),
              AllOf(HasSubstr("time in the cycle"), HasSubstr("band of the fit")));
  EXPECT_THAT([&] { told({.scene = changed("mean_cycle.toml", "window = { kind = \"full cycles\" }\n", "")}); },
              ThrowsMessage<InputError>(HasSubstr("needs cycles")));
}

TEST_F(Fit, OfABodyThatMovesInWavesHasTheTruthInItsIntervals) {
  const auto run = nlohmann::json::parse(told({.scene = examples / "in_waves.toml"}, true))["run"][0];
  EXPECT_TRUE(holds(run["cd"], 1.4)) << run.dump(1);  // as make_in_waves.py says
  EXPECT_TRUE(holds(run["ca"], 0.8));
  EXPECT_TRUE(holds(run["line"][0], 3.0));
  EXPECT_NEAR(run["samples_in_band"].get<double>(), 0.95, 0.03);
  const auto without = nlohmann::json::parse(
      told({.scene = changed("in_waves.toml", "line = [{ frequency = \"1.1 Hz\" }]", "linear_drag = true")},
           true))["run"][0];
  EXPECT_GT(without["residual_rms_N"].get<double>(), 1.5 * run["residual_rms_N"].get<double>());
  EXPECT_TRUE(without.contains("linear_drag"));
  EXPECT_THAT([&] { told({.scene = changed("in_waves.toml", "\"both move\"", "\"body moves\"")}); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("water_velocity"), HasSubstr("both move"))));
  EXPECT_THAT([&] { told({.scene = changed("in_waves.toml", "water_velocity = \"u\", ", "")}); },
              ThrowsMessage<InputError>(HasSubstr("water_velocity or elevation")));
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
  EXPECT_THAT(told({.scene = two}), AllOf(HasSubstr("run_2.csv: 10 half cycles"),
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
