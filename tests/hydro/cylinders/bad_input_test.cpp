#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "layouts.hpp"

namespace hydro::cylinders::bad_input_test {
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

// A gap of a twentieth of the radius: the orders that cross it fall as (2a/L)^{2m}, and at m = 24 that is not little.
TEST(CylinderInput, WarnsOfGapsTooSmallForItsDigits) {
  const Options options{.tolerance = 5e-2, .threads = 1, .doubled_frequencies = 0};
  const auto narrow = solve({single(1, 1), single(1, 1, 2.05, 0)}, tank(2), {1.0}, {}, options);
  EXPECT_GT(narrow.check.left_out, 1e-3);
  EXPECT_THAT(narrow.coefficients.notes, testing::Contains(AllOf(HasSubstr("warning"), HasSubstr("digits are left"))));
  const auto wide = solve({single(1, 1), single(1, 1, 4, 0)}, tank(2), {1.0}, {}, options);
  EXPECT_EQ(wide.check.left_out, 0);
  EXPECT_THAT(wide.coefficients.notes, testing::Not(testing::Contains(HasSubstr("warning"))));
}

// Waves a hundredth of the cylinders long need partial waves of far higher order than there are.
TEST(CylinderInput, RefusesWavesTooShortForAnArray) {
  EXPECT_THAT(solving({single(10, 1), single(10, 1, 30, 0)}, tank(), {8.0}, {0}, 1e-2),
              ThrowsMessage<InputError>(AllOf(HasSubstr("8 rad/s"), HasSubstr("no digit"), HasSubstr("too short"))));
}

TEST(CylinderInput, RefusesToChooseFrequenciesFromFewOrBeyondItsOwnError) {
  const auto choosing = [](std::vector<double> omega, double tolerance, double between) {
    return [=] {
      solve({single(1, 1)}, tank(), omega, {}, {.tolerance = tolerance, .frequency_tolerance = between, .threads = 1});
    };
  };
  EXPECT_THAT(choosing({1, 2, 3, 4}, 1e-4, 1e-2), ThrowsMessage<InputError>(HasSubstr("5 at least")));
  EXPECT_THAT(choosing({1, 2, 3, 4, 5}, 1e-4, 0.2), ThrowsMessage<InputError>(HasSubstr("between 1e-6 and 0.1")));
  EXPECT_THAT(choosing({1, 2, 3, 4, 5}, 1e-4, nan), ThrowsMessage<InputError>(HasSubstr("between 1e-6 and 0.1")));
  EXPECT_THAT(choosing({1, 2, 3, 4, 5}, 1e-3, 1e-3), ThrowsMessage<InputError>(HasSubstr("ten times that")));
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
}  // namespace hydro::cylinders::bad_input_test
