// Records that sensors, gaps or a drift have spoilt, before `froude extremes`, `fatigue`, `prepare` and `psd` use them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "froude/commands.hpp"
#include "froude/record_looks.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/io/csv.hpp"
#include "support/scratch.hpp"

namespace record_looks_test {
namespace {

using hydro::InputError;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Twenty minutes of an irregular elevation at 10 Hz, about 1 m of standard deviation and a period of some 8 s.
struct Sea {
  std::vector<double> time, height;
  Sea() {
    const hydro::RandomStream random(3, 1);
    for (std::size_t j = 0; j < 12000; ++j) {
      time.push_back(0.1 * static_cast<double>(j));
      double sum = 0;
      for (std::size_t k = 0; k < 60; ++k) {
        const double hz = 0.09 + 0.0011 * static_cast<double>(k);
        sum += 0.18 * std::cos(2 * std::numbers::pi * (hz * time.back() + random.uniform(k)));
      }
      height.push_back(sum);
    }
  }
};

std::filesystem::path file_of(const char* name, const std::vector<double>& time, const std::vector<double>& height) {
  const auto path = support::scratch_folder() / name;
  hydro::io::write_csv(path, {{"time", "s", &time}, {"h", "m", &height}});
  return path;
}

nlohmann::json extremes_of(const froude::ExtremesArguments& arguments) {
  std::ostringstream out, err;
  froude::extremes(arguments, {out, err, true});
  return nlohmann::json::parse(out.str());
}

nlohmann::json fatigue_of(const froude::FatigueArguments& arguments) {
  std::ostringstream out, err;
  froude::fatigue(arguments, {out, err, true});
  return nlohmann::json::parse(out.str());
}

TEST(RecordsAtTheirStop, AreRefusedUnlessTakenByName) {
  Sea sea;
  for (double& h : sea.height) h = std::min(h, 1.5);
  const auto file = file_of("clipped.csv", sea.time, sea.height);
  EXPECT_THAT([&] { extremes_of({.file = file, .signal = "h"}); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("h stands at 1.5 m"), HasSubstr("--accept stop"))));
  EXPECT_THAT([&] { fatigue_of({.file = file, .signal = "h"}); },
              ThrowsMessage<InputError>(HasSubstr("h stands at 1.5 m")));
  EXPECT_THAT([&] { fatigue_of({.file = file, .signal = "h", .accept = {"stops"}}); },
              ThrowsMessage<InputError>(HasSubstr("what can be accepted: stop")));
  const auto accepted = fatigue_of({.file = file, .signal = "h", .accept = {"stop"}});
  EXPECT_THAT(accepted["cautions"].dump(), HasSubstr("stands at 1.5 m"));
  // Lowest values are free of that stop.
  EXPECT_NO_THROW(extremes_of({.file = file, .signal = "h", .lowest = true}));
}

TEST(RecordsAtTheirStop, AreToldWithoutAnyStepToo) {
  Sea sea;
  for (double& h : sea.height) h = std::min(h, 1.5);
  const auto file = file_of("clipped_told.csv", sea.time, sea.height);
  std::ostringstream out, err;
  froude::psd({.file = file}, {out, err});
  froude::prepare({.file = file, .output = support::scratch_folder() / "clipped_prepared.csv"}, {out, err});
  const std::string told = out.str(), sentence = "h stands at 1.5 m";
  EXPECT_NE(told.find(sentence), told.rfind(sentence)) << told;  // both commands
}

// A cosine whose period is forty samples has its crest in the record to the last digit, once a wave.
TEST(RecordsAtTheirStop, AreNotThoseWhoseSamplesMeetEachCrest) {
  std::vector<double> time, height;
  for (int j = 0; j < 4000; ++j) {
    time.push_back(0.2 * j);
    height.push_back(j % 40 == 0 ? 1.5 : 1.5 * std::cos(2 * std::numbers::pi * j / 40.0));
  }
  EXPECT_TRUE(froude::cautions_of_stops(std::vector<froude::Signal>{{"h", "m", "h", height}}).empty());
}

// A line that is slack has exactly no tension, which is no stop of a load cell.
TEST(RecordsAtTheirStop, AreNotThoseOfASlackLine) {
  Sea sea;
  for (double& h : sea.height) h = std::max(h, 0.0);
  EXPECT_NO_THROW(fatigue_of({.file = file_of("slack.csv", sea.time, sea.height), .signal = "h"}));
}

// Half of the waves in half of the time do as much an hour, wherever the recorder was off.
TEST(GapsInRecords, AreNoTimeThatWasMeasured) {
  const Sea sea;
  std::vector<double> gappy, joined, height;
  for (std::size_t j = 0; j < sea.time.size(); ++j) {
    if (sea.time[j] > 300 && sea.time[j] < 900) continue;
    gappy.push_back(sea.time[j]);
    joined.push_back(0.1 * static_cast<double>(joined.size()));
    height.push_back(sea.height[j]);
  }
  const froude::SnArguments sn{.range = "1 m", .cycles = 1e6, .slope = 3};
  const auto with_gap = fatigue_of({.file = file_of("gap.csv", gappy, height), .signal = "h", .sn = sn}),
             without = fatigue_of({.file = file_of("joined.csv", joined, height), .signal = "h", .sn = sn});
  // One sample more or less of 6000 ends the measured time.
  EXPECT_NEAR(with_gap["damage_per_hour"].get<double>() / without["damage_per_hour"].get<double>(), 1, 1e-3);
  EXPECT_THAT(with_gap["cautions"].dump(), HasSubstr("1 gap in the record, 599.9 s in all"));
  const auto largest = extremes_of({.file = file_of("gap.csv", gappy, height), .signal = "h"}),
             as_joined = extremes_of({.file = file_of("joined.csv", joined, height), .signal = "h"});
  EXPECT_NEAR(largest["recorded_s"].get<double>(), as_joined["recorded_s"].get<double>(), 0.11);  // one sample
  EXPECT_NEAR(largest["estimates"][0]["level"].get<double>(), as_joined["estimates"][0]["level"].get<double>(), 1e-3);
}

// Two rates of one logger are two rates, and a single sample that is late is no gap.
TEST(GapsInRecords, AreLongerThanTheStepsAroundThem) {
  std::vector<double> time;
  for (int j = 0; j < 200; ++j) time.push_back(0.1 * j);
  for (int j = 0; j < 200; ++j) time.push_back(time.back() + (j == 100 ? 1.3 : 0.5));
  const auto measured = froude::measured_time(time);
  EXPECT_EQ(measured.gaps, 0u);
  EXPECT_EQ(measured.time, time);
}

TEST(RecordsThatDrift, HaveNoLargestValuesUntilTheDriftIsOff) {
  Sea sea;
  for (std::size_t j = 0; j < sea.time.size(); ++j) sea.height[j] += 0.01 * sea.time[j];
  const auto file = file_of("drift.csv", sea.time, sea.height);
  EXPECT_THAT([&] { extremes_of({.file = file, .signal = "h"}); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("h drifts by"), HasSubstr("--detrend"))));
  EXPECT_NO_THROW(extremes_of({.file = file, .signal = "h", .steps = {.detrend = true}}));
  EXPECT_NO_THROW(extremes_of({.file = file, .signal = "h", .accept = {"drift", "tail"}}));
}

// 400 peaks spread evenly from 1 m to 2 m end at 2 m, and no law that has them has the one of 2.6 m.
TEST(LawsOfPeaks, HoldTheLargestThatTheRecordHolds) {
  std::vector<double> time, height;
  for (int i = 0; i < 400 * 20; ++i) {
    time.push_back(i);
    const double amplitude = i / 20 == 200 ? 2.6 : 1 + 0.0025 * (i / 20 * 37 % 400);
    height.push_back(std::sin(2 * std::numbers::pi * i / 20) * amplitude);
  }
  const auto file = file_of("one_peak.csv", time, height);
  EXPECT_THAT([&] { extremes_of({.file = file, .signal = "h", .threshold = "1.5 m"}); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("of 7999 s holds 2.6 m"), HasSubstr("--outliers"))));
  EXPECT_NO_THROW(extremes_of({.file = file, .signal = "h", .threshold = "1.5 m", .accept = {"tail"}}));
}

}  // namespace
}  // namespace record_looks_test
