#include "fit/filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"

namespace filter_test {
namespace {

using fit::ZeroPhaseFilter;
constexpr double step = 0.01, two_pi = 2 * std::numbers::pi;

std::vector<double> sinusoid(double hz, std::size_t n, double phase = 0.3) {
  std::vector<double> x(n);
  for (std::size_t j = 0; j < n; ++j) x[j] = std::cos(two_pi * hz * step * static_cast<double>(j) + phase);
  return x;
}

std::vector<ZeroPhaseFilter> one_of_each() {
  return {ZeroPhaseFilter::butterworth(4, 3.33, step),
          ZeroPhaseFilter::butterworth(5, 8, step),
          ZeroPhaseFilter::chebyshev(4, 0.005, 3.33, step),
          ZeroPhaseFilter::chebyshev(3, 0.01, 8, step),
          ZeroPhaseFilter::gaussian(4, step),
          ZeroPhaseFilter::finite(4, step),
          ZeroPhaseFilter::notch(20, 4, step),
          ZeroPhaseFilter::moving_average(11, step)};
}

TEST(ZeroPhaseFilter, GivesBackASinusoidInPhaseTimesItsGain) {
  for (const auto& f : one_of_each())
    for (const double hz : {0.3, 2.0, 3.33, 9.0, 20.0, 35.0}) {
      const auto x = sinusoid(hz, 3000), y = f.apply(x);
      ASSERT_EQ(y.size(), x.size() - 2 * f.settling());
      const double gain = f.gain(two_pi * hz);
      // What lies beyond the ends is felt to 1e-4; two passes of up to five sections add up.
      for (std::size_t j = 0; j < y.size(); ++j)
        ASSERT_NEAR(y[j], gain * x[j + f.settling()], 2e-3) << f.name() << " at " << hz << " Hz, sample " << j;
    }
}

TEST(ZeroPhaseFilter, LetsAConstantAndAMeanPassUnchanged) {
  for (const auto& f : one_of_each()) {
    EXPECT_NEAR(f.gain(0), 1, 1e-12) << f.name();
    for (const double y : f.apply(std::vector<double>(2000, 7.5))) ASSERT_NEAR(y, 7.5, 1e-10) << f.name();
  }
}

TEST(ZeroPhaseFilter, OfButterworthHasTheGainOfTheClosedForm) {
  for (const int order : {1, 2, 3, 4, 7}) {
    const auto f = ZeroPhaseFilter::butterworth(order, 3.33, step);
    for (const double hz : {0.5, 2.0, 3.33, 5.0, 20.0}) {
      const double warped = std::tan(std::numbers::pi * hz * step) / std::tan(std::numbers::pi * 3.33 * step);
      EXPECT_NEAR(f.gain(two_pi * hz), 1 / (1 + std::pow(warped, 2 * order)), 1e-12);
    }
    EXPECT_NEAR(f.gain(two_pi * 3.33), 0.5, 1e-12);
  }
}

// T_n by its recursion, in place of cosines.
double chebyshev_polynomial(int n, double x) {
  double before = 1, now = x;
  for (int k = 1; k < n; ++k) before = std::exchange(now, 2 * x * now - before);
  return now;
}

TEST(ZeroPhaseFilter, OfChebyshevHasTheGainOfTheClosedForm) {
  for (const int order : {2, 3, 4, 7, 10})
    for (const double ripple : {1e-4, 0.005, 0.1}) {
      const auto f = ZeroPhaseFilter::chebyshev(order, ripple, 3.33, step);
      const double square = order % 2 == 0 ? ripple : ripple / (1 - ripple), top = order % 2 == 0 ? 1 + square : 1;
      const double wanted = std::sqrt((2 * top - 1) / square);
      double low = 1, high = 1e5;  // T_n rises there: where it makes the gain ½
      for (int i = 0; i < 100; ++i)
        (chebyshev_polynomial(order, (low + high) / 2) < wanted ? low : high) = (low + high) / 2;
      for (double hz = 0.05; hz < 45; hz += 0.37) {
        const double warped = std::tan(std::numbers::pi * hz * step) / std::tan(std::numbers::pi * 3.33 * step);
        const double gain = f.gain(two_pi * hz), t = chebyshev_polynomial(order, low * warped);
        EXPECT_NEAR(gain, top / (1 + square * t * t), 1e-9) << order << ' ' << ripple << ' ' << hz;  // rounding
        if (low * warped < 1) {
          EXPECT_LE(gain, (order % 2 == 0 ? 1 + ripple : 1) + 1e-9);
          EXPECT_GE(gain, (order % 2 == 0 ? 1 : 1 - ripple) - 1e-9);
        }
      }
      EXPECT_NEAR(f.gain(two_pi * 3.33), 0.5, 1e-9);
    }
  EXPECT_THROW(ZeroPhaseFilter::chebyshev(4, 0.2, 3, step), hydro::InputError);
  EXPECT_THROW(ZeroPhaseFilter::chebyshev(1, 0.01, 3, step), hydro::InputError);
}

TEST(ZeroPhaseFilter, OfGaussianWeightsHasTheGainOfABell) {
  for (const double cutoff : {0.5, 4.0, 19.9}) {
    const auto f = ZeroPhaseFilter::gaussian(cutoff, step);
    for (double share = 0; share <= 1; share += 0.1)
      EXPECT_NEAR(f.gain(two_pi * share * cutoff), std::exp(-std::log(2) * share * share), 1e-4) << cutoff;
  }
  EXPECT_THROW(ZeroPhaseFilter::gaussian(21, step), hydro::InputError);
}

TEST(ZeroPhaseFilter, OfSymmetricWeightsKeepsItsBands) {
  const auto f = ZeroPhaseFilter::finite(4, step);
  for (double hz = 0; hz < 2; hz += 0.05) EXPECT_NEAR(f.gain(two_pi * hz), 1, 2e-3) << hz;
  for (double hz = 6; hz < 50; hz += 0.25) EXPECT_NEAR(f.gain(two_pi * hz), 0, 2e-3) << hz;
  EXPECT_NEAR(f.gain(two_pi * 4), 0.5, 1e-2);
}

TEST(ZeroPhaseFilter, NotchesOneLineAndLeavesTheRest) {
  const auto f = ZeroPhaseFilter::notch(20, 4, step);
  EXPECT_NEAR(f.gain(two_pi * 20), 0, 1e-12);
  EXPECT_NEAR(f.gain(two_pi * 22), 0.5, 0.05);  // the edges are equally far only on the warped axis
  EXPECT_NEAR(f.gain(two_pi * 18), 0.5, 0.05);
  EXPECT_GT(f.gain(two_pi * 5), 0.95);
}

TEST(ZeroPhaseFilter, StatesItsBandwidth) {
  const auto f = ZeroPhaseFilter::butterworth(4, 3.33, step);
  EXPECT_NEAR(f.gain(two_pi * f.bandwidth_hz()), 0.99, 1e-9);
  EXPECT_NEAR(f.bandwidth_hz(), 3.33 * std::pow(0.01 / 0.99, 1.0 / 8), 0.01);  // 1 − gain ≈ (f/f_c)^2n, little warped
}

TEST(ZeroPhaseFilter, IsLinear) {
  const auto a = froude_test::ar1_noise(1500, 0.9, 1, 3), b = sinusoid(1.3, 1500);
  std::vector<double> sum(1500);
  for (std::size_t j = 0; j < sum.size(); ++j) sum[j] = 2 * a[j] - 3 * b[j];
  for (const auto& f : one_of_each()) {
    const auto fa = f.apply(a), fb = f.apply(b), fs = f.apply(sum);
    for (std::size_t j = 0; j < fs.size(); ++j) ASSERT_NEAR(fs[j], 2 * fa[j] - 3 * fb[j], 1e-10) << f.name();
  }
}

TEST(ZeroPhaseFilter, RefusesWhatCannotBeFiltered) {
  EXPECT_THROW(ZeroPhaseFilter::butterworth(4, 50, step), hydro::InputError);  // half the sampling rate
  EXPECT_THROW(ZeroPhaseFilter::butterworth(0, 3, step), hydro::InputError);
  EXPECT_THROW(ZeroPhaseFilter::notch(3, 4, step), hydro::InputError);
  EXPECT_THROW(ZeroPhaseFilter::moving_average(10, step), hydro::InputError);
  EXPECT_THAT([] { ZeroPhaseFilter::butterworth(4, 0.01, step).apply(sinusoid(1, 500)); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("nothing would be left")));
}

}  // namespace
}  // namespace filter_test
