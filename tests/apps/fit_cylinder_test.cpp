// `froude fit` of a cylinder in flow: forced, towed, in waves; by the function of main.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>

#include "fit_fixture.hpp"
#include "froude/commands.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace fit_test {
namespace {

using hydro::InputError;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST_F(Fit, OfTheExampleHasTheTruthInItsIntervals) {
  const auto j = nlohmann::json::parse(told({.scene = examples / "oscillation.toml"}, true));
  const auto& run = j["run"][0];
  EXPECT_TRUE(holds(run["cd"], 1.2));  // the values that make_oscillation.py put in
  EXPECT_TRUE(holds(run["ca"], 1.0));
  EXPECT_TRUE(holds(run["cm"], 2.0));
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
  EXPECT_TRUE(holds(run["cd"], 2.4));  // the values that make_tank_run.py put in
  EXPECT_TRUE(holds(run["ca"], 1.1));
  EXPECT_TRUE(holds(run["delay"], 0.12));
  EXPECT_GT(run["cd"]["systematic_error"].get<double>(), 0.009);  // 0.5 mm of 120 mm
  const std::string text = told({.scene = examples / "tank.toml"});
  EXPECT_THAT(text, AllOf(HasSubstr("8.041 Hz in the force"), HasSubstr("V2 has 0.0935"),
                          HasSubstr("10 cycles of full amplitude"), HasSubstr("one deviation of the diameter")));
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
    // Normal noise has its quartiles 1.349 of its deviation apart; 80 independent ones tell that to 10 %, three times.
    const auto& box = run["cd_box"];
    EXPECT_NEAR(box["upper_quartile"].get<double>() - box["lower_quartile"].get<double>(),
                1.349 * run["cd_of_samples"]["deviation"].get<double>(),
                0.3 * 1.349 * run["cd_of_samples"]["deviation"].get<double>());
    EXPECT_NEAR(box["median"].get<double>(), cd[i], 0.5 * deviation[i] / force[i] * cd[i]);
  }
  EXPECT_THAT(hydro::io::read_text(folder / "t.svg"),
              AllOf(HasSubstr("steady part"), HasSubstr("C_D"), HasSubstr("outliers")));
  EXPECT_THAT(hydro::io::read_text(folder / "t.csv"), AllOf(HasSubstr("tow_5.csv,"), HasSubstr(",cd_median,")));
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

}  // namespace
}  // namespace fit_test
