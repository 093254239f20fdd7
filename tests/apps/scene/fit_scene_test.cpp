#include <cmath>
#include <filesystem>
#include <fstream>

#include "answers/fit_models.hpp"
#include "answers/fit_scene.hpp"
#include "apps/scene/scenes.hpp"
#include "support/scratch.hpp"

namespace froude::scene::fit_scene_test {
namespace {

namespace fs = std::filesystem;

const std::string oscillation = R"(schema = 1
[data]
files = "runs/*.csv"
channels = { time = "t", force = "F", velocity = "u" }
[model]
kind = "morison"
diameter = "0.12 m"
length = "50 cm"
motion = "body moves"
mass_beyond_load_cells = "5.9 kg"
water = { density = "997 kg/m^3", viscosity = "1.05e-6 m^2/s" }
[ask]
coefficients = ["cd", "ca"]
)";

const std::string towing = R"(schema = 1
[data]
files = "runs/b.csv"
channels = { speed = "U", force = "F", force_sd = "sF" }
[model]
kind = "towing"
diameter = "0.12 m"
length = "0.5 m"
water = { density = "997 kg/m^3" }
[ask]
coefficients = "cd"
intervals = { level = 0.9 }
)";

/// A folder with runs/a.csv and runs/b.csv, gone after the test.
class FitScenes : public testing::Test {
 protected:
  FitScenes() {
    fs::create_directories(folder_ / "runs");
    for (const char* name : {"b.csv", "a.csv", "note.txt"}) std::ofstream(folder_ / "runs" / name) << "t\n";
  }
  ~FitScenes() override { fs::remove_all(folder_); }
  FitScenes(const FitScenes&) = delete;
  FitScenes& operator=(const FitScenes&) = delete;

  FitScene read(const std::string& text) const { return parse_fit(text, folder_ / "fit.toml"); }
  std::string refused(const std::string& text) const {
    try {
      read(text);
    } catch (const hydro::InputError& error) {
      EXPECT_FALSE(error.where().text.empty());
      return std::string(error.what()).substr((folder_ / "").string().size());
    }
    ADD_FAILURE() << "was accepted:\n" << text;
    return {};
  }

  fs::path folder_ = support::scratch_folder() /
                     (std::string("fit_scenes_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(FitScenes, AreReadInSi) {
  const FitScene scene = read(oscillation);
  ASSERT_EQ(scene.files.size(), 2u);
  EXPECT_EQ(scene.files[0].value.filename(), "a.csv");
  EXPECT_TRUE(scene.files[0].value.is_absolute());
  EXPECT_EQ(scene.channels, (std::map<std::string, std::string>{{"time", "t"}, {"velocity", "u"}}));
  ASSERT_EQ(scene.force.size(), 1u);
  EXPECT_EQ(scene.force[0].column, "F");
  EXPECT_EQ(scene.kind(), "morison");
  const auto& model = scene.model<MorisonModel>();
  EXPECT_EQ(model.cylinder.experiment, fit::Experiment::body_moves);
  EXPECT_EQ(model.cylinder.length, 0.5);
  EXPECT_EQ(model.cylinder.mass_beyond_load_cells, 5.9);
  EXPECT_EQ(model.cylinder.viscosity, 1.05e-6);
  EXPECT_EQ(model.coefficients, (std::vector<std::string>{"cd", "ca"}));
  EXPECT_EQ(scene.confidence, 0.95);
  EXPECT_EQ(scene.echo.back().key, "ask.intervals.method");
  EXPECT_TRUE(scene.echo.back().defaulted);
  const FitScene towed = read(towing);
  EXPECT_EQ(towed.channels.size(), 2u);
  EXPECT_EQ(towed.confidence, 0.9);
  EXPECT_EQ(towed.kind(), "towing");
  EXPECT_FALSE(towed.model<TowingModel>().cylinder.viscosity);
}

TEST_F(FitScenes, FindTheirFiles) {
  EXPECT_THAT(refused(with(oscillation, "runs/*.csv", "runs/*.dat")),
              AllOf(StartsWith("fit.toml:3:9: error: [data] files: \"runs/*.dat\" is no file")));
  EXPECT_THAT(refused(with(oscillation, "runs/*.csv", "nowhere/*.csv")), HasSubstr("cannot be looked up"));
  EXPECT_THAT(refused(with(oscillation, "runs/*.csv", "*/a.csv")), HasSubstr("has a * in the name of a folder"));
  EXPECT_THAT(refused(with(oscillation, "\"runs/*.csv\"", "[\"runs/*.csv\", \"runs/a.csv\"]")), HasSubstr("twice"));
}

TEST_F(FitScenes, NeedTheChannelsOfTheirKind) {
  EXPECT_THAT(refused(with(oscillation, "time = \"t\", ", "")),
              AllOf(StartsWith("fit.toml:4:12: "), HasSubstr("needs \"time\" for a fit of kind \"morison\"")));
  EXPECT_THAT(refused(with(oscillation, ", velocity = \"u\"", "")), HasSubstr("needs velocity or position"));
  EXPECT_THAT(refused(with(oscillation, "velocity", "speed")),
              AllOf(StartsWith("fit.toml:4:47: "), HasSubstr("does not apply to a fit of kind \"morison\"")));
  EXPECT_THAT(refused(with(oscillation, "velocity = \"u\"", "velocity = \"u\", position = \"x\"")),
              HasSubstr("position = \"x\" does not act beside the velocity"));
  EXPECT_THAT(refused(with(towing, "speed = \"U\", ", "")), HasSubstr("needs \"speed\""));
  EXPECT_THAT(refused(with(oscillation, "force", "forse")), HasSubstr("did you mean \"force\"?"));
}

TEST_F(FitScenes, KnowWhereMassActs) {
  EXPECT_THAT(refused(with(oscillation, "body moves", "water moves")),
              AllOf(StartsWith("fit.toml:10:26: "), HasSubstr("the body does not move")));
  EXPECT_THAT(refused(with(oscillation, "mass_beyond_load_cells = \"5.9 kg\"\n", "")),
              AllOf(StartsWith("fit.toml:5:1: "), HasSubstr("needs \"mass_beyond_load_cells\"")));
  EXPECT_THAT(refused(with(towing, "length", "motion = \"body moves\"\nlength")),
              HasSubstr("unknown key \"motion\" in [model] of kind \"towing\""));
}

TEST_F(FitScenes, AskForCoefficientsThatExist) {
  EXPECT_THAT(refused(with(oscillation, "\"ca\"", "\"cx\"")),
              AllOf(StartsWith("fit.toml:13:23: "), HasSubstr("is not one of cd, cm, ca")));
  EXPECT_THAT(refused(with(towing, "\"cd\"", "[\"cd\", \"cm\"]")), HasSubstr("cannot come from towing"));
  EXPECT_THAT(refused(with(towing, "0.9", "95")), HasSubstr("must lie between 0 and 1"));
}

TEST_F(FitScenes, TellTheStepsOfPreparation) {
  const std::string with_steps =
      with(with(oscillation, "force = \"F\"", "force = [\"F1\", \"-F2\"]"), "[model]", R"([prepare]
longest_gap = "0.1 s"
outliers = { window = "0.2 s" }
delay = "0.73 s"
delay_error = "5 ms"
derivative_bandwidth = "2 Hz"
low_pass = { kind = "butterworth", cutoff = "3.33 Hz" }
notch = [{ centre = "50 Hz", width = "2 Hz" }]
window = { kind = "full cycles", last = 5 }
[model]
uncertainty = { diameter = "0.5 mm", mass = "50 g" })");
  const FitScene scene = read(with_steps);
  ASSERT_EQ(scene.force.size(), 2u);
  EXPECT_FALSE(scene.force[0].turned);
  EXPECT_EQ(scene.force[1].column, "F2");
  EXPECT_TRUE(scene.force[1].turned);
  const auto& model = scene.model<MorisonModel>();
  const auto& p = model.prepare;
  EXPECT_EQ(p.delay_s, 0.73);
  EXPECT_EQ(model.force.delay_error_s, 0.005);
  EXPECT_NEAR(p.derivative_bandwidth_hz, 2, 1e-12);
  ASSERT_EQ(p.filters.size(), 2u);
  EXPECT_EQ(p.filters[0].kind, fit::FilterChoice::Kind::notch);
  EXPECT_NEAR(p.filters[0].width, 2, 1e-12);
  EXPECT_EQ(p.filters[1].order, 4);
  EXPECT_NEAR(p.filters[1].hz, 3.33, 1e-12);
  EXPECT_EQ(p.window.kind, fit::WindowChoice::Kind::full_cycles);
  EXPECT_EQ(p.window.cycles, 5);
  EXPECT_EQ(p.outlier_deviations, 8);
  EXPECT_EQ(model.force.cylinder_errors.diameter, 0.0005);
  EXPECT_EQ(model.force.cylinder_errors.mass, 0.05);
  EXPECT_THAT(refused(with(with_steps, "delay = \"0.73 s\"", "delay = \"estimate\"")), HasSubstr("delay_error"));
  EXPECT_THAT(refused(with(with_steps, "delay = \"0.73 s\"\ndelay_error = \"5 ms\"", "delay = \"estimate\"")),
              HasSubstr("needs \"longest_delay\""));
  EXPECT_THAT(refused(with(with_steps, "cutoff = \"3.33 Hz\"", "cutoff = \"3.33 Hz\", order = 40")),
              HasSubstr("must lie between 1 and 10"));
  EXPECT_THAT(refused(with(towing, "[model]", "[prepare]\ndelay = \"1 s\"\n[model]")), HasSubstr("does not apply"));
}

TEST_F(FitScenes, OfDecayKnowTheirOwnKeys) {
  const std::string decay = R"(schema = 1
[data]
files = "runs/a.csv"
channels = { time = "t", angle = "roll" }
[model]
kind = "decay"
restoring = "sine"
[ask]
coefficients = ["linear", "coulomb"]
profile = true
)";
  const FitScene scene = read(decay);
  EXPECT_EQ(scene.kind(), "decay");
  EXPECT_TRUE(scene.model<DecayModel>().motion.pendulum);
  EXPECT_TRUE(scene.model<DecayModel>().profile);
  EXPECT_THAT(refused(with(decay, "angle", "velocity")), HasSubstr("does not apply to a fit of kind \"decay\""));
  EXPECT_THAT(refused(with(decay, ", angle = \"roll\"", "")), HasSubstr("needs either position or angle"));
  EXPECT_THAT(refused(with(decay, "angle = \"roll\"", "position = \"z\"")),
              AllOf(HasSubstr("restoring = \"sine\" is by the sine of an angle, and the channel position is a length"),
                    HasSubstr(":7:"), HasSubstr("take restoring = \"linear\"")));
  EXPECT_THAT(refused(with(decay, "\"linear\"", "\"cd\"")), HasSubstr("a decay knows linear"));
  EXPECT_THAT(refused(with(decay, "[ask]", "[prepare]\ndelay = \"1 s\"\n[ask]")), HasSubstr("does not apply"));
  EXPECT_THAT(refused(with(decay, "[ask]", "[prepare]\nderivative_method = \"smoothing spline\"\n[ask]")),
              HasSubstr("does not apply"));
  EXPECT_THAT(refused(with(decay, "[ask]", "[prepare]\nwindow = { kind = \"full cycles\" }\n[ask]")),
              HasSubstr("must be \"span\""));
  const FitScene cut =
      read(with(decay, "[ask]",
                "[prepare]\nlongest_gap = \"1 s\"\nwindow = { kind = \"span\", from = \"3 s\", to = \"9 s\" }\n[ask]"));
  EXPECT_EQ(cut.model<DecayModel>().prepare.window.from, 3);
  EXPECT_EQ(cut.model<DecayModel>().prepare.longest_gap_s, 1);
  EXPECT_THAT(refused(with(oscillation, "\"ca\"", "\"cubic\"")),
              HasSubstr("does not apply to a fit of kind \"morison\""));
  EXPECT_THAT(refused(with(decay, "[ask]", "[ask]\ntogether = true")), HasSubstr("needs two files at least"));
  EXPECT_THAT(refused(with(oscillation, "[ask]", "[ask]\ntogether = true")), HasSubstr("does not apply"));
}

TEST_F(FitScenes, OfDecayKnowWhatAMemoryNeeds) {
  const std::string memory = R"(schema = 1
[data]
files = "runs/a.csv"
channels = { time = "t", position = "z" }
[model]
kind = "decay"
start = "in motion"
[ask]
coefficients = ["memory", "quadratic"]
)";
  const auto starts_empty = [&](const std::string& text) {
    return read(text).model<DecayModel>().memory.value().starts_empty;
  };
  EXPECT_FALSE(starts_empty(memory));
  EXPECT_TRUE(starts_empty(with(memory, "in motion", "let go from rest")));
  EXPECT_THAT(refused(with(memory, "start = \"in motion\"\n", "")), HasSubstr("needs \"start\""));
  EXPECT_THAT(refused(with(memory, "\"memory\", ", "")), HasSubstr("does not act without a memory"));
  EXPECT_THAT(refused(with(memory, "quadratic", "coulomb")), HasSubstr("may not hold coulomb"));
  EXPECT_THAT(refused(with(with(memory, "start", "restoring = \"sine\"\nstart"), "position", "angle")),
              HasSubstr("must be linear"));
}

TEST_F(FitScenes, OfFrictionNeedATorqueOrAForce) {
  const std::string friction = R"(schema = 1
[data]
files = "runs/a.csv"
channels = { time = "t", force = "-F" }
[model]
kind = "friction ramp"
ramp = "2 s"
slide = "2 s"
[ask]
)";
  EXPECT_TRUE(read(friction).force.at(0).turned);
  EXPECT_EQ(read(friction).kind(), "friction ramp");
  EXPECT_THAT(refused(with(friction, ", force = \"-F\"", "")), HasSubstr("either torque or force"));
  EXPECT_THAT(refused(with(friction, "force =", "torque = \"M\", force =")), HasSubstr("either torque or force"));
}

TEST_F(FitScenes, OfOtherKindsHoldWhatTheirFitsTake) {
  const FitScene radiation = read(R"(schema = 1
[data]
files = "runs/a.csv"
channels = { time = "t", position = "z", force = "F" }
[model]
kind = "radiation"
body = { mass = "120 kg", stiffness = "2500 N/m", stiffness_error = 0.002 }
[ask]
)");
  EXPECT_EQ(radiation.kind(), "radiation");
  EXPECT_EQ(radiation.model<RadiationModel>().body.stiffness, 2500);
  std::ofstream(folder_ / "scene.toml") << sphere;
  const FitScene motion = read(R"(schema = 1
[data]
files = "runs/a.csv"
channels = { time = "t" }
[[data.signal]]
column = "z"
of = "sphere.heave"
deviation = "1 mm"
[model]
kind = "motion"
scene = "scene.toml"
parameter = [{ key = "water.density", lowest = "900 kg/m^3" }]
[ask]
profile = true
)");
  EXPECT_EQ(motion.kind(), "motion");
  const auto& model = motion.model<MotionModel>();
  EXPECT_EQ(model.parameters.at(0).number.name, "water.density");
  EXPECT_EQ(model.parameters.at(0).number.lowest, 900);
  EXPECT_FALSE(std::isfinite(model.parameters.at(0).number.highest));
  EXPECT_TRUE(model.profile);
}

TEST_F(FitScenes, TakeTheWaterFromAProbe) {
  const std::string waves = with(with(with(oscillation, "velocity = \"u\"", "elevation = \"eta\""),
                                      "body moves\"\nmass_beyond_load_cells = \"5.9 kg\"",
                                      "water moves\"\nwave = { depth = \"1.25 m\", level = \"0.48 m\" }"),
                                 "\"ca\"", "\"cm\"");
  const FitScene scene = read(waves);
  const auto& probe = scene.model<MorisonModel>().probe;
  ASSERT_TRUE(probe);
  EXPECT_EQ(probe->level, -0.48);
  EXPECT_EQ(probe->water.depth.metres(), 1.25);
  EXPECT_EQ(probe->ahead, 0);
  EXPECT_THAT(refused(with(waves, "0.48 m", "1.48 m")), HasSubstr("lies below the bottom"));
  EXPECT_THAT(refused(with(waves, "elevation = \"eta\"", "velocity = \"u\"")),
              HasSubstr("there is no channel elevation"));
  EXPECT_THAT(refused(with(waves, "wave = { depth = \"1.25 m\", level = \"0.48 m\" }\n", "")),
              HasSubstr("needs \"wave\""));
}

TEST_F(FitScenes, NeedACalibrationForEachForce) {
  const std::string calibrated = with(oscillation, "channels", "calibration = [\"a\", \"b\"]\nchannels");
  EXPECT_THAT(refused(calibrated), HasSubstr("names 2 files for 1 force channels"));
  const FitScene scene = read(with(calibrated, "force = \"F\"", "force = [\"F\", \"G\"]"));
  EXPECT_EQ(scene.force[1].calibration->value.filename(), "b");
}

TEST_F(FitScenes, WithOneCharacterMissingAreReadOrRefusedWithTheirPlace) {
  for (const std::string* scene : {&oscillation, &towing})
    for (std::size_t i = 0; i < scene->size(); ++i) try {
        read(scene->substr(0, i) + scene->substr(i + 1));
      } catch (const hydro::InputError& error) {
        EXPECT_GT(error.where().column, 0) << error.what();
      }
}

TEST_F(FitScenes, AreToldFromScenesOfMotion) {
  std::ofstream(folder_ / "fit.toml") << oscillation;
  std::ofstream(folder_ / "scene.toml") << sphere;
  EXPECT_TRUE(is_fit(folder_ / "fit.toml"));
  EXPECT_FALSE(is_fit(folder_ / "scene.toml"));
  EXPECT_EQ(read_fit(folder_ / "fit.toml").files.size(), 2u);
  EXPECT_EQ(scene::read(folder_ / "scene.toml").bodies.size(), 1u);
  EXPECT_THAT(refused(sphere), HasSubstr("froude run"));
}

}  // namespace
}  // namespace froude::scene::fit_scene_test
