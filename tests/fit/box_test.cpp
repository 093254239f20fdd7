// Boxes of samples: by hand, and of a normal law.
#include "fit/box.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "hydro/base/error.hpp"

namespace box_test {
namespace {

// Quartiles of 1 … 9 are 3, 5 and 7; fences stand at −3 and 13.
TEST(Box, OfNineAndTwoOutliersByHand) {
  const fit::Box of = fit::box_of({9, 1, 8, 2, 7, 3, 6, 4, 5});
  EXPECT_EQ(of.lower_quartile, 3);
  EXPECT_EQ(of.median, 5);
  EXPECT_EQ(of.upper_quartile, 7);
  EXPECT_EQ(of.low, 1);
  EXPECT_EQ(of.high, 9);
  EXPECT_THAT(of.outliers, testing::IsEmpty());
  // Of −20, 1 … 9, 30 the quartiles are 2.5, 5 and 7.5, the fences −5 and 15.
  const fit::Box with = fit::box_of({30, 1, 2, 3, 4, 5, 6, 7, 8, 9, -20});
  EXPECT_EQ(with.lower_quartile, 2.5);
  EXPECT_EQ(with.upper_quartile, 7.5);
  EXPECT_EQ(with.low, 1);
  EXPECT_EQ(with.high, 9);
  EXPECT_THAT(with.outliers, testing::ElementsAre(-20, 30));
}

// Beyond 0.6745 (1 + 2·1.5) = 2.698 deviations lie 0.698 % of a normal law. Of 100 000 samples 698 are outliers, with a
// deviation of 26; quartiles scatter by 1.36/√n = 0.0043.
TEST(Box, OfANormalLawHasItsQuartilesAndItsFewOutliers) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(2, 0.5);
  std::vector<double> samples(100000);
  for (double& s : samples) s = normal(random);
  const fit::Box of = fit::box_of(samples);
  EXPECT_NEAR(of.median, 2, 4 * 0.5 * 1.2533 / std::sqrt(1e5));
  EXPECT_NEAR(of.upper_quartile - of.lower_quartile, 2 * 0.6745 * 0.5, 4 * 0.5 * 0.005);
  EXPECT_NEAR(static_cast<double>(of.outliers.size()), 698, 4 * 26);
}

TEST(Box, OfOneSampleIsThatSample) {
  const fit::Box of = fit::box_of({4});
  EXPECT_EQ(of.low, 4);
  EXPECT_EQ(of.high, 4);
  EXPECT_EQ(of.median, 4);
}

TEST(Box, RefusesNothingAndWhatIsNotFinite) {
  EXPECT_THROW(fit::box_of({}), hydro::InputError);
  EXPECT_THROW(fit::box_of({1, std::numeric_limits<double>::quiet_NaN()}), hydro::InputError);
}

}  // namespace
}  // namespace box_test
