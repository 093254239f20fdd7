#include "fit/band_pass.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"

namespace band_pass_test {
namespace {

using fit::BandPass;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double band_step = 0.1, two_pi = 2 * std::numbers::pi;

/// (F17), with frequencies as the bilinear transform bends them.
double low_pass_gain(double hz, double cutoff_hz) {
  const double pi = std::numbers::pi;
  return 1 / (1 + std::pow(std::tan(pi * hz * band_step) / std::tan(pi * cutoff_hz * band_step), 8));
}

TEST(BandPass, HasTheGainOfOneLowPassLessAnother) {
  const BandPass band(0.05, 0.5, band_step);
  for (const double hz : {0.0, 0.01, 0.05, 0.1, 0.2, 0.5, 1.0, 3.0})
    EXPECT_NEAR(band.gain(two_pi * hz), low_pass_gain(hz, 0.5) - low_pass_gain(hz, 0.05), 1e-12) << hz << " Hz";
  EXPECT_NEAR(BandPass(0.05, std::nullopt, band_step).gain(two_pi * 3), 1 - low_pass_gain(3, 0.05), 1e-12);
}

TEST(BandPass, GivesBackASinusoidInPhaseTimesItsGain) {
  const BandPass band(0.05, 0.5, band_step);
  for (const double hz : {0.02, 0.05, 0.1, 0.15, 0.3, 0.5, 0.8}) {
    std::vector<double> x(6000);
    for (std::size_t j = 0; j < x.size(); ++j) x[j] = std::cos(two_pi * hz * band_step * static_cast<double>(j) + 0.3);
    const auto y = band.apply(x);
    ASSERT_EQ(y.size(), x.size() - 2 * band.settling());
    // What lies beyond the ends is felt to 1e-4 by each section of each pass, as in ZeroPhaseFilter.
    for (std::size_t j = 0; j < y.size(); ++j)
      ASSERT_NEAR(y[j], band.gain(two_pi * hz) * x[j + band.settling()], 2e-3) << hz << " Hz, sample " << j;
  }
}

// The record is taken to have stood at its first value before it began, which a line did not: 1e-4 of what that
// supposition makes in the memory of the filter, some 1/(2π 0.05 Hz) = 3.2 s of slope, is left next to what is given
// up.
TEST(BandPass, LetsNoMeanAndNoLinePass) {
  const BandPass band(0.05, 0.5, band_step);
  std::vector<double> x(6000);
  for (std::size_t j = 0; j < x.size(); ++j) x[j] = 40 + 2.0 * band_step * static_cast<double>(j);
  for (const double y : band.apply(x)) ASSERT_NEAR(y, 0, 10 * 1e-4 * 2.0 * 3.2);
}

TEST(BandPass, StatesWhereItIsFlat) {
  const BandPass band(0.05, 0.5, band_step);
  const auto [low, high] = band.flat_hz().value();
  for (const double hz : {low, std::sqrt(low * high), high})
    EXPECT_LE(std::abs(band.gain(two_pi * hz) - 1), 0.01 + 1e-9);
  EXPECT_GT(std::abs(band.gain(two_pi * 0.99 * low) - 1), 0.01);
  EXPECT_GT(std::abs(band.gain(two_pi * 1.01 * high) - 1), 0.01);
  EXPECT_FALSE(BandPass(0.1, 0.2, band_step).flat_hz()) << "0.88 at its middle";
}

TEST(BandPass, RefusesWhatIsNoBandAndWhatLeavesNothing) {
  using hydro::InputError;
  EXPECT_THAT([] { BandPass(0.5, 0.05, band_step); },
              ThrowsMessage<InputError>(HasSubstr("write the lower edge first")));
  EXPECT_THAT([] { BandPass(0.05, 5, band_step); }, ThrowsMessage<InputError>(HasSubstr("half the sampling rate")));
  EXPECT_THAT([] { BandPass(0, 0.5, band_step); }, ThrowsMessage<InputError>(HasSubstr("half the sampling rate")));
  EXPECT_THAT([] { BandPass(0.05, 0.5, band_step).apply(std::vector<double>(300, 1.0)); },
              ThrowsMessage<InputError>(testing::AllOf(HasSubstr("nothing would be left"), HasSubstr("29.9 s long"),
                                                       HasSubstr("raise the lower edge"))));
}

}  // namespace
}  // namespace band_pass_test
