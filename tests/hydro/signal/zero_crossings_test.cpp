#include "hydro/signal/zero_crossings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "hydro/signal/fft.hpp"
#include "hydro/signal/welch.hpp"
#include "support/reference_data.hpp"

namespace zero_crossings_test {
namespace {

using namespace hydro::signal;
using testing::HasSubstr;
using testing::ThrowsMessage;

struct Record {
  std::vector<double> time, values;
};

Record sine(double period, double samples_per_period, double periods, double phase) {
  Record r;
  const auto n = static_cast<std::size_t>(samples_per_period * periods);
  for (std::size_t j = 0; j < n; ++j) {
    r.time.push_back(static_cast<double>(j) * period / samples_per_period);
    r.values.push_back(std::sin(2 * std::numbers::pi * static_cast<double>(j) / samples_per_period + phase));
  }
  return r;
}

TEST(SingleWaves, OfASineHaveItsPeriodAndHeight) {
  const auto r = sine(8, 40, 25, -0.3);
  const auto waves = single_waves(r.time, r.values);
  ASSERT_EQ(waves.size(), 24u);  // 25 up-crossings enclose 24 waves
  for (const auto& wave : waves) {
    EXPECT_NEAR(wave.period, 8, 1e-3);  // linear crossings of a sampled sine, O(Δt³)
    EXPECT_LE(wave.height(), 2);
    EXPECT_GE(wave.height(), 2 * std::cos(std::numbers::pi / 40));  // the bound of the header
  }
}

TEST(SingleWaves, AreCutOnceWhereASampleIsExactlyZeroAndNotWhereTheMeanIsOnlyTouched) {
  const std::vector<double> t{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
  const std::vector<double> zeros{-1, 0, 1, 0, -1, 0, 1, 0, -1, 0, 1};  // mean 0
  const auto waves = single_waves(t, zeros);
  ASSERT_EQ(waves.size(), 2u);
  EXPECT_DOUBLE_EQ(waves[0].start_s, 1);
  EXPECT_DOUBLE_EQ(waves[0].period, 4);
  const std::vector<double> touching{-2, 0, -1, 3, 0, 2, -2, 0, -2, 3, -1};  // mean 0; touches at 1, 4, 7
  EXPECT_EQ(single_waves(t, touching).size(), 1u);
}

// Rising by six amplitudes, a record crosses its mean in a third of its waves only.
TEST(SingleWaves, OfARecordThatDriftsAreCountedAboutItsLine) {
  auto r = sine(8, 40, 75, -0.3);
  for (std::size_t j = 0; j < r.time.size(); ++j) r.values[j] += 6 * r.time[j] / r.time.back();
  const Trend trend = trend_of(r.time, r.values);
  EXPECT_TRUE(trend.is_drift());
  EXPECT_NEAR(trend.slope, 6 / r.time.back(), 0.01 * 6 / r.time.back());
  const auto waves = single_waves(r.time, r.values);
  EXPECT_EQ(waves.size(), 74u);
  EXPECT_NEAR(wave_statistics(waves).h13, 2, 0.02);
  EXPECT_FALSE(trend_of(sine(8, 40, 3, 0).time, sine(8, 40, 3, 0).values).is_drift());
}

TEST(WaveStatistics, OfANarrowBandGaussianSignalFollowRayleigh) {
  // A Gaussian signal from 3 % of bandwidth around one frequency: 2^19 samples, 32 per wave, some 16 000 waves.
  constexpr std::size_t n = 1u << 19;
  const hydro::RandomStream random(5, 0);
  std::vector<std::complex<double>> half(n / 2 + 1);
  for (std::size_t k = n / 32 - n / 2048; k < n / 32 + n / 2048; ++k)
    half[k] = {random.normal(2 * k), random.normal(2 * k + 1)};
  const auto x = inverse_real_fft(half, n);
  std::vector<double> t(n);
  double variance = 0;
  for (std::size_t j = 0; j < n; ++j) {
    t[j] = static_cast<double>(j);
    variance += x[j] * x[j] / static_cast<double>(n);
  }
  const auto s = wave_statistics(single_waves(t, x));
  // Rayleigh: H_rms = √(8 m₀), mean of the highest third 4.004 √m₀, mean √(2π m₀). 512 independent envelope values
  // scatter by about half their mean, 1/(2√512) = 2.2 %, of which dividing by the record's own σ removes most: 2.5 % is
  // asked.
  EXPECT_NEAR(s.h13 / std::sqrt(variance), 4.004, 0.025 * 4.004);
  EXPECT_NEAR(s.mean_height / std::sqrt(variance), std::sqrt(2 * std::numbers::pi), 0.025 * 2.507);
  EXPECT_NEAR(s.mean_period, 32, 0.01 * 32);  // Rice: √(m₀/m₂), the band's middle within its width of 3 %
}

TEST(WaveStatistics, SayWhenARecordIsTooShort) {
  const auto r = sine(8, 40, 3, 0.1);
  EXPECT_THAT([&] { wave_statistics(single_waves(r.time, r.values)); },
              ThrowsMessage<hydro::InputError>(HasSubstr("holds 1 complete waves")));
  EXPECT_THROW(single_waves(std::vector<double>{0, 0}, std::vector<double>{1, 2}), hydro::InputError);
  EXPECT_THROW(single_waves(std::vector<double>{0, 1}, std::vector<double>{1}), hydro::InputError);
  EXPECT_THROW(single_waves(std::vector<double>{0, 1}, std::vector<double>{1, std::nan("")}), hydro::InputError);
}

TEST(MeasuredSea, HasTheKnownHeightsAndPeriods) {
  FROUDE_REQUIRE_DATA(path, "waves_measured/wafo/sea.dat");
  std::ifstream file(path);
  Record r;
  for (double t = 0, x = 0; file >> t >> x;) {
    r.time.push_back(t);
    r.values.push_back(x);
  }
  ASSERT_EQ(r.values.size(), 9524u);
  const auto s = wave_statistics(single_waves(r.time, r.values));
  // Reference values from another program, stated to the digits shown.
  EXPECT_EQ(s.count, 534u);
  EXPECT_NEAR(s.mean_period, 4.4488, 1e-4);
  EXPECT_NEAR(s.h13, 1.7715, 1e-4);
  EXPECT_NEAR(s.highest, 2.93, 5e-3);
  const double step = even_step(r.time);
  const auto w = welch(r.values, step, {.segment = 512});
  const auto m = moments(w.spectrum, whole(w.spectrum));
  EXPECT_NEAR(4 * std::sqrt(w.variance), 1.89192, 2e-4);  // ours divides by n, the reference may by n − 1
  EXPECT_NEAR(m.hs(), 1.9004, 1e-3);                      // f = 0 left out there: half a bin of little energy
  EXPECT_NEAR(m.tm01(), 4.880, 5e-3);
  EXPECT_NEAR(m.tm02(), 4.122, 2e-3);
  EXPECT_NEAR(m.te(), 6.321, 0.03);
}

// Of a sine with any phase, N samples a wave: crests lie 1 − sin(π/N)/(π/N) above the highest samples on average.
TEST(MissedOfCrests, IsWhatTheSamplesOfASineMiss) {
  for (const double per_wave : {3.83, 8.17, 20.31}) {
    Record r;
    double highest = 0;
    int waves = 0;
    for (int i = 0; i < 20000; ++i) {
      r.time.push_back(0.1 * i);
      r.values.push_back(std::sin(2 * std::numbers::pi * i / per_wave));
    }
    for (const auto& w : single_waves(r.time, r.values)) highest += w.crest, ++waves;
    const double missed = 1 - highest / waves;
    // Of some thousand phases; a part of a wave at the end moves the mean, from which crests are told, by 3e-4.
    EXPECT_NEAR(missed_of_crests(r.time, r.values), missed, 0.02 * missed + 3e-4) << per_wave;
  }
}

}  // namespace
}  // namespace zero_crossings_test
