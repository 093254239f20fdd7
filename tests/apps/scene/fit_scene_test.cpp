#include <filesystem>
#include <fstream>

#include "apps/scene/scenes.hpp"

namespace froude::scene {
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

  fs::path folder_ = fs::path(testing::TempDir()) /
                     (std::string("fit_scenes_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(FitScenes, AreReadInSi) {
  const FitScene scene = read(oscillation);
  ASSERT_EQ(scene.files.size(), 2u);
  EXPECT_EQ(scene.files[0].value.filename(), "a.csv");
  EXPECT_TRUE(scene.files[0].value.is_absolute());
  EXPECT_EQ(scene.channels, (std::map<std::string, std::string>{{"time", "t"}, {"force", "F"}, {"velocity", "u"}}));
  EXPECT_EQ(scene.model.kind, "morison");
  EXPECT_EQ(scene.model.motion, "body moves");
  EXPECT_EQ(scene.model.length, 0.5);
  EXPECT_EQ(scene.model.mass_beyond_load_cells, 5.9);
  EXPECT_EQ(scene.model.viscosity, 1.05e-6);
  EXPECT_EQ(scene.coefficients, (std::vector<std::string>{"cd", "ca"}));
  EXPECT_EQ(scene.confidence, 0.95);
  EXPECT_EQ(scene.echo.back().key, "ask.intervals.level");
  EXPECT_TRUE(scene.echo.back().defaulted);
  const FitScene towed = read(towing);
  EXPECT_EQ(towed.channels.size(), 3u);
  EXPECT_EQ(towed.confidence, 0.9);
  EXPECT_FALSE(towed.model.viscosity);
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
              AllOf(StartsWith("fit.toml:4:47: "), HasSubstr("has no part in a fit of kind \"morison\"")));
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
}  // namespace froude::scene
