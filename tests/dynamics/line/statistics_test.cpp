// Slack, snaps and curvature. (D93), (D94)
#include "dynamics/line/statistics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hydro/base/error.hpp"

namespace statistics_test {
namespace {

using namespace dynamics::line;

// |sin t| above a threshold: slack for the share (2/π) asin(1/2) = 1/3 of the time, a snap each half period.
TEST(TensionStatistics, CountSlackAndSnapsOfAKnownSeries) {
  TensionStatistics s(2, 0.5, 0.9);
  const int steps = 200000;
  const double h = 10 * M_PI / steps;
  for (int i = 1; i <= steps; ++i) s.note(i * h, h, Eigen::Vector2d(std::abs(std::sin(i * h)), 2 + std::cos(i * h)));
  EXPECT_NEAR(s.slack_share(0), 1.0 / 3, 1e-3);  // the ends of 20 intervals, a step each
  EXPECT_EQ(s.slack_share(1), 0);
  EXPECT_NEAR(s.slack_share(), 1.0 / 3, 1e-3);
  EXPECT_EQ(s.snaps(), 10);
  EXPECT_EQ(s.snaps(1), 0);
  EXPECT_EQ(s.largest().segment, 1);
  EXPECT_NEAR(s.largest().tension, 3, 1e-7);
  EXPECT_NEAR(std::remainder(s.largest().time, 2 * M_PI), 0, 1e-3);
}

TEST(TensionStatistics, CountOneSnapHoweverLongItRingsAbove) {
  TensionStatistics s(1, 0, 10);
  for (const double T : {12.0, 0.0, 11.0, 5.0, 12.0, 5.0, -1.0, 5.0, 10.0})
    s.note(0, 1, Eigen::VectorXd::Constant(1, T));
  EXPECT_EQ(s.snaps(), 2);
  EXPECT_THAT([] { TensionStatistics(1, 2, 1); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("got 2 N and 1 N")));
}

TEST(Curvature, IsExactOnAPolygonInACircle) {
  State s{.position = Places::Zero(3, 9), .velocity = Places::Zero(3, 9), .tension = {}};
  for (int i = 0; i < 9; ++i) s.position.col(i) = 7 * Eigen::Vector3d(std::cos(0.4 * i), 0, std::sin(0.4 * i));
  for (int i = 1; i < 8; ++i) EXPECT_NEAR(curvature(s, i), 1.0 / 7, 1e-14);
}

}  // namespace
}  // namespace statistics_test
