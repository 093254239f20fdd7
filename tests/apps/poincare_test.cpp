// `froude poincare` through the function that main.cpp calls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "froude/commands.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"

namespace poincare_command_test {
namespace {

using froude::PoincareArguments;
using hydro::InputError;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A turn in 8 s on a circle, forty samples a turn; the angle in degrees.
class SectionCommand : public testing::Test {
 protected:
  SectionCommand() {
    std::string name = (std::filesystem::temp_directory_path() / "froude-test-XXXXXX").string();
    folder = ::mkdtemp(name.data());
    std::vector<double> time, x, angle, rate;
    for (int j = 0; j < 400; ++j) {
      const double t = 0.2 * j, phase = 2 * std::numbers::pi / 8 * t;
      time.push_back(t);
      x.push_back(3 * std::cos(phase));
      angle.push_back(0.5 * std::sin(phase));
      rate.push_back(0.5 * std::numbers::pi / 4 * std::cos(phase));
    }
    hydro::io::write_csv(folder / "r.csv",
                         {{"time", "s", &time}, {"x", "m", &x}, {"angle", "deg", &angle}, {"rate", "rad/s", &rate}});
    arguments = {.file = folder / "r.csv", .x = "angle", .y = "rate"};
  }
  ~SectionCommand() override { std::filesystem::remove_all(folder); }
  nlohmann::json json() {
    std::ostringstream out, err;
    froude::poincare(arguments, {out, err, true});
    return nlohmann::json::parse(out.str());
  }
  std::filesystem::path folder;
  PoincareArguments arguments;
};

TEST_F(SectionCommand, GivesThePointsWhereALevelIsCrossed) {
  arguments.at = "x";
  arguments.level = "150 cm";  // cos = ½, falling at a sixth of a turn
  arguments.through = "down";
  arguments.from = "20 s";
  arguments.output = folder / "poincare.csv";
  arguments.picture = folder / "poincare.svg";
  const auto j = json();
  EXPECT_EQ(j["points"], 7);
  EXPECT_NEAR(j["time_s"][0], 24 + 8.0 / 6, 1e-5);
  for (const double v : j["x"]["values"]) EXPECT_NEAR(v, 0.5 * std::sqrt(0.75), 1e-6);
  const auto table = hydro::io::CsvTable::read(folder / "poincare.csv");
  EXPECT_NEAR(table.column("rate").at(3), 0.25 * std::numbers::pi / 4, 1e-6);
  EXPECT_LT(table.column("rate.error").at(3), 1e-4);
  EXPECT_TRUE(std::filesystem::exists(folder / "poincare.svg"));
}

TEST_F(SectionCommand, GivesThePointsOfOneInstantOfEachPeriod) {
  arguments.every = "8 s";
  arguments.from = "10 s";
  const auto j = json();
  EXPECT_EQ(j["points"], 9);
  for (const double v : j["x"]["values"]) EXPECT_NEAR(v, 0.5, 1e-6);
  for (const double v : j["y"]["values"]) EXPECT_NEAR(v, 0, 1e-6);
}

TEST_F(SectionCommand, LeavesOutFullTurnsOnRequest) {
  arguments = {.file = folder / "turns.csv", .x = "angle", .y = "time2", .every = "8 s", .wrap = true};
  std::vector<double> time, angle;
  for (int j = 0; j < 100; ++j) {
    time.push_back(0.4 * j);
    angle.push_back(1 + 2 * std::numbers::pi * 0.05 * j);  // a turn in 8 s
  }
  hydro::io::write_csv(arguments.file, {{"time", "s", &time}, {"angle", "rad", &angle}, {"time2", "s", &time}});
  const auto j = json();
  EXPECT_EQ(j["points"], 4);  // that at 0 s is left out
  for (const double v : j["x"]["values"]) EXPECT_NEAR(v, 1, 1e-9);
  EXPECT_NEAR(j["y"]["values"][3], 32, 1e-9);
}

TEST_F(SectionCommand, SaysWhatIsWrong) {
  const auto refuses = [&](const std::string& what) {
    EXPECT_THAT([&] { json(); }, ThrowsMessage<InputError>(HasSubstr(what)));
  };
  refuses("give --at with --level, or --every");
  arguments.at = "x";
  refuses("needs a --level");
  arguments.level = "1 s";
  refuses("--level");
  arguments.level = "4 m";
  refuses("no point of the record lies where x rises through 4 m");
  arguments.at = "xx";
  refuses("did you mean \"x\"?");
  arguments.at.reset(), arguments.level.reset();
  arguments.every = "8 s";
  arguments.y = "rat";
  refuses("did you mean \"rate\"?");
}

}  // namespace
}  // namespace poincare_command_test
