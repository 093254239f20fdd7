#include "hydro/signal/peaks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/signal/extremes.hpp"
#include "support/gaussian_record.hpp"

namespace peaks_test {
namespace {

using namespace hydro::signal;
using testing::ElementsAre, testing::HasSubstr, testing::ThrowsMessage;

TEST(Crests, AreTheLargestValuesBetweenUpCrossings) {
  const std::vector<double> t{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13},
      x{-1, 2, -1, 1, -1, 3, 1, -2, 1, -1, 1, -1, -2, 1};
  EXPECT_THAT(crests(t, x), ElementsAre(2, 1, 3, 1, 1));
}

// P(y) = (1 + ξy/σ)^{−1/ξ}: values at evenly spread probabilities are a sample without chance.
TEST(ParetoTail, HasScaleAndShapeOfItsSample) {
  for (const double xi : {-0.3, 0.0, 0.2}) {
    std::vector<double> peaks;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double left = (i + 0.5) / n;
      peaks.push_back(5 + (xi == 0 ? -2 * std::log(left) : 2 * (std::pow(left, -xi) - 1) / xi));
    }
    const ParetoTail tail = fit_tail(peaks, 5, 1e5);
    EXPECT_NEAR(tail.scale, 2, 0.01) << xi;  // the largest of n is cut at half a step of probability
    EXPECT_NEAR(tail.shape, xi, 0.005) << xi;
    EXPECT_NEAR(tail.rate_hz, n / 1e5, 1e-12);
    const double level = tail.largest_not_exceeded(1e5, 0.9);
    EXPECT_NEAR(n * tail.share_above(level), -std::log(0.9), 1e-6);  // Poisson
  }
}

TEST(BlockMaxima, HaveLocationAndScaleOfTheirSample) {
  std::vector<double> maxima;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) maxima.push_back(7 - 1.5 * std::log(-std::log((i + 0.5) / n)));
  const BlockMaxima fit = fit_maxima(maxima, 600);
  EXPECT_NEAR(fit.location, 7, 2e-3);
  EXPECT_NEAR(fit.scale, 1.5, 2e-3);
  // The largest of six blocks is Gumbel too, by scale · ln 6 further.
  EXPECT_NEAR(fit.largest_not_exceeded(3600, 0.5) - fit.largest_not_exceeded(600, 0.5), fit.scale * std::log(6), 1e-9);
}

TEST(BlockMaxima, AreOfWholeBlocksWithSamples) {
  std::vector<double> t, x;
  for (int i = 0; i < 45; ++i)
    if (i < 22 || i > 29) t.push_back(i), x.push_back(i % 10);  // the third block has two samples
  EXPECT_THAT(block_maxima(t, x, 10), ElementsAre(9, 9, 9));
}

// Of a Gaussian record that lasts ten times as long as the duration asked for, both estimates are near Rice's law; and
// their intervals of 90 % hold it for most of 60 records: the Gumbel law of 20 maxima is biased by a few per cent.
TEST(Extremes, OfGaussianRecordsAreNearRicesLaw) {
  const auto s = froude_test::box_spectrum(0.05, 0.15);
  const double expected = GaussianPeaks(moments(s, whole(s)), PeakLaw::rice).largest_not_exceeded(1000, 0.5);
  int tails = 0, blocks = 0;
  double mean_tail = 0, mean_block = 0;
  constexpr int records = 60;
  std::vector<double> t;
  for (int i = 0; i < 10000; ++i) t.push_back(i);
  for (int r = 0; r < records; ++r) {
    const auto x = froude_test::gaussian_record([](double f) { return f > 0.05 && f < 0.15 ? 1.0 : 0.0; }, t.size(), 1,
                                                static_cast<std::uint64_t>(r));
    const auto all = crests(t, x);
    const double threshold = 1.5 * std::sqrt(0.1);
    const ParetoTail tail = fit_tail(all, threshold, 10000);
    const auto above =
        static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](double p) { return p > threshold; }));
    const auto maxima = block_maxima(t, x, 500);
    const BlockMaxima fit = fit_maxima(maxima, 500);
    mean_tail += tail.largest_not_exceeded(1000, 0.5) / records;
    mean_block += fit.largest_not_exceeded(1000, 0.5) / records;
    const Interval a = interval_of(tail, above, 1000, 0.5, 0.9), b = interval_of(fit, maxima.size(), 1000, 0.5, 0.9);
    tails += a.low <= expected && expected <= a.high ? 1 : 0;
    blocks += b.low <= expected && expected <= b.high ? 1 : 0;
  }
  EXPECT_NEAR(mean_tail, expected, 0.03 * expected);  // crests between samples are missed by up to a per cent
  EXPECT_NEAR(mean_block, expected, 0.03 * expected);
  // 54 of 60 with a deviation of 2.3; four of them, for what samples miss.
  EXPECT_GE(tails, 44);
  EXPECT_GE(blocks, 44);
}

TEST(Extremes, RefuseWhatHasNoTail) {
  const std::vector<double> few(5, 1.0), alike(20, 2.0);
  EXPECT_THAT([&] { fit_tail(few, 0, 10); }, ThrowsMessage<hydro::InputError>(HasSubstr("a tail needs 10")));
  EXPECT_THAT([&] { fit_tail(alike, 0, 10); }, ThrowsMessage<hydro::InputError>(HasSubstr("alike")));
  EXPECT_THAT([&] { fit_maxima(few, 10); }, ThrowsMessage<hydro::InputError>(HasSubstr("alike")));
}

}  // namespace
}  // namespace peaks_test
