#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "layouts.hpp"

namespace hydro::cylinders {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

auto solving(std::vector<CylinderBody> bodies, Water water = tank(), std::vector<double> omega = {1.0},
             std::vector<double> heading = {0}, double tolerance = 1e-4) {
  return [=] { solve(bodies, water, omega, heading, {.tolerance = tolerance, .threads = 1}); };
}

TEST(CylinderInput, RefusesCylindersThatTouch) {
  EXPECT_THAT(solving({single(1, 1), single(1.5, 1, 2.5, 0)}),
              ThrowsMessage<InputError>(AllOf(HasSubstr("overlap or touch"), HasSubstr("2.5 m apart"))));
}

TEST(CylinderInput, RefusesADraughtThatReachesTheBottom) {
  EXPECT_THAT(solving({single(1, 14)}),
              ThrowsMessage<InputError>(AllOf(HasSubstr("draught of 14 m"), HasSubstr("bottom"))));
}

TEST(CylinderInput, RefusesSizesThatAreNotPositive) {
  EXPECT_THAT(solving({single(0, 1)}), ThrowsMessage<InputError>(HasSubstr("radius")));
  EXPECT_THAT(solving({single(nan, 1)}), ThrowsMessage<InputError>(HasSubstr("radius")));
  EXPECT_THAT(solving({single(1, -1)}), ThrowsMessage<InputError>(HasSubstr("draught")));
  EXPECT_THAT(solving({single(1, 1, nan, 0)}), ThrowsMessage<InputError>(HasSubstr("finite")));
}

TEST(CylinderInput, RefusesBodiesWithoutCylindersAndNoBody) {
  EXPECT_THAT(solving({{"empty", {0, 0, 0}, {}, {}}}),
              ThrowsMessage<InputError>(HasSubstr("\"empty\" has no cylinder")));
  EXPECT_THAT(solving({}), ThrowsMessage<InputError>(HasSubstr("no body")));
}

TEST(CylinderInput, RefusesListsThatDoNotIncrease) {
  EXPECT_THAT(solving({single(1, 1)}, tank(), {1, 1}), ThrowsMessage<InputError>(HasSubstr("must increase")));
  EXPECT_THAT(solving({single(1, 1)}, tank(), {0, 1}), ThrowsMessage<InputError>(HasSubstr("positive")));
  EXPECT_THAT(solving({single(1, 1)}, tank(), {1, nan}), ThrowsMessage<InputError>(HasSubstr("finite")));
  EXPECT_THAT(solving({single(1, 1)}, tank(), {}), ThrowsMessage<InputError>(HasSubstr("no frequency")));
  EXPECT_THAT(solving({single(1, 1)}, tank(), {1}, {1, 0}), ThrowsMessage<InputError>(HasSubstr("headings")));
}

TEST(CylinderInput, RefusesAToleranceOutOfRange) {
  EXPECT_THAT(solving({single(1, 1)}, tank(), {1}, {0}, 1e-12), ThrowsMessage<InputError>(HasSubstr("tolerance")));
}

// A wave five hundred times shorter than the gap: its trace in the gap is confined to a small part at the edge.
TEST(CylinderInput, SaysHowManyDigitsAreLeft) {
  EXPECT_THAT(solving({single(1, 0.02)}, tank(10), {24.0}, {0}, 1e-9),
              ThrowsMessage<InputError>(AllOf(HasSubstr("digits"), HasSubstr("less accuracy"))));
}

TEST(CylinderInput, RefusesADepthThatIsTooManyDraughts) {
  EXPECT_THAT(solving({single(1, 1e-4)}, tank(100)), ThrowsMessage<InputError>(HasSubstr("terms")));
}

TEST(CylinderInput, RefusesLongWavesInInfinitelyDeepWater) {
  Water deep = tank();
  deep.depth = WaterDepth::infinite();
  EXPECT_THAT(solving({single(1, 1)}, deep, {0.05}),
              ThrowsMessage<InputError>(AllOf(HasSubstr("0.05 rad/s is too low"), HasSubstr("state the depth"))));
}

TEST(CylinderInput, RefusesAPileInInfinitelyDeepWater) {
  Water deep = tank();
  deep.depth = WaterDepth::infinite();
  EXPECT_THAT(solving({{"pile", {0, 0, 0}, {}, {{{0, 0}, 1, {}}}}}, deep),
              ThrowsMessage<InputError>(HasSubstr("stands on the sea bed")));
}

}  // namespace
}  // namespace hydro::cylinders
