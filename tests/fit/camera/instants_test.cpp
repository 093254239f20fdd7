#include "fit/camera/instants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "support/refused.hpp"
#include "support/two_clocks.hpp"

namespace camera_instants_test {
namespace {

using fit::camera::offset_between;
using fit::camera::Track;
using support::refused;
using testing::HasSubstr;

/// Two swings that die away.
double motion(double t) {
  return t < 0 ? 0.6 : std::exp(-0.15 * t) * (0.5 * std::cos(3.1 * t) + 0.1 * std::cos(7.3 * t));
}

struct Both {
  std::vector<double> time, value, record_time, record;
};
/// A film of 25 frames a second, uneven and with gaps, and a record of 100 Hz in another unit whose clock is ahead.
Both both(std::uint64_t seed, double lag) {
  const hydro::RandomStream random(seed, 3);
  Both out;
  for (int i = 0; i < 250; ++i) {
    const auto k = static_cast<std::uint64_t>(i);
    out.time.push_back(0.04 * i + 0.004 * std::sin(1.7 * i));
    out.value.push_back(i % 17 == 3 ? std::numeric_limits<double>::quiet_NaN()
                                    : motion(out.time.back()) + 0.01 * random.normal(k));
  }
  for (int i = 0; i < 1400; ++i) {
    out.record_time.push_back(0.01 * i);
    out.record.push_back(3 - 57.3 * motion(out.record_time.back() - lag) +
                         0.3 * random.normal(1000 + static_cast<std::uint64_t>(i)));
  }
  return out;
}

TEST(Offset, IsFoundWithItsError) {
  double squares = 0, weighed = 0;
  constexpr int trials = 60;
  for (std::uint64_t k = 1; k <= trials; ++k) {
    const double lag = 1.5 + 0.01 * static_cast<double>(k) + 0.0037;
    const Both b = both(k, lag);
    const auto found = offset_between(b.time, b.value, b.record_time, b.record);
    squares += std::pow(found.lag - lag, 2) / trials;
    weighed += std::pow((found.lag - lag) / found.deviation, 2) / trials;
    EXPECT_LT(found.correlation, -0.99) << "the record is positive the other way";
  }
  EXPECT_LT(std::sqrt(squares), 0.002);
  EXPECT_NEAR(weighed, 1, 0.55);  // three deviations of the mean of 60 squares, each 1 with a deviation of 1.41
}

// All nine pairs of clocks, 400 sets each, are the case `clock-offset` of `froude validate`.
TEST(Offset, HasAnIntervalThatHolds) {
  froude_test::OffsetErrors all;
  for (const auto& of : froude_test::two_clocks) {
    const auto some = froude_test::errors_of_offsets(of, 20);
    all.sets += some.sets;
    all.within += some.within;
    all.squares += some.squares;
    all.quantiles += some.quantiles;
    // 20 squares, each 1 with a deviation of 1.41 and a little more by Student's: four of their mean, 0.32. Of a
    // deviation that is 1.5 times too small they are 2.25.
    EXPECT_LT(some.squares / some.sets, 2.25) << of.name;
  }
  // Of 180 squares and intervals together: three deviations, 0.105 of the mean and 2.9 intervals of 171.
  EXPECT_NEAR(all.squares / all.sets, 1, 0.32);
  EXPECT_NEAR(all.within, 0.95 * all.sets, 8.8);
  // Student's quantile for 95 %: 1.96 of whoever has many independent samples, 2.3 of eight.
  EXPECT_NEAR(all.quantiles / all.sets, 2.1, 0.17);
}

TEST(Offset, SaysWhereThereIsNone) {
  Both b = both(1, 2);
  for (std::size_t i = 0; i < b.record.size(); ++i) b.record[i] = std::sin(31 * b.record_time[i]);
  EXPECT_THAT(refused([&] { offset_between(b.time, b.value, b.record_time, b.record); }),
              HasSubstr("do not show the same"));
  for (std::size_t i = 0; i < b.record.size(); ++i) b.record[i] = std::sin(3 * b.record_time[i]);
  for (std::size_t i = 0; i < b.value.size(); ++i) b.value[i] = std::sin(3 * b.time[i]);
  EXPECT_THAT(refused([&] { offset_between(b.time, b.value, b.record_time, b.record); }),
              HasSubstr("two offsets fit nearly alike"));
  b.record.resize(8);
  b.record_time.resize(8);
  EXPECT_THAT(refused([&] { offset_between(b.time, b.value, b.record_time, b.record); }), HasSubstr("16 samples"));
}

/// A bob that is let go at `t0`, in free fall along its circle at first.
Track let_go(std::uint64_t seed, double t0, int frames) {
  const hydro::RandomStream random(seed, 4);
  Track out{.time = {}, .markers = {{"bob", {}}}, .in_metres = true};
  for (int i = 0; i < frames; ++i) {
    const double t = 0.02 * i, since = std::max(0.0, t - t0), angle = 0.9 * std::cos(2.4 * since);
    const auto k = static_cast<std::uint64_t>(2 * i);
    out.time.push_back(t);
    out.markers[0].seen.push_back(
        fit::camera::Sighting{Eigen::Vector2d(std::sin(angle), -std::cos(angle)) +
                                  4e-4 * Eigen::Vector2d(random.normal(k), random.normal(k + 1)),
                              1.6e-7 * Eigen::Matrix2d::Identity()});
  }
  return out;
}

TEST(Release, IsFoundWithItsError) {
  double weighed = 0, squares = 0;
  constexpr int trials = 60;
  for (std::uint64_t k = 1; k <= trials; ++k) {
    const double t0 = 0.6 + 0.0007 * static_cast<double>(k);
    const auto found = release_of(let_go(k, t0, 150), "bob");
    squares += std::pow(found.at - t0, 2) / trials;
    weighed += std::pow((found.at - t0) / found.deviation, 2) / trials;
  }
  EXPECT_LT(std::sqrt(squares), 0.004);  // a fifth of a frame
  EXPECT_NEAR(weighed, 1, 0.7);
}

TEST(Release, SaysWhereThereIsNone) {
  EXPECT_THAT(refused([&] { release_of(let_go(1, 0, 150), "bob"); }), HasSubstr("5 and 4 are needed"));
  EXPECT_THAT(refused([&] { release_of(let_go(1, 100, 150), "bob"); }), HasSubstr("no release can be told"));
  EXPECT_THAT(refused([&] { release_of(let_go(1, 0.6, 150), "bop"); }), HasSubstr("did you mean \"bob\"?"));
}

}  // namespace
}  // namespace camera_instants_test
