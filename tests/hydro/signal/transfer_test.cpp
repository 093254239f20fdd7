#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/signal/welch.hpp"

namespace transfer_test {
namespace {

using namespace hydro::signal;
using Complex = std::complex<double>;

std::vector<double> white(std::size_t n, std::uint64_t stream) {
  const hydro::RandomStream random(31, stream);
  std::vector<double> x(n);
  for (std::size_t j = 0; j < n; ++j) x[j] = random.normal(j);
  return x;
}

TEST(Transfer, OfADelayAndAGainIsExactForAPeriodicRecord) {
  // Period and segment alike, so shifting by one sample is multiplying by e^{−iω Δt} without any end effect.
  const auto one = white(64, 0);
  std::vector<double> x, y;
  for (std::size_t j = 0; j < 256; ++j) {
    x.push_back(one[j % 64]);
    y.push_back(2 * one[j % 64] - 0.7 * one[(j + 63) % 64]);
  }
  const auto t = transfer(x, y, 0.1, {.segment = 64, .overlap = 0, .window = Window::rectangular});
  for (std::size_t k = 1; k < 32; ++k) {
    const Complex exact = 2.0 - 0.7 * std::polar(1.0, -2 * std::numbers::pi * t.frequency_hz[k] * 0.1);
    EXPECT_LT(std::abs(t.h1[k] - exact), 1e-11);  // rounding over a bin's own size
    EXPECT_LT(std::abs(t.h2[k] - exact), 1e-11);
    EXPECT_NEAR(t.coherence[k], 1, 1e-11);
    EXPECT_LT(t.gain_relative_error[k], 1e-5);
  }
}

TEST(Transfer, BracketsTheTruthBetweenH1AndH2WhereTheOutputIsNoisy) {
  const auto x = white(60000, 1), e = white(60000, 2);
  std::vector<double> y(x.size());
  for (std::size_t j = 0; j < x.size(); ++j) y[j] = 2 * x[j] + e[j];
  const auto t = transfer(x, y, 1, {.segment = 128});
  double h1 = 0, h2 = 0, hv = 0, coherence = 0;
  for (std::size_t k = 2; k < 62; ++k) {
    hv += total_gain(t, k) / 60;
    h1 += std::abs(t.h1[k]) / 60;
    h2 += std::abs(t.h2[k]) / 60;
    coherence += t.coherence[k] / 60;
  }
  // S_yy/S_xx = 4 + 1, γ² = 4/5, |H2| = |H1|/γ² = 2.5. Error of |H1|: √(0.25/(2·900))/√60 = 0.15 %; ten of them.
  EXPECT_NEAR(h1, 2.0, 0.03);
  EXPECT_NEAR(h2, 2.5, 0.04);
  EXPECT_NEAR(hv, std::sqrt(5), 0.04);  // √(S_yy/S_xx)
  EXPECT_NEAR(coherence, 0.8, 0.01);
}

TEST(Transfer, StatesTheScatterOfItsGain) {
  // 400 records: the scatter of |H1| about 2 against the error formula; its own standard error is 1/√(2·400·15) = 0.9
  // %, using 30 bins of which two count as one. The formula is of first order in 1/n_d (n_d = 14): 6 % is asked.
  double scatter = 0, stated = 0;
  for (std::uint64_t record = 0; record < 400; ++record) {
    const auto x = white(1024, 1000 + 2 * record), e = white(1024, 1001 + 2 * record);
    std::vector<double> y(x.size());
    for (std::size_t j = 0; j < x.size(); ++j) y[j] = 2 * x[j] + e[j];
    const auto t = transfer(x, y, 1, {.segment = 128});
    for (std::size_t k = 16; k < 46; ++k) {
      scatter += std::pow(std::abs(t.h1[k]) / 2 - 1, 2);
      stated += std::pow(t.gain_relative_error[k], 2);
    }
  }
  EXPECT_NEAR(std::sqrt(scatter / stated), 1.0, 0.06);
}

TEST(Transfer, KeepsUnrelatedSignalsBelowTheCoherenceThreshold) {
  int below = 0, total = 0;
  for (std::uint64_t record = 0; record < 200; ++record) {
    const auto t = transfer(white(1024, 5000 + 2 * record), white(1024, 5001 + 2 * record), 1, {.segment = 128});
    for (std::size_t k = 2; k < 62; ++k, ++total) below += t.coherence[k] < t.coherence_threshold;
  }
  // Standard error √(0.05·0.95/(12000/1.5)) = 0.25 %; three of them, and 0.3 % for n_d not being a whole number.
  EXPECT_NEAR(static_cast<double>(below) / total, 0.95, 0.01);
}

TEST(Transfer, HasAThresholdOfCoherenceForTheConfidenceThatIsAskedFor) {
  EXPECT_NEAR(coherence_threshold(11, 0.95), 1 - std::pow(0.05, 0.1), 1e-15);  // (S10)
  EXPECT_NEAR(coherence_threshold(11, 0.99), 1 - std::pow(0.01, 0.1), 1e-15);
  EXPECT_THROW(coherence_threshold(11, 1), hydro::InputError);
}

TEST(Transfer, RefusesASingleSegmentAndUnequalRecords) {
  const auto x = white(128, 0);
  EXPECT_THROW(transfer(x, x, 1, {.segment = 128}), hydro::InputError);
  EXPECT_THROW(transfer(x, white(127, 0), 1, {.segment = 32}), hydro::InputError);
}

TEST(Transfer, HasNoAnswerWhereTheInputHasNoEnergy) {
  const std::vector<double> nothing(256, 0.0);
  const auto t = transfer(nothing, white(256, 0), 1, {.segment = 64});
  EXPECT_TRUE(std::isnan(t.h1[5].real()));
  EXPECT_TRUE(std::isnan(t.gain_relative_error[5]));
  EXPECT_EQ(t.coherence[5], 0);
}

}  // namespace
}  // namespace transfer_test
