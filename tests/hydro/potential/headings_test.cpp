// (P42) Headings are directions: whole turns do not count, and a full circle has no end.
#include "hydro/potential/operations/headings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/potential/operations/operations.hpp"
#include "hydro/potential/operations/transformations.hpp"
#include "smooth_body.hpp"

namespace headings_test {
namespace {

using hydro::potential::between_headings;
using hydro::potential::Coefficients;
using hydro::potential::FrequencyTable;

constexpr double degree = std::numbers::pi / 180;

std::vector<double> table(double first, double step, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back((first + i * step) * degree);
  return out;
}

/// The value at `heading`, degrees, of a table that has `values`.
double interpolated(const std::vector<double>& headings, double heading, const std::vector<double>& values) {
  const auto at = between_headings(headings, heading * degree);
  return at ? (1 - at->share) * values[at->first] + at->share * values[at->second] : std::nan("");
}

TEST(Headings, ThatDifferByWholeTurnsAreTheSame) {
  struct Case {
    double first, step;
    int count;
    double asked;
    std::size_t expected;
  };
  for (const Case& c : {Case{0, 15, 25, -15, 23}, Case{-180, 15, 25, 195, 1}, Case{0, 15, 24, -30, 22},
                        Case{30, 15, 24, 0, 22}, Case{0, 45, 3, 720 + 45, 1}, Case{350, 5, 3, 0, 2}}) {
    const auto headings = table(c.first, c.step, c.count);
    const auto at = between_headings(headings, c.asked * degree);
    ASSERT_TRUE(at) << c.asked;
    // Sums of degrees in radians are off by rounding, which may put the heading a hair before or behind its own.
    const double place = (1 - at->share) * double(at->first) + at->share * double(at->second);
    EXPECT_NEAR(place, double(c.expected), 1e-9) << c.asked;
  }
}

TEST(Headings, AreNeighboursAcrossTheEndOfACircle) {
  std::vector<double> values(24, 0.0);
  values.front() = 3;
  values.back() = 1;
  // Rounding of three angles of order one.
  EXPECT_NEAR(interpolated(table(0, 15, 24), 350, values), 1 + 2 * 5.0 / 15, 1e-12);
  EXPECT_NEAR(interpolated(table(0, 15, 24), -10, values), 1 + 2 * 5.0 / 15, 1e-12);
}

TEST(Headings, OutsideAPartOfTheCircleAreNone) {
  EXPECT_FALSE(between_headings(table(0, 45, 3), 91 * degree));
  EXPECT_FALSE(between_headings(table(0, 45, 3), -1 * degree));
  // Half a turn is not a neighbour as near as the others are.
  EXPECT_FALSE(between_headings(table(0, 90, 3), 270 * degree));
  // Two headings are neighbours of each other and no circle.
  EXPECT_FALSE(between_headings(table(0, 180, 2), 270 * degree));
}

/// Excitation asked for all round is that of the same data turned, wherever their tables begin.
TEST(Headings, OfTurnedDataAnswerAllRound) {
  const auto all_round = table(0, 15, 24);
  const auto data = froude_test::SmoothBody{}.coefficients({}, {0.5, 1, 2}, all_round);
  const Coefficients turned = hydro::potential::turned(data, 30 * degree);
  ASSERT_NEAR(turned.heading.back(), 375 * degree, 1e-12);
  const FrequencyTable before(data, {Eigen::Vector3d::Zero()}), after(turned, {Eigen::Vector3d::Zero()});
  for (const double heading : {-720.0, -100.0, 0.0, 7.0, 352.0, 380.0}) {
    const double a = before.excitation(1, (heading - 30) * degree)[2].real(),
                 b = after.excitation(1, heading * degree)[2].real();
    EXPECT_NEAR(a, b, 1e-9 * std::abs(a)) << heading;  // rounding of angles
  }
}

TEST(Headings, ThatAreMissingAreToldWithTheKeyThatGivesThem) {
  const auto data = froude_test::SmoothBody{}.coefficients({}, {0.5, 1}, table(30, 1, 1));
  const FrequencyTable one(data, {Eigen::Vector3d::Zero()});
  try {
    one.excitation(0.5, 0.2);
    FAIL() << "a heading outside the data was answered";
  } catch (const hydro::InputError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("from 30 to 30 deg"));
    EXPECT_THAT(e.remedy(), testing::HasSubstr("`headings` in [body.hydrodynamics.cylinders]"));
  }
}

}  // namespace
}  // namespace headings_test
