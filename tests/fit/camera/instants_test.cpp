#include "fit/camera/instants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "support/refused.hpp"

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

/// Noise of the film and of the record over a motion of rms 0.6, each with the memory φ^k.
struct Noise {
  double film, record, memory;
};

/// Ten waves between 0.2 and 1.1 Hz, or one swing of 0.6 Hz that begins and dies away.
double broad(const hydro::RandomStream& random, double t) {
  double sum = 0;
  for (std::uint64_t k = 0; k < 10; ++k) {
    const double frequency = 0.2 + 0.1 * static_cast<double>(k) + 0.02 * random.normal(10'000 + k);
    sum += 0.27 * std::sin(2 * std::numbers::pi * (frequency * t + random.normal(20'000 + k)));
  }
  return sum;
}
double narrow(const hydro::RandomStream& /*random*/, double t) {
  return t < 2 ? 0 : 1.4 * std::exp(-0.15 * (t - 2)) * std::sin(3.8 * (t - 2));
}

/// How many of 400 sets have the truth within the interval of 95 %: film and record of these rates, 12 s and 14 s.
int covered(double (*motion_of)(const hydro::RandomStream&, double), Noise noise, int film_hz, int record_hz) {
  int within = 0;
  for (std::uint64_t set = 1; set <= 400; ++set) {
    const hydro::RandomStream random(set, 5);
    const double lag = 0.6 + 0.0001 * static_cast<double>(set);
    const auto measured = [&](int hz, double seconds, double late, double deviation, std::uint64_t stream) {
      const hydro::RandomStream of(set, stream);
      std::pair<std::vector<double>, std::vector<double>> out;
      double error = of.normal(100'000);
      for (int i = 0; i < seconds * hz; ++i) {
        error = noise.memory * error +
                std::sqrt(1 - noise.memory * noise.memory) * of.normal(static_cast<std::uint64_t>(i));
        out.first.push_back(static_cast<double>(i) / hz);
        out.second.push_back(motion_of(random, out.first.back() - late) + deviation * error);
      }
      return out;
    };
    const auto [time, value] = measured(film_hz, 12, 0, noise.film, 6);
    const auto [record_time, record] = measured(record_hz, 14, lag, noise.record, 7);
    const auto found = offset_between(time, value, record_time, record);
    within += std::abs(found.lag - lag) <= found.half_width;
  }
  return within;
}

// Of 400 intervals that hold with 95 % each, 380 do, with a deviation of 4.4: 368 to 392, 92 to 98 %, is 2.75 of them.
TEST(Offset, HasAnIntervalThatHoldsWithNoiseOnEitherRecord) {
  EXPECT_NEAR(covered(broad, {0.2, 0, 0}, 20, 40), 380, 12);
  EXPECT_NEAR(covered(broad, {0, 0.2, 0}, 20, 40), 380, 12);
  EXPECT_NEAR(covered(narrow, {0.2, 0, 0}, 20, 40), 380, 12);
  EXPECT_NEAR(covered(narrow, {0, 0.2, 0}, 20, 40), 380, 12);
}

TEST(Offset, HasAnIntervalThatHoldsWithNoiseOnBoth) {
  EXPECT_NEAR(covered(broad, {0.2, 0.2, 0}, 20, 40), 380, 12);
  EXPECT_NEAR(covered(broad, {0.2, 0.2, 0}, 30, 20), 380, 12) << "the film is the denser";
  EXPECT_NEAR(covered(narrow, {0.2, 0.2, 0}, 20, 40), 380, 12);
}

TEST(Offset, HasAnIntervalThatHoldsWithNoiseThatLasts) {
  EXPECT_NEAR(covered(broad, {0.2, 0.2, 0.8}, 20, 40), 380, 12);
  EXPECT_NEAR(covered(narrow, {0.2, 0.2, 0.8}, 20, 40), 380, 12);
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
