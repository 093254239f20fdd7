#include "hydro/base/types.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace types_test {
namespace {

using namespace hydro;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(AngularFrequency, IsTheSameByRadiansHertzAndPeriod) {
  const double omega = 2 * std::numbers::pi / 8;
  EXPECT_DOUBLE_EQ(AngularFrequency::from_period_s(8).rad_per_s(), omega);
  EXPECT_DOUBLE_EQ(AngularFrequency::from_hertz(0.125).rad_per_s(), omega);
  EXPECT_DOUBLE_EQ(AngularFrequency::from_rad_per_s(omega).period_s(), 8);
  EXPECT_DOUBLE_EQ(AngularFrequency::from_period_s(8).hertz(), 0.125);
  EXPECT_THROW(AngularFrequency::from_rad_per_s(0), InputError);
  EXPECT_THROW(AngularFrequency::from_hertz(std::numeric_limits<double>::infinity()), InputError);
  EXPECT_THAT([] { AngularFrequency::from_period_s(-8); }, ThrowsMessage<InputError>(HasSubstr("got -8 s")));
}

TEST(WaterDepth, MayBeInfiniteButNotZeroOrNotANumber) {
  EXPECT_TRUE(WaterDepth::infinite().is_infinite());
  EXPECT_FALSE(WaterDepth::from_metres(14).is_infinite());
  EXPECT_THAT([] { WaterDepth::from_metres(0); }, ThrowsMessage<InputError>(HasSubstr("positive, got 0 m")));
  EXPECT_THROW(WaterDepth::from_metres(std::nan("")), InputError);
}

TEST(WaveAmplitude, IsHalfTheHeight) {
  EXPECT_EQ(WaveAmplitude::from_height(2.5).metres(), 1.25);
  EXPECT_THROW(WaveAmplitude::from_metres(-1), InputError);
}

TEST(Angle, TurnsDegreesIntoRadiansAndBack) {
  EXPECT_DOUBLE_EQ(Angle::from_degrees(45).radians(), std::numbers::pi / 4);
  EXPECT_DOUBLE_EQ(Angle::from_radians(std::numbers::pi).degrees(), 180);
}

TEST(Mode, IsReadByNameAndTheNearestIsNamed) {
  EXPECT_EQ(parse_mode("heave"), Mode::heave);
  EXPECT_TRUE(is_rotation(Mode::roll));
  EXPECT_FALSE(is_rotation(Mode::heave));
  EXPECT_THAT([] { parse_mode("heav"); }, ThrowsMessage<InputError>(HasSubstr("did you mean \"heave\"?")));
}

}  // namespace
}  // namespace types_test
