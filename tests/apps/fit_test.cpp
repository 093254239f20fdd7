// `froude fit` through the function that main.cpp calls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "froude/commands.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace fit_test {
namespace {

using hydro::InputError;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::filesystem::path examples = std::filesystem::path(FROUDE_SOURCE_DIR) / "examples/fit";

class Fit : public testing::Test {
 protected:
  Fit() {
    std::string name = (std::filesystem::temp_directory_path() / "froude-test-XXXXXX").string();
    folder = ::mkdtemp(name.data());
  }
  ~Fit() override { std::filesystem::remove_all(folder); }

  std::string told(const froude::FitArguments& arguments, bool json = false) {
    std::ostringstream out, err;
    froude::fit(arguments, {out, err, json});
    return out.str();
  }
  /// The example with one text replaced, its data beside it.
  std::filesystem::path changed(const std::string& scene, const std::string& from, const std::string& to) {
    std::string text = hydro::io::read_text(examples / scene);
    text.replace(text.find(from), from.size(), to);
    using Options = std::filesystem::copy_options;
    std::filesystem::copy(examples, folder, Options::recursive | Options::overwrite_existing);
    hydro::io::write_atomically(folder / "changed.toml", text);
    return folder / "changed.toml";
  }

  std::filesystem::path folder;
};

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
  EXPECT_THAT(text, AllOf(HasSubstr("quadratic"), HasSubstr("1/rad"), HasSubstr("AICc")));
  EXPECT_THAT(hydro::io::read_text(folder / "d.toml"),
              AllOf(HasSubstr("[coefficients]"), HasSubstr("[run.quadratic]")));
  EXPECT_THAT(hydro::io::read_text(folder / "d.svg"), HasSubstr("residual"));
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
  for (const auto& s : j["signal"]) EXPECT_NEAR(s["rms"].get<double>(), 0.01, 0.0015);  // the noise, and nothing else
  EXPECT_NEAR(j["samples_in_band"].get<double>(), 0.95, 0.03);                          // 600 samples: three deviations
  for (const auto& s : j["signal"])
    EXPECT_LT(s["widest_band_of_fit"].get<double>(), s["widest_band_of_sample"].get<double>());
  EXPECT_THAT(hydro::io::read_text(folder / "p.svg"), HasSubstr("95 % band of the fit"));
  EXPECT_THAT(hydro::io::read_text(folder / "p.toml"), HasSubstr("line_damping_linear = \"0.00"));
}

TEST_F(Fit, OfASceneSaysWhichKeyItCannotFind) {
  EXPECT_THAT([&] { told({.scene = changed("pendulums.toml", "damping.linear", "damping.linaer")}); },
              ThrowsMessage<InputError>(HasSubstr("did you mean \"linear\"?")));
  EXPECT_THAT([&] { told({.scene = changed("pendulums.toml", "chain.link2", "chain.link3")}); },
              ThrowsMessage<InputError>(HasSubstr("chain.link3.polar")));
  EXPECT_THAT([&] { told({.scene = changed("pendulums.toml", "0.6 deg", "0.6 m")}); },
              ThrowsMessage<InputError>(HasSubstr("an angle is needed")));
}

}  // namespace
}  // namespace fit_test
