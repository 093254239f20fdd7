#include "hydro/signal/spectrum.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hydro/base/error.hpp"

namespace spectrum_test {
namespace {

using namespace hydro::signal;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// A density constant from f1 to f2: moments are (f2^{n+1} − f1^{n+1})/(n + 1).
SpectrumPerHz box(double f1, double f2, std::size_t n) {
  SpectrumPerHz s;
  for (std::size_t k = 0; k <= n; ++k) {
    s.frequency_hz.push_back(f1 + (f2 - f1) * static_cast<double>(k) / static_cast<double>(n));
    s.density.push_back(3.0);
  }
  return s;
}

TEST(Moments, MatchTheClosedFormsOfABox) {
  const auto m = moments(box(0.1, 0.3, 4000), {.from_hz = 0.1, .to_hz = 0.3});
  // Trapezium: (Δf)²/12 · (f'' scale) with Δf = 5e-5 stays below 1e-7 relative for every order used.
  EXPECT_NEAR(m.m0, 3 * 0.2, 1e-12);
  EXPECT_NEAR(m.m1, 3 * (0.09 - 0.01) / 2, 1e-7 * m.m1);
  EXPECT_NEAR(m.m2, 3 * (0.027 - 0.001) / 3, 1e-7 * m.m2);
  EXPECT_NEAR(m.m4, 3 * (0.00243 - 0.00001) / 5, 1e-7 * m.m4);
  EXPECT_NEAR(m.m_minus1, 3 * std::log(3.0), 1e-7 * m.m_minus1);
  EXPECT_NEAR(m.hs(), 4 * std::sqrt(0.6), 1e-10);
  EXPECT_NEAR(m.te(), std::log(3.0) / 0.2, 1e-6);
  EXPECT_NEAR(m.tm01(), 5, 1e-6);
  EXPECT_NEAR(m.tm02(), std::sqrt(0.6 / 0.026), 1e-6);
  EXPECT_NEAR(m.nu(), std::sqrt(0.6 * 0.026 / 0.0144 - 1), 1e-6);
  EXPECT_NEAR(m.epsilon(), std::sqrt(1 - 0.026 * 0.026 / (0.6 * 3 * 0.00242 / 5)), 1e-6);
}

TEST(Moments, UseOnlyTheBandAskedForAndSayWhich) {
  const auto m = moments(box(0, 1, 100), {.from_hz = 0.2, .to_hz = 0.5});
  EXPECT_NEAR(m.m0, 0.9, 1e-12);
  EXPECT_DOUBLE_EQ(m.band.from_hz, 0.2);
  EXPECT_DOUBLE_EQ(m.band.to_hz, 0.5);
}

TEST(Moments, LeaveZeroFrequencyOutOfTheEnergyPeriodOnly) {
  const auto s = box(0, 1, 100);
  const auto m = moments(s, whole(s));
  EXPECT_NEAR(m.m0, 3, 1e-12);
  EXPECT_TRUE(std::isfinite(m.m_minus1));
}

TEST(Spectrum, KeepsItsVarianceBetweenHertzAndRadians) {
  const auto s = box(0.1, 0.3, 10);
  const auto w = per_rad_s(s);
  EXPECT_NEAR(w.omega.back(), 0.3 * 6.283185307179586, 1e-15);
  EXPECT_NEAR((w.omega.back() - w.omega.front()) * w.density.front(), 0.6, 1e-14);
  EXPECT_NEAR(per_hz(w).density[3], 3.0, 1e-15);
}

TEST(Peak, OfAParabolaIsItsVertexWhateverThePoints) {
  SpectrumPerHz s;
  for (const double f : {0.0, 0.10, 0.18, 0.23, 0.31, 0.4}) {
    s.frequency_hz.push_back(f);
    s.density.push_back(2 - 20 * (f - 0.21) * (f - 0.21));
  }
  const auto p = peak(s, whole(s));
  EXPECT_NEAR(p.frequency_hz, 0.21, 1e-14);
  EXPECT_NEAR(p.density, 2, 1e-14);
  EXPECT_FALSE(p.at_edge);
  EXPECT_DOUBLE_EQ(peak(s, whole(s), PeakReading::nearest_point).frequency_hz, 0.23);
}

TEST(Peak, AtTheEndOfTheBandIsReportedAsSuch) {
  const SpectrumPerHz falling{{0, 0.1, 0.2, 0.3}, {9, 3, 2, 1}};
  const auto p = peak(falling, whole(falling));
  EXPECT_TRUE(p.at_edge);
  EXPECT_DOUBLE_EQ(p.frequency_hz, 0.1);  // f = 0 is a mean, not a wave
}

TEST(Spectrum, RefusesDisorderAndNothing) {
  const auto all = [](const SpectrumPerHz& s) { return [s] { moments(s, whole(s)); }; };
  EXPECT_THAT(all({{0, 0.2, 0.1}, {1, 1, 1}}), ThrowsMessage<hydro::InputError>(HasSubstr("must increase")));
  EXPECT_THAT(all({{0, 0.1}, {1, -1}}), ThrowsMessage<hydro::InputError>(HasSubstr("not negative")));
  EXPECT_THAT(all({{0, 0.1}, {0, 0}}), ThrowsMessage<hydro::InputError>(HasSubstr("zero from")));
  EXPECT_THAT(all({{0, 0.1}, {1}}), ThrowsMessage<hydro::InputError>(HasSubstr("densities")));
  EXPECT_THROW(moments(box(0, 1, 10), {.from_hz = 0.51, .to_hz = 0.59}), hydro::InputError);
}

}  // namespace
}  // namespace spectrum_test
