// Records at another rate against the sinusoids that they are samples of.
#include "fit/resample.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"

namespace resample_test {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

std::vector<double> sampled(double hz, double step, std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t j = 0; j < n; ++j) x[j] = std::cos(two_pi * hz * step * static_cast<double>(j) + 0.4);
  return x;
}

/// Largest difference from a sinusoid of the given gain at the new instants.
double off(const fit::Resampler& r, double hz, double step, double new_step, double gain) {
  const auto y = r.apply(sampled(hz, step, 1500));
  double worst = 0;
  for (std::size_t k = 0; k < y.size(); ++k) {
    const double t = static_cast<double>(r.settling()) * step + new_step * static_cast<double>(k);
    worst = std::max(worst, std::abs(y[k] - gain * std::cos(two_pi * hz * t + 0.4)));
  }
  return worst;
}

TEST(Resampler, KeepsWhatLiesBelowItsBandwidthAndClosesAboveHalfTheLowerRate) {
  constexpr double step = 0.01;
  for (const double new_step : {0.005, 0.00731, 0.01, 0.013, 0.025, 0.1}) {
    const fit::Resampler r(step, new_step);
    const double lower = 1 / std::max(step, new_step);
    EXPECT_DOUBLE_EQ(r.bandwidth_hz(), 0.3 * lower);
    EXPECT_DOUBLE_EQ(r.closed_hz(), 0.5 * lower);
    // 60 dB of Kaiser's window: 1e-3, and as much again from the weights of each instant being made to add up to one.
    for (const double share : {0.02, 0.1, 0.2, 0.3})
      EXPECT_LT(off(r, share * lower, step, new_step, 1), 2e-3) << new_step;
    for (const double share : {0.5, 0.6, 0.9}) {
      if (share * lower > 0.5 / step) continue;  // beyond what the record itself can hold
      EXPECT_LT(off(r, share * lower, step, new_step, 0), 2e-3) << new_step;
    }
  }
}

TEST(Resampler, HasTheGainThatItStates) {
  const fit::Resampler r(0.01, 0.03);  // every third sample: instants fall on samples
  for (const double hz : {1.0, 9.0, 12.0, 14.0, 16.0, 30.0})
    EXPECT_LT(off(r, hz, 0.01, 0.03, r.gain(two_pi * hz)), 1e-9);
  EXPECT_NEAR(r.gain(0), 1, 1e-12);
}

TEST(Resampler, LeavesAConstantWhatItIsAndCountsItsSamples) {
  const fit::Resampler r(0.01, 0.0137);
  const auto y = r.apply(std::vector<double>(1000, 2.5));
  for (const double v : y) ASSERT_NEAR(v, 2.5, 1e-12);
  const double room = 999 - 2 * static_cast<double>(r.settling());
  EXPECT_EQ(y.size(), static_cast<std::size_t>(room / 1.37) + 1);
}

TEST(Resampler, RefusesWhatItCannotDo) {
  EXPECT_THROW(fit::Resampler(0.01, 0), hydro::InputError);
  EXPECT_THROW(fit::Resampler(-0.01, 0.1), hydro::InputError);
  EXPECT_THROW(fit::Resampler(0.01, 1).apply(std::vector<double>(300, 1.0)), hydro::InputError);
}

}  // namespace
}  // namespace resample_test
