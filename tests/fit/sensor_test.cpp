#include "fit/sensor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"

namespace sensor_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double two_pi = 2 * std::numbers::pi;

std::vector<double> sinusoid(double amplitude, double hz, double step, std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t j = 0; j < n; ++j) x[j] = amplitude * std::sin(two_pi * hz * step * static_cast<double>(j));
  return x;
}

TEST(Sensor, AtItsStopIsFoundWithSideAndCount) {
  auto x = sinusoid(10, 0.25, 0.01, 4000);
  for (double& v : x) v = std::min(v, 8.0);
  const auto c = fit::find_clipping(x);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->high, 8.0);
  EXPECT_EQ(c->at_low, 0u);
  EXPECT_NEAR(static_cast<double>(c->at_high), 4000 * std::acos(0.8) / std::numbers::pi, 20);
}

TEST(Sensor, ThatIsNotAtItsStopIsNotBlamed) {
  EXPECT_FALSE(fit::find_clipping(sinusoid(10, 0.25, 0.01, 4000)));
  auto coarse = sinusoid(10, 0.2531, 0.01, 4000);  // the highest level of a coarse one is taken √(2+1)/… times as often
  for (double& v : coarse) v = 0.5 * std::round(v / 0.5);
  EXPECT_FALSE(fit::find_clipping(coarse));
  EXPECT_FALSE(fit::find_clipping(froude_test::ar1_noise(4000, 0.9, 1, 5)));
}

// The rule on the counts of all levels in their order, for records that dwell at their ends by chance.
TEST(Sensor, AtItsStopIsWhatTheCountsOfItsLevelsSay) {
  std::mt19937 random(3);
  for (int record = 0; record < 2000; ++record) {
    std::vector<double> x(40);
    std::map<double, std::size_t> count;
    for (double& v : x) {
      v = std::clamp(static_cast<double>(random() % 16), 3.0, 12.0);
      ++count[v];
    }
    const auto stops = [](auto end) { return end->second >= 5 && end->second > 5 * std::next(end)->second; };
    const bool low = stops(count.begin()), high = stops(count.rbegin());
    const auto found = fit::find_clipping(x);
    ASSERT_EQ(found.has_value(), low || high);
    if (!found) continue;
    EXPECT_EQ(found->at_low, low ? count.begin()->second : 0u);
    EXPECT_EQ(found->at_high, high ? count.rbegin()->second : 0u);
  }
}

TEST(Sensor, OfFewLevelsIsMeasured) {
  auto x = sinusoid(10, 0.2531, 0.01, 4000);
  for (double& v : x) v = 0.1 * std::round(v / 0.1);
  const auto q = fit::find_quantisation(x);
  ASSERT_TRUE(q);
  EXPECT_NEAR(q->step, 0.1, 1e-12);
  EXPECT_EQ(q->levels, 201u);
  EXPECT_NEAR(q->noise(), 0.1 / std::sqrt(12), 1e-12);
  EXPECT_FALSE(fit::find_quantisation(sinusoid(10, 0.2531, 0.01, 4000)));
}

TEST(Sensor, HumIsNamedWithFrequencyAndAmplitude) {
  auto x = sinusoid(30, 0.25, 0.002, 20000);
  const auto hum = sinusoid(0.8, 50, 0.002, 20000), noise = froude_test::ar1_noise(20000, 0.5, 0.5, 7);
  for (std::size_t j = 0; j < x.size(); ++j) x[j] += hum[j] + noise[j];
  const auto lines = fit::find_lines(x, 0.002, 2.5);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(lines[0].frequency_hz, 50, 0.2);  // half a bin of fifteen segments
  EXPECT_NEAR(lines[0].amplitude, 0.8, 0.03);   // the noise below the line adds its share
}

TEST(Sensor, SpikesAreFoundAndBridged) {
  auto x = sinusoid(10, 0.25, 0.01, 2000);
  const auto clean = x, noise = froude_test::ar1_noise(2000, 0, 0.05, 9);
  for (std::size_t j = 0; j < x.size(); ++j) x[j] += noise[j];
  x[700] += 8;
  x[1200] -= 5;
  x[1201] -= 5;
  const auto found = fit::find_outliers(x, 10, 8);
  EXPECT_THAT(found, ElementsAre(700u, 1200u, 1201u));
  fit::bridge(x, found);
  for (const std::size_t j : found) EXPECT_NEAR(x[j], clean[j], 0.3);  // three deviations of noise and the curvature
}

TEST(EvenGrid, FillsShortGapsByStraightLinesAndCountsThem) {
  std::vector<double> t, x;
  for (int j = 0; j < 100; ++j)
    if (j < 40 || j > 44) {
      t.push_back(0.1 * j);
      x.push_back(3 + 0.5 * j);
    }
  const auto grid = fit::even_grid(t, 0.7);
  EXPECT_NEAR(grid.step, 0.1, 1e-12);
  EXPECT_THAT(grid.filled, ElementsAre(40u, 41u, 42u, 43u, 44u));
  const auto full = fit::on_grid(grid, x);
  ASSERT_EQ(full.size(), 100u);
  for (int j = 0; j < 100; ++j) EXPECT_NEAR(full[static_cast<std::size_t>(j)], 3 + 0.5 * j, 1e-12);
  EXPECT_THAT([&] { fit::even_grid(t, 0.3); }, ThrowsMessage<hydro::InputError>(HasSubstr("missing after 3.9 s")));
  EXPECT_THAT([&] { fit::even_grid(t, 0); }, ThrowsMessage<hydro::InputError>(HasSubstr("are missing")));
}

TEST(EvenGrid, RefusesTimeThatStandsStillOrWanders) {
  EXPECT_THROW(fit::even_grid(std::vector{0.0, 1.0, 1.0, 2.0}, 9), hydro::InputError);
  EXPECT_THROW(fit::even_grid(std::vector{0.0, 1.0, 2.2, 3.0, 4.0}, 9), hydro::InputError);
}

// 30 Hz to two digits: 0.03, 0.03, 0.04 s, up to 0.15 of a step off. A clock that is uneven by more is no rounding.
TEST(EvenGrid, IsThatOfTimesRoundedToTheirLastDigit) {
  std::vector<double> time;
  for (int j = 0; j < 900; ++j) time.push_back(std::round(100 * (7.3 + j / 30.0)) / 100);
  const auto grid = fit::even_grid(time, 0);
  EXPECT_TRUE(grid.filled.empty());
  EXPECT_NEAR(grid.step, 1 / 30.0, 0.01 / 899);  // a last digit over the record
  for (std::size_t j = 0; j < time.size(); ++j) ASSERT_NEAR(grid.time[j], time[j], 0.01);
  time[401] += 0.01;  // rounded up already
  EXPECT_THROW(fit::even_grid(time, 0), hydro::InputError);
}

}  // namespace
}  // namespace sensor_test
