// Poincaré sections of sampled motions. (D103)
#include "hydro/signal/poincare_section.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/base/error.hpp"

namespace poincare_section_test {
namespace {

using namespace hydro::signal;
using hydro::InputError;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double pi = std::numbers::pi;

/// cos t and sin t, N samples a turn from t = 0.3 on, ten turns.
struct Circle {
  std::vector<double> x, y;
  double step;
  explicit Circle(int per_turn) : step(2 * pi / per_turn) {
    for (int i = 0; i < 10 * per_turn; ++i) {
      x.push_back(std::cos(0.3 + i * step));
      y.push_back(std::sin(0.3 + i * step));
    }
  }
  Samples samples() const { return {0.3, step, {x, y}}; }
};

// Of x = cos t through ½ the other is −√¾ on the way up and √¾ on the way down, at t = ∓π/3.
TEST(PoincareSection, OfACircleIsOnePointAndItsErrorHolds) {
  for (const int per_turn : {10, 20, 40}) {
    const Circle c(per_turn);
    const PoincareSection up = poincare_section_at(c.x, 0.5, Through::up, c.samples());
    ASSERT_GE(up.time_s.size(), 9u);
    double largest = 0;
    for (std::size_t k = 0; k < up.time_s.size(); ++k) {
      const double error = std::abs(up.values[1][k] + std::sqrt(0.75));
      EXPECT_LE(error, up.errors[1][k]) << per_turn;
      EXPECT_NEAR(std::remainder(up.time_s[k] + pi / 3, 2 * pi), 0, std::pow(2 * pi / per_turn, 6) / 40);
      EXPECT_NEAR(up.values[0][k], 0.5, 1e-13);
      largest = std::max(largest, up.errors[1][k]);
    }
    EXPECT_LT(largest, std::pow(2 * pi / per_turn, 4) / 30);  // h⁴ 9/16 /24 of four samples, and that of the root
  }
}

TEST(PoincareSection, TakesOneDirectionOrBoth) {
  const Circle c(40);
  const PoincareSection up = poincare_section_at(c.x, 0.5, Through::up, c.samples()),
                        down = poincare_section_at(c.x, 0.5, Through::down, c.samples()),
                        both = poincare_section_at(c.x, 0.5, Through::both, c.samples());
  for (const double y : up.values[1]) EXPECT_NEAR(y, -std::sqrt(0.75), 1e-6);
  for (const double y : down.values[1]) EXPECT_NEAR(y, std::sqrt(0.75), 1e-6);
  EXPECT_EQ(both.time_s.size(), up.time_s.size() + down.time_s.size());
  EXPECT_EQ(poincare_section_at(c.x, 2, Through::both, c.samples()).time_s.size(), 0u);
}

TEST(PoincareSection, OnceInAPeriodIsOnePointToo) {
  const Circle c(23);
  const PoincareSection s = poincare_section_every(1.1, 2 * pi, c.samples());
  ASSERT_EQ(s.time_s.size(), 10u);
  for (std::size_t k = 0; k < s.time_s.size(); ++k) {
    EXPECT_NEAR(s.time_s[k], 1.1 + 2 * pi * static_cast<double>(k), 1e-12);
    EXPECT_LE(std::abs(s.values[0][k] - std::cos(1.1)), s.errors[0][k]);
    EXPECT_LE(std::abs(s.values[1][k] - std::sin(1.1)), s.errors[1][k]);
  }
}

TEST(PoincareSection, LeavesOutWhatHasTooFewSamplesBeside) {
  // Through 0 between the first two samples, in the middle, and between the last two.
  const std::vector<double> v{-1, 1, 1, 1, -1, -1, -1, -1, 1, 1, 1, -1, -1, -1, -1, 1};
  const PoincareSection s = poincare_section_at(v, 0, Through::up, {0, 1, {v}});
  EXPECT_EQ(s.time_s.size(), 1u);
  EXPECT_EQ(s.left_out, 2u);
  EXPECT_EQ(poincare_section_every(0, 5, {0, 1, {v}}).left_out, 2u);  // at 0 and 15 s
}

TEST(PoincareSection, RefusesWhatIsNoRecord) {
  const std::vector<double> few(5, 0.0), six(6, 0.0);
  std::vector<double> gap(8, 0.0);
  gap[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(
      [&] {
        poincare_section_at(few, 0, Through::up, {0, 1, {few}});
      },
      ThrowsMessage<InputError>(HasSubstr("got 5")));
  EXPECT_THAT(
      [&] {
        poincare_section_at(gap, 0, Through::up, {0, 1, {gap}});
      },
      ThrowsMessage<InputError>(HasSubstr("sample 5")));
  EXPECT_THAT(
      [&] {
        poincare_section_at(six, 0, Through::up, {0, 1, {gap}});
      },
      ThrowsMessage<InputError>(HasSubstr("8 and 6")));
  EXPECT_THAT([&] { poincare_section_every(0, 0, {0, 1, {six}}); }, ThrowsMessage<InputError>(HasSubstr("above 0")));
  EXPECT_THAT(
      [&] {
        poincare_section_every(9, 1, {0, 1, {six}});
      },
      ThrowsMessage<InputError>(HasSubstr("from 0 to 5 s")));
}

}  // namespace
}  // namespace poincare_section_test
