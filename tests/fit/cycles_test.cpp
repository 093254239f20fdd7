#include "fit/cycles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"

namespace cycles_test {
namespace {

/// Rest, three cycles that grow, `full` cycles, three that fall, rest; 100 samples a cycle.
std::vector<double> forced_motion(int full, double noise) {
  std::vector<double> x;
  const auto error = froude_test::ar1_noise(100 * static_cast<std::size_t>(full + 20), 0, 1, 3);
  for (int j = 0; j < 100 * (full + 16); ++j) {
    const double c = j / 100.0 - 5;  // cycles since the motion began
    const double rise = c < 0 ? 0 : c < 3 ? (std::floor(c) + 1) / 4 : 1;
    const double fall = c > full + 6 ? 0 : c > full + 3 ? (full + 6 - std::floor(c)) / 4 : 1;
    x.push_back(0.54 * std::min(rise, fall) * std::sin(2 * std::numbers::pi * c) +
                noise * error[static_cast<std::size_t>(j)]);
  }
  return x;
}

TEST(Cycles, AreCutAtUpCrossings) {
  const auto cycles = fit::find_cycles(forced_motion(14, 0));
  ASSERT_GE(cycles.size(), 18u);
  for (std::size_t i = 4; i < 16; ++i) {
    EXPECT_NEAR(cycles[i].end - cycles[i].start, 100, 1e-6);
    EXPECT_NEAR(cycles[i].amplitude, 0.54, 1e-3);
  }
}

TEST(Cycles, OfFullAmplitudeLeaveStartAndEndOut) {
  for (const double noise : {0.0, 0.002}) {
    const auto x = forced_motion(14, noise);
    const auto full = fit::full_amplitude(fit::find_cycles(x), 0.03);
    EXPECT_EQ(full.size(), 14u) << noise;
    EXPECT_NEAR(full.front().start, 800, 1 + 300 * noise);
    EXPECT_NEAR(full.back().end, 2200, 1 + 300 * noise);
  }
}

TEST(Cycles, NoiseAboutZeroMakesNone) {
  const auto cycles = fit::find_cycles(forced_motion(14, 0.01));
  EXPECT_LE(cycles.size(), 20u);
  EXPECT_GE(cycles.size(), 18u);
}

TEST(Cycles, RefuseARecordAtRest) {
  EXPECT_THROW(fit::find_cycles(std::vector<double>(100, 2.0)), hydro::InputError);
  EXPECT_THROW(fit::full_amplitude({}, 0.03), hydro::InputError);
}

}  // namespace
}  // namespace cycles_test
