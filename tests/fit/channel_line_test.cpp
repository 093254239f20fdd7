// Lines of channels: closed forms of slope, loop, drift and steps.
#include "fit/channel_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "fit/calibration.hpp"
#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"

namespace channel_line_test {
namespace {

using fit::LinePoints;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// 0, 1 … 8, 7 … 0 references; reading 0.5 + 2 x, `loop` lower on the way up, `drift` per second, a point a minute.
LinePoints points(double loop = 0, double drift = 0, double noise = 0, std::uint64_t seed = 1) {
  LinePoints out;
  const auto e = froude_test::ar1_noise(17, 0, noise, seed);
  for (int i = 0; i < 17; ++i) {
    const double x = i <= 8 ? i : 16 - i, t = 60.0 * i;
    out.reference.push_back(x);
    out.time.push_back(t);
    out.reading.push_back(0.5 + 2 * x + (i <= 8 ? -loop / 2 : loop / 2) + drift * (t - 480) +
                          e[static_cast<std::size_t>(i)]);
  }
  return out;
}

TEST(ChannelLine, OfAnExactLineIsThatLine) {
  const auto line = fit::fit_channel_line(points());
  EXPECT_NEAR(*line.slope.value, 2, 1e-12);
  EXPECT_NEAR(*line.offset.value, 0.5, 1e-12);
  EXPECT_NEAR(line.reference(0.5 + 2 * 3.7), 3.7, 1e-12);
  EXPECT_NEAR(*line.hysteresis, 0, 1e-12);
  EXPECT_EQ(line.pairs, 8u);  // 0 to 7 from both sides, 8 from below alone
}

TEST(ChannelLine, SeesADriftApartFromTheSlope) {
  const auto line = fit::fit_channel_line(points(0, 1e-4));
  ASSERT_TRUE(line.drift && line.drift->value);
  EXPECT_NEAR(*line.drift->value, 1e-4, 1e-12);
  EXPECT_NEAR(*line.slope.value, 2, 1e-12);
  EXPECT_NEAR(*line.hysteresis, 0, 1e-10);  // without the drift, up and down would differ
  const auto none = fit::fit_channel_line(points(0, 0, 0.01, 5));
  EXPECT_FALSE(none.drift->value && std::abs(*none.drift->value) < 1e-6);
}

TEST(ChannelLine, TellsTheWidthOfALoop) {
  auto looped = points(0.04);
  looped.time.clear();  // along with time a loop looks like a drift
  const auto line = fit::fit_channel_line(looped);
  EXPECT_NEAR(*line.hysteresis * line.range, 0.04, 1e-12);
  EXPECT_FALSE(line.drift);
}

// The same formulas as the line of a load cell, (F14), where no time is given.
TEST(ChannelLine, IsThatOfALoadCell) {
  auto p = points(0.01, 0, 0.02, 3);
  p.time.clear();
  const auto line = fit::fit_channel_line(p);
  const auto cell = fit::calibrate(std::vector{fit::LoadCycle{p.reference, p.reading}});
  EXPECT_NEAR(*line.slope.value, cell.slope, 1e-12);
  EXPECT_NEAR(*line.offset.value, cell.offset, 1e-12);
  EXPECT_NEAR(line.slope.standard_error, cell.slope_error, 1e-12);
  EXPECT_NEAR(line.offset.standard_error, cell.offset_error, 1e-12);
  EXPECT_NEAR(line.nonlinearity, cell.nonlinearity, 1e-12);
  EXPECT_NEAR(*line.hysteresis, cell.hysteresis, 1e-12);
}

TEST(ChannelLine, HoldsTheTruthAsOftenAsItSays) {
  int slope = 0, drift = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const auto line = fit::fit_channel_line(points(0, 1e-4, 0.02, 100 + seed));
    slope += line.slope.interval.low < 2 && 2 < line.slope.interval.high ? 1 : 0;
    drift += line.drift->interval.low < 1e-4 && 1e-4 < line.drift->interval.high ? 1 : 0;
  }
  for (const int held : {slope, drift}) EXPECT_NEAR(held, 190, 10);  // a deviation of 3.1
}

TEST(ChannelLine, SeesTheStepsOfAPotentiometer) {
  LinePoints p;
  for (int i = 0; i < 400; ++i) {
    p.reference.push_back(0.01 * i);
    p.reading.push_back(0.05 * std::round((1 + 2 * 0.01 * i) / 0.05));
  }
  const auto line = fit::fit_channel_line(p);
  ASSERT_TRUE(line.steps);
  EXPECT_NEAR(line.steps->step, 0.05, 1e-9);
  EXPECT_FALSE(line.hysteresis);  // went up alone
}

TEST(ChannelLine, RefusesWhatIsNoLine) {
  const auto refused = [](LinePoints p) { return [p] { fit::fit_channel_line(p); }; };
  EXPECT_THAT(refused({{1, 2}, {1, 2}}), ThrowsMessage<hydro::InputError>(HasSubstr("needs 3 points")));
  EXPECT_THAT(refused({{1, 1, 1}, {1, 2, 3}}), ThrowsMessage<hydro::InputError>(HasSubstr("all references are 1")));
  EXPECT_THAT(refused({{1, 2, 3}, {4, 4, 4}}), ThrowsMessage<hydro::InputError>(HasSubstr("gave no signal")));
  EXPECT_THAT(refused({{1, 2, 3}, {4, std::nan(""), 4}}), ThrowsMessage<hydro::InputError>(HasSubstr("point 2")));
  EXPECT_THAT(refused({{1, 2, 3, 2}, {4, 5, 6, 5}, {1, 2, 2, 3}}),
              ThrowsMessage<hydro::InputError>(HasSubstr("time does not increase at point 3")));
  EXPECT_THAT(refused({{1, 2, 3, 4}, {4, 5, 6, 7}, {1, 2, 3, 4}}),
              ThrowsMessage<hydro::InputError>(HasSubstr("cannot be told from the slope")));
  EXPECT_THAT(refused({{1, 2, 3, 4}, {1, 3, 1, 3}}), ThrowsMessage<hydro::InputError>(HasSubstr("holds zero")));
}

}  // namespace
}  // namespace channel_line_test
