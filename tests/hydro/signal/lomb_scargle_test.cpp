#include "hydro/signal/lomb_scargle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "support/gaussian_record.hpp"

namespace lomb_scargle_test {
namespace {

using namespace hydro::signal;
using testing::HasSubstr, testing::ThrowsMessage;

double smooth(double f) {
  return f > 0.05 && f < 0.3 ? std::pow(std::sin(std::numbers::pi * (f - 0.05) / 0.25), 2) : 0;
}

std::vector<double> even(std::size_t n, double step) {
  std::vector<double> t;
  for (std::size_t i = 0; i < n; ++i) t.push_back(step * static_cast<double>(i));
  return t;
}

// Three lines of Hann's window on a grid that fits the segment: the mean, the cosine and the sine are orthogonal to
// each other under it from the third frequency on.
TEST(LombScargle, OfAnEvenRecordIsWelchs) {
  const auto x = froude_test::gaussian_record(smooth, 4096, 1, 1);
  const auto expected = welch(x, 1, {.segment = 256});
  const auto found = lomb_scargle(even(4096, 1), x, 256, 0.5);
  EXPECT_EQ(found.segments, expected.segments);
  EXPECT_EQ(found.dof, expected.dof);
  for (std::size_t k = 3; k < 120; ++k) {
    EXPECT_DOUBLE_EQ(found.spectrum.frequency_hz[k - 1], expected.spectrum.frequency_hz[k]);
    EXPECT_NEAR(found.spectrum.density[k - 1], expected.spectrum.density[k], 1e-9) << k;
  }
}

// A third of the samples at random, and a gap of a tenth of the record: the variance is there, where it was.
TEST(LombScargle, HasTheSpectrumOfARecordWithGaps) {
  const auto all = froude_test::gaussian_record(smooth, 32768, 1, 2);
  const hydro::RandomStream random(5, 9);
  std::vector<double> t, x;
  for (std::size_t i = 0; i < all.size(); ++i)
    if ((i < 10000 || i > 13000) && random.uniform(i) < 0.7) t.push_back(static_cast<double>(i)), x.push_back(all[i]);
  const auto s = lomb_scargle(t, x, 256, 0.5);
  EXPECT_LT(s.segments, 255u);                 // those in the gap take no part
  const double peak = s.spectrum.density[44];  // 0.176 Hz, where it is 1
  EXPECT_NEAR(peak, 1, 4 * std::sqrt(2 / s.dof));
  // The floor: the variance, 1/8, spread evenly over what random gaps alias, 0.3/0.7 of 2 · 1/8 · 1 s.
  double floor = 0;
  for (std::size_t k = 89; k < 120; ++k) floor += s.spectrum.density[k] / 31;
  EXPECT_NEAR(floor, 0.25 * 0.3 / 0.7, 0.25 * 0.3 / 0.7 * 0.2);
}

TEST(LombScargle, HasTheVarianceOfASineAtUnevenTimes) {
  const hydro::RandomStream random(1, 2);
  std::vector<double> t, x;
  for (std::size_t i = 0; i < 5000; ++i) {
    t.push_back(static_cast<double>(i) + 0.4 * random.uniform(i));
    x.push_back(3 + 1.5 * std::cos(2 * std::numbers::pi * 0.1 * t.back() + 1));
  }
  const auto s = lomb_scargle(t, x, 500, 0.3);
  const auto m = moments(s.spectrum, {.from_hz = 0.09, .to_hz = 0.11});
  EXPECT_NEAR(m.m0, 1.5 * 1.5 / 2, 0.02 * 1.125);  // jitter within a step leaks a per cent
  EXPECT_NEAR(usual_nyquist_hz(t), 0.5, 0.02);
}

// A tail that falls as f⁻⁵, and every fifth block of 30 s missing: of what is told far out the part that has leaked is
// what it is too high by.
TEST(LeakedShares, TellHowMuchATailIsTooHigh) {
  const auto steep = [](double f) {
    return f > 0 ? std::pow(f, -5) * std::exp(-1.25 * std::pow(0.1 / f, 4)) / 2000 : 0;
  };
  constexpr double step = 0.25, segment = 100;
  const auto x = froude_test::gaussian_record(steep, 16384, step, 3);
  const auto t = even(x.size(), step);
  const auto whole = lomb_scargle(t, x, segment, 0.7);
  for (const double share : leaked_shares(t, segment, whole.spectrum)) EXPECT_LT(share, 0.1);
  std::vector<double> gappy, left;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (i % 600 >= 120) gappy.push_back(t[i]), left.push_back(x[i]);
  const auto found = lomb_scargle(gappy, left, segment, 0.7);
  const auto shares = leaked_shares(gappy, segment, found.spectrum);
  EXPECT_LT(shares[9], 0.05);  // the peak, 0.1 Hz
  double high = 0, told = 0;
  for (std::size_t k = 39; k < 60; ++k) {  // 0.4 to 0.6 Hz
    high += found.spectrum.density[k] / whole.spectrum.density[k] / 21;
    told += shares[k] / 21;
  }
  EXPECT_GT(high, 1.2);
  EXPECT_NEAR(told, 1 - 1 / high, 0.15);  // leaked is told by a spectrum that has leaked itself
}

TEST(LombScargle, NamesWhatIsWrong) {
  const auto t = even(100, 1);
  const std::vector<double> x(100, 1.0);
  EXPECT_THAT([&] { lomb_scargle(t, x, 200, 0.5); }, ThrowsMessage<hydro::InputError>(HasSubstr("does not fit")));
  EXPECT_THAT([&] { lomb_scargle(t, x, 10, 0.5); }, ThrowsMessage<hydro::InputError>(HasSubstr("16 are needed")));
  EXPECT_THAT([&] { lomb_scargle(t, x, 50, 0.01); }, ThrowsMessage<hydro::InputError>(HasSubstr("longer segments")));
}

}  // namespace
}  // namespace lomb_scargle_test
