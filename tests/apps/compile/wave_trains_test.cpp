// Regular waves that take turns, in scenes. (W102)
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "answers/simulate.hpp"
#include "compile/waves.hpp"
#include "scenes.hpp"
#include "support/refused.hpp"
#include "support/scratch.hpp"

namespace wave_trains_test {
namespace {

using namespace froude;
using support::refused;
using testing::AllOf;
using testing::HasSubstr;

constexpr double pi = std::numbers::pi, long_period = 7, short_period = 4, change = 30, fade = 30;

/// The surface where the trains are given: 0.4 m high, then 0.3 m.
double given(double t) {
  const double share = (1 - std::cos(pi * std::clamp((t - change) / fade, 0.0, 1.0))) / 2;
  return (1 - share) * 0.2 * std::cos(2 * pi / long_period * t) +
         share * 0.15 * std::cos(2 * pi / short_period * t + 0.5);
}

const std::string deep =
    "schema = 1\n[water]\ndensity = \"1000 kg/m^3\"\ngravity = \"9.81 m/s^2\"\ndepth = \"infinite\"\n";

std::string trains(const std::string& second = "from = \"30 s\", fade = \"30 s\"", const std::string& more = {}) {
  return "[waves]\nkind = \"trains\"\nheading = \"0 deg\"\n" + more +
         "train = [{ height = \"0.4 m\", period = \"7 s\" }, { amplitude = \"0.15 m\", period = \"4 s\", phase = \"0.5 "
         "rad\", " +
         second + " }]\n";
}
const std::string ask_waves =
    "[[probe]]\nat = \"(0, 0, 0) m\"\n[ask]\nwaves = { duration = \"90 s\", every = \"0.5 s\" }\n";

std::string body(const std::string& frequencies) {
  return froude_test::floating_cylinder(frequencies) + "[ask]\nrun = { duration = \"90 s\", every = \"0.5 s\" }\n";
}

// Two trains of 0.2 and 0.15 m, of each of which two tenths of the accuracy, 1e-2, are left out at most.
TEST(WavesInTurn, AreWhatTheyAreSaidToBeWhereTheyAreGiven) {
  const auto sea = compile::make_sea(
      froude_test::parse(deep + trains("from = \"30 s\", fade = \"30 s\"", "at = \"(20, 5, 0) m\"\n") + ask_waves));
  for (double t = 0; t <= 90; t += 0.7) EXPECT_NEAR(sea.elevation(t, 20, -3), given(t), 2e-3 * 0.35) << t;
}

// The second of two trains goes across: where both are given it is there, along its heading late by the group velocity.
TEST(WavesInTurn, GoTheirOwnWays) {
  const auto sea = compile::make_sea(
      froude_test::parse(deep + trains("from = \"30 s\", fade = \"30 s\", heading = \"90 deg\"") + ask_waves));
  const double k = std::pow(2 * pi / short_period, 2) / 9.81;
  EXPECT_NEAR(sea.elevation(85, 37, 0), given(85), 1e-3);
  EXPECT_NEAR(sea.elevation(85, 0, 2), 0.15 * std::cos(2 * pi / short_period * 85 + 0.5 - 2 * k), 1e-3);
  for (const double t : {50.0, 60.0}) EXPECT_LT(std::abs(sea.elevation(t, 37, 90)), 0.2) << "not there yet";
}

/// What a gauge at the origin would have recorded of the trains, from long before the run until after it.
std::filesystem::path record() {
  const auto path = support::scratch_folder() / "trains.csv";
  std::ofstream file(path);
  file << "time [s],elevation [m]\n";
  for (int i = 0; i <= 1500; ++i) {
    const double t = -100 + 0.2 * i;
    file << fmt::format("{:.10g},{:.17g}\n", t, given(t));
  }
  return path;
}

// Trains and the record of their surface are cut in different ways: by closed forms about each frequency, and by the
// samples of all. Both leave out less than 2e-3 of the surface; what is near a resonance counts up to twice.
TEST(WavesInTurn, MoveABodyAsTheRecordOfTheirSurface) {
  const std::string floating = body("0.2 rad/s .. 4 rad/s, 39 values");
  const auto given_trains = simulate(froude_test::parse(deep + trains() + floating));
  const auto recorded = simulate(froude_test::parse(
      deep + "[waves]\nkind = \"record\"\nheading = \"0 deg\"\nfile = \"" + record().string() +
      "\"\ngauge = \"(0, 0, 0) m\"\nlowest = \"0.2 rad/s\"\nhighest = \"4 rad/s\"\ntaper = \"30 s\"\n" + floating));
  ASSERT_EQ(given_trains.stopped, "");
  for (const char* mode : {"b.surge", "b.heave", "b.pitch"}) {
    double largest = 0;
    for (const double x : recorded.signal(mode)) largest = std::max(largest, std::abs(x));
    ASSERT_GT(largest, 1e-3) << mode;
    for (std::size_t i = 0; i < recorded.time.size(); ++i)
      ASSERT_NEAR(given_trains.signal(mode)[i], recorded.signal(mode)[i], 5e-3 * largest)
          << mode << " at " << recorded.time[i];
  }
}

TEST(WavesInTurn, AreRefusedWhereDataOrTheSceneDoNotHaveThem) {
  const auto refuses = [](const std::string& waves, const testing::Matcher<std::string>& message) {
    EXPECT_THAT(refused([&] { compile::make_sea(froude_test::parse(deep + waves + ask_waves)); }), message);
  };
  refuses("[waves]\nkind = \"trains\"\nheading = \"0 deg\"\ntrain = [{ height = \"0.4 m\", period = \"7 s\" }]\n",
          HasSubstr("fewer than two trains"));
  refuses(trains("from = \"30 s\""), HasSubstr("needs the key \"fade\""));
  refuses(trains("from = \"80 s\", fade = \"30 s\""), AllOf(HasSubstr("whole at 110 s"), HasSubstr("90 s")));
  refuses(trains("from = \"30 s\", fade = \"30 s\"", "at = \"(0, 0, -1) m\"\n"),
          HasSubstr("above or below still water"));
  refuses(trains("from = \"30 s\", fade = \"30 s\" }, { height = \"0.1 m\", period = \"5 s\", from = \"50 s\", fade = "
                 "\"5 s\""),
          HasSubstr("before the train before it is whole, at 60 s"));
  refuses(trains() + "[current]\nvelocity = \"(0.5, 0, 0) m/s\"\n", HasSubstr("without a current"));
  std::string high = trains();
  high.replace(high.find("0.15 m"), 6, "2.15 m");
  refuses(high, HasSubstr("beyond breaking"));
  std::string early = trains();
  early.insert(early.find("period = \"7 s\""), "from = \"1 s\", fade = \"1 s\", ");
  refuses(early, HasSubstr("has always been there"));
  // A fade of 3 s is as wide as the frequencies themselves; one of 30 s is not.
  const auto within = [](const std::string& over) {
    const auto scene = froude_test::parse(deep + trains("from = \"30 s\", fade = \"" + over + "\"") + ask_waves);
    return refused([&] { compile::make_sea(scene, compile::Band{0.5, 2.5}); });
  };
  EXPECT_THAT(within("3 s"),
              AllOf(HasSubstr("of its amplitude while it comes or goes"), HasSubstr("0.5 to 2.5 rad/s")));
  EXPECT_EQ(within("30 s"), "nothing was refused");
}

}  // namespace
}  // namespace wave_trains_test
