#include "hydro/signal/welch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace welch_test {
namespace {

using namespace hydro::signal;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<double> white(std::size_t n, std::uint64_t stream, double sigma = 1) {
  const hydro::RandomStream random(21, stream);
  std::vector<double> x(n);
  for (std::size_t j = 0; j < n; ++j) x[j] = sigma * random.normal(j);
  return x;
}

double area(const SpectrumPerHz& s) { return moments(s, whole(s)).m0; }

TEST(Welch, WithOneRectangularSegmentKeepsTheVarianceExactly) {
  const auto x = white(500, 0, 3);
  for (const auto detrend : {Detrend::record_mean, Detrend::segment_mean}) {
    const auto w = welch(x, 0.2, {.segment = 500, .overlap = 0, .window = Window::rectangular, .detrend = detrend});
    EXPECT_NEAR(area(w.spectrum), w.variance, 1e-12 * w.variance);  // Parseval, rounding only
  }
}

TEST(Welch, KeepsTheWindowedVarianceExactly) {
  const auto x = white(64, 0);
  const auto w = welch(x, 0.1, {.segment = 64, .detrend = Detrend::record_mean});
  double sum = 0, weights = 0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double hann = std::pow(std::sin(std::numbers::pi * static_cast<double>(j) / 64), 2);
    sum += std::pow(hann * (x[j] - w.mean), 2);
    weights += hann * hann;
  }
  EXPECT_NEAR(area(w.spectrum), sum / weights, 1e-12);  // Parseval
}

TEST(Welch, PutsASinusoidOnItsBinWithHalfItsSquare) {
  std::vector<double> x(2000);
  for (std::size_t j = 0; j < x.size(); ++j)
    x[j] = 5 + 1.7 * std::cos(2 * std::numbers::pi * 0.1 * static_cast<double>(j) + 1);
  const auto w = welch(x, 1.0, {.segment = 200});
  EXPECT_NEAR(area(w.spectrum), 1.7 * 1.7 / 2, 1e-10);  // on a bin, Hann leaks into two neighbours only: exact
  const auto p = peak(w.spectrum, whole(w.spectrum));
  EXPECT_NEAR(p.frequency_hz, 0.1, 1e-12);
  EXPECT_NEAR(p.density, 1.7 * 1.7 / 2 / w.resolution_hz, 1e-9);  // power over the equivalent noise bandwidth
  EXPECT_NEAR(w.mean, 5, 1e-12);
}

TEST(Welch, GivesWhiteNoiseItsFlatOneSidedDensity) {
  const auto x = white(200000, 1, 2);
  const auto w = welch(x, 0.5, {.segment = 256});
  double mean = 0;
  for (std::size_t k = 2; k < 128; ++k) mean += w.spectrum.density[k] / 126;
  // One-sided: σ²/(half the sampling rate) = 4/1 per Hz. Relative standard error √(2/200000) = 0.3 %, five of them
  // asked.
  EXPECT_NEAR(mean, 4.0, 5 * 4 * std::sqrt(2.0 / 200000));
}

TEST(Welch, SlowDriftStaysOnlyWhereTheRecordMeanIsTakenOff) {
  std::vector<double> x(4096);
  for (std::size_t j = 0; j < x.size(); ++j) x[j] = std::sin(2 * std::numbers::pi * static_cast<double>(j) / 4096);
  const WelchOptions keep{.segment = 128, .detrend = Detrend::record_mean};
  const WelchOptions drop{.segment = 128, .detrend = Detrend::segment_mean};
  EXPECT_NEAR(area(welch(x, 1, keep).spectrum), 0.5,
              0.01);  // ends weigh less than the middle: about one segment in 32·2
  EXPECT_LT(area(welch(x, 1, drop).spectrum), 0.005);
}

TEST(WelchDof, IsTwicePerSegmentWithoutOverlapAsBartlettHasIt) {
  EXPECT_DOUBLE_EQ(welch_dof(1, {.segment = 64}), 2);
  EXPECT_DOUBLE_EQ(welch_dof(10, {.segment = 64, .overlap = 0}), 20);
  EXPECT_DOUBLE_EQ(welch_dof(10, {.segment = 64, .overlap = 0, .window = Window::rectangular}), 20);
}

TEST(WelchDof, OfHalfOverlappingHannIsTheKnownOne) {
  // ρ = Σ sin²cos² / Σ sin⁴ = (1/8)/(3/8) over half the window = 1/6, so ν = 2K/(1 + 2 (K−1)/K /36) exactly.
  for (const std::size_t k : {2u, 15u, 100u})
    EXPECT_NEAR(welch_dof(k, {.segment = 512}), 2.0 * k / (1 + 2 * (k - 1.0) / k / 36), 1e-10 * k);
}

TEST(ConfidenceBand, HoldsWhiteNoiseAsOftenAsItSays) {
  // 300 records of 15 segments; bins 2 … 62 of 64. Neighbouring bins correlate under Hann, about 1.5 bins count as one:
  // standard error √(0.05·0.95/(300·61/1.5)) = 0.2 %. Three of them, and the χ² form itself is an approximation of
  // order 0.3 % for correlated segments.
  int inside = 0, total = 0;
  for (std::uint64_t record = 0; record < 300; ++record) {
    const auto w = welch(white(1024, 100 + record), 1.0, {.segment = 128});
    const auto band = confidence_band(w.dof, 0.95);
    for (std::size_t k = 2; k <= 62; ++k, ++total)
      inside += w.spectrum.density[k] * band.lower < 2.0 && 2.0 < w.spectrum.density[k] * band.upper;
  }
  EXPECT_NEAR(static_cast<double>(inside) / total, 0.95, 0.009);
}

TEST(EvenStep, AcceptsRoundedTimesAndNamesTheFirstGap) {
  EXPECT_NEAR(even_step(std::vector<double>{0, 0.333, 0.667, 1.0}), 1.0 / 3, 1e-12);
  EXPECT_THAT(
      [] {
        even_step(std::vector<double>{0, 1, 2, 4});
      },
      ThrowsMessage<hydro::InputError>(HasSubstr("from sample 3 at 2 s to the next 2 s pass")));
  EXPECT_THROW(even_step(std::vector<double>{1}), hydro::InputError);
  EXPECT_THROW(even_step(std::vector<double>{1, 0}), hydro::InputError);
}

TEST(Welch, RefusesWhatItCannotUse) {
  const auto x = white(100, 0);
  EXPECT_THAT([&] { welch(x, 1, {.segment = 128}); }, ThrowsMessage<hydro::InputError>(HasSubstr("has 100 samples")));
  EXPECT_THROW(welch(x, 1, {.segment = 33}), hydro::InputError);
  EXPECT_THROW(welch(x, 1, {.segment = 32, .overlap = 1}), hydro::InputError);
  EXPECT_THROW(welch(x, 0, {.segment = 32}), hydro::InputError);
  EXPECT_THROW(welch(std::vector<double>(64, std::nan("")), 1, {.segment = 32}), hydro::InputError);
  EXPECT_THROW(fifteen_segments(31), hydro::InputError);
  EXPECT_EQ(welch(white(1024, 0), 1, fifteen_segments(1024)).segments, 15u);
}

}  // namespace
}  // namespace welch_test
