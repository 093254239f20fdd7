// Scenes by the library: read once, changed by typed parameters, answered with values.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "froude/scene.hpp"
#include "hydro/base/error.hpp"
#include "support/source_dir.hpp"

namespace froude_test::library {
namespace {

using testing::HasSubstr;

/// A folder of its own, gone with the test.
class TempDir {
 public:
  TempDir() : path_(std::filesystem::temp_directory_path() / fmt::format("froude-library-{}", ::getpid())) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TempDir() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

constexpr const char* mass_on_a_spring = R"(schema = 1
[water]
density = "1025 kg/m^3"
depth = "infinite"
[[body]]
name = "block"
mass = "100 kg"
free = "surge"
initial = { surge = "20 cm" }
[[mooring]]
on = "block"
kind = "linear"
stiffness = { surge = "400 N/m" }
[ask]
run = { duration = "10 s", every = "0.01 s" }
modes = {}
)";

std::string error_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const hydro::InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Library, AnswersAScene) {
  const froude::Scene scene = froude::parse(mass_on_a_spring);
  const froude::Run run = scene.run();
  const auto& surge = run.signal("block.surge");
  // ω = √(400/100) = 2 rad/s; the step's period error of (ωh)²/12 leaves 2e-3 of the amplitude after 10 s.
  for (std::size_t i = 0; i < run.time.size(); ++i) ASSERT_NEAR(surge[i], 0.2 * std::cos(2 * run.time[i]), 1e-3);
  EXPECT_NEAR(scene.modes().omega.front(), 2, 1e-9);
  EXPECT_THAT(scene.plan().sections.front().title, HasSubstr("modes"));
  EXPECT_TRUE(run.warnings().empty());
}

TEST(Library, ChangesANumberThroughItsParameter) {
  const froude::Scene scene = froude::parse(mass_on_a_spring);
  const froude::Parameter mass = scene.parameter("body.block.mass"), start = scene.parameter("body.initial.surge");
  EXPECT_EQ(mass.value, 100);
  EXPECT_EQ(mass.unit, "kg");
  EXPECT_EQ(start.unit, "cm");
  const froude::Scene changed = scene.with(mass, 400).with(start, 50);
  EXPECT_NEAR(changed.modes().omega.front(), 1, 1e-9);
  EXPECT_NEAR(changed.run().signal("block.surge").front(), 0.5, 1e-12);
  EXPECT_EQ(changed.parameter("body.block.mass").value, 400);
  EXPECT_NEAR(scene.modes().omega.front(), 2, 1e-9);  // that one is as it was
  EXPECT_THAT(error_of([&] { scene.with(mass, -1); }), HasSubstr("must be positive"));
  EXPECT_THAT(error_of([&] { scene.parameter("body.block.mas"); }), HasSubstr("did you mean \"mass\"?"));
}

TEST(Library, ChangesValuesOfAnyKindInScenesOfBothKinds) {
  const froude::Scene scene = froude::parse(mass_on_a_spring);
  const froude::Scene changed = scene.with({{"body.block.mass", std::string("0.4 t")}, {"ask.run.duration", 2.0}});
  EXPECT_NEAR(changed.modes().omega.front(), 1, 1e-9);
  EXPECT_NEAR(changed.run().time.back(), 2, 1e-9);
  EXPECT_EQ(changed.parameter("body.block.mass").unit, "t");
  EXPECT_THAT(error_of([&] { scene.with({{"body.block.mas", 400.0}}); }), HasSubstr("did you mean \"mass\"?"));

  const froude::Scene fit = froude::read(source_dir() / "examples/fit/oscillation.toml");
  const auto interval = [](const froude::Scene& s) { return s.fit().find("cd")->coefficient.interval; };
  const auto narrow = interval(fit.with({{"ask.intervals.level", 0.5}})), wide = interval(fit);
  EXPECT_LT(narrow.high - narrow.low, 0.5 * (wide.high - wide.low));
}

TEST(Library, KeepsCoefficientsThatAChangeLeavesAlone) {
  const TempDir folder;
  std::filesystem::copy_file(source_dir() / "examples/pontoon5.toml", folder.path() / "pontoon5.toml");
  std::filesystem::copy(source_dir() / "examples/data", folder.path() / "data",
                        std::filesystem::copy_options::recursive);
  const froude::Scene scene = froude::read(folder.path() / "pontoon5.toml");
  const froude::Responses before = scene.rao();
  std::filesystem::remove_all(folder.path() / "data");
  const froude::Responses again = scene.with(scene.parameter("ask.accuracy"), 0.02).rao();
  EXPECT_EQ(again.signal("m3.heave").values, before.signal("m3.heave").values);
  EXPECT_NE(error_of([&] { froude::read(folder.path() / "pontoon5.toml").rao(); }), "");
}

TEST(Library, WritesWhatTheProgramWrites) {
  const TempDir folder;
  froude::parse(mass_on_a_spring).run().write(folder.path() / "run.h5");
  const auto read = froude::read_run(folder.path() / "run.h5");
  EXPECT_EQ(read.time.size(), 1001);
  EXPECT_THAT(read.signals.front().name, HasSubstr("block.surge"));
}

TEST(Library, PacksTheNumbersOfAResultUnlessTheSceneSaysOtherwise) {
  const TempDir folder;
  const auto written = [&](const std::string& name, const std::string& end) {
    std::string text = mass_on_a_spring;
    text.replace(text.find("0.01 s"), 6, "0.001 s");  // what is short is never packed
    const auto path = folder.path() / name;
    froude::parse(text + end).run().write(path);
    return path;
  };
  const auto packed = written("packed.h5", ""), plain = written("plain.h5", "uncompressed = true\n");
  const auto one = froude::read_run(packed), other = froude::read_run(plain);
  ASSERT_EQ(one.signals.size(), other.signals.size());
  for (std::size_t i = 0; i < one.signals.size(); ++i) EXPECT_EQ(one.signals[i].values, other.signals[i].values);
  const std::uintmax_t numbers = 8 * one.time.size() * (1 + one.signals.size());
  EXPECT_GE(file_size(plain), numbers);
  EXPECT_LT(file_size(packed), numbers) << "times at least, which are even, and signals that are zero";
}

TEST(Library, FitsWhatAModelAsks) {
  const auto report = froude::read(source_dir() / "examples/fit/oscillation.toml").fit();
  ASSERT_FALSE(report.refused);
  EXPECT_NEAR(*report.find("cd")->coefficient.value, 1.2, 0.1);  // what the data were made with, docs/guide/fit.md
}

TEST(Library, SaysWhatASceneDoesNotAskFor) {
  const froude::Scene scene = froude::parse(mass_on_a_spring);
  EXPECT_THAT(error_of([&] { scene.rao(); }), HasSubstr("does not ask for RAOs"));
  EXPECT_THAT(error_of([&] { scene.waves(); }), HasSubstr("does not ask for waves"));
  EXPECT_THAT(error_of([&] { scene.fit(); }), HasSubstr("asks for motion, not for a fit"));
  const froude::Scene fit = froude::read(source_dir() / "examples/fit/oscillation.toml");
  EXPECT_THAT(error_of([&] { fit.run(); }), HasSubstr("asks for a fit, not for motion"));
}

}  // namespace
}  // namespace froude_test::library
