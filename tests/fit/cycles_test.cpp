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

TEST(MeanCycle, IsWhatAllCyclesHaveInCommon) {
  // Cycles of 63.4 samples, so that no phase falls on samples twice.
  constexpr double length = 63.4;
  constexpr std::size_t points = 63, count = 12;
  const auto shape = [](double phase) { return std::cos(phase) + 0.3 * std::sin(3 * phase) + 0.1; };
  const auto noise = froude_test::ar1_noise(900, 0, 0.05, 4);
  std::vector<double> clean, noisy;
  for (std::size_t j = 0; j < 900; ++j) {
    clean.push_back(shape(2 * std::numbers::pi * (static_cast<double>(j) - 20.3) / length));
    noisy.push_back(clean[j] + noise[j]);
  }
  std::vector<fit::Cycle> cycles;
  for (std::size_t i = 0; i < count; ++i)
    cycles.push_back({20.3 + length * static_cast<double>(i), 20.3 + length * static_cast<double>(i + 1), 1});
  const auto mean = fit::mean_cycle(fit::on_phases(clean, cycles, points), points);
  ASSERT_EQ(mean.mean.size(), points);
  for (std::size_t k = 0; k < points; ++k)  // the cubic: 3/128 (3·2π/63.4)⁴ of the third harmonic is 6e-5
    EXPECT_NEAR(mean.mean[k], shape(2 * std::numbers::pi * static_cast<double>(k) / points), 1e-4);
  EXPECT_LT(mean.left, 2e-4);
  const auto rough = fit::mean_cycle(fit::on_phases(noisy, cycles, points), points);
  double error = 0, stated = 0;
  for (std::size_t k = 0; k < points; ++k) {
    error += std::pow(rough.mean[k] - mean.mean[k], 2) / points;
    stated += std::pow(rough.standard_error[k], 2) / points;
  }
  // A variance from 63 phases of 11 degrees of freedom each; the cubic passes 0.7 of white noise's variance, to both
  // alike.
  EXPECT_NEAR(std::sqrt(error), std::sqrt(stated), 0.3 * std::sqrt(stated));
  EXPECT_NEAR(std::sqrt(stated), 0.05 * std::sqrt(0.75 / count), 0.003);
}

TEST(MeanCycle, NeedsTwoWholeCyclesThatSwing) {
  const std::vector<double> level(100, 1.0);
  EXPECT_THROW(fit::mean_cycle(level, 50), hydro::InputError);
  EXPECT_THROW(fit::mean_cycle(level, 70), hydro::InputError);
  EXPECT_THROW(fit::on_phases(level, std::vector<fit::Cycle>{{50, 110, 1}}, 20), hydro::InputError);
  EXPECT_THROW(fit::on_phases(level, std::vector<fit::Cycle>{}, 20), hydro::InputError);
}

}  // namespace
}  // namespace cycles_test
