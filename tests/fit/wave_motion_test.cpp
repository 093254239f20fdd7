#include "fit/wave_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"
#include "support/coloured_noise.hpp"

namespace wave_motion_test {
namespace {

const hydro::Water tank{.density = 997, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(1.25)};

struct Wave {
  double amplitude, omega, phase;
};
const Wave waves[] = {{0.08, 2 * std::numbers::pi / 2.7, 0.4}, {0.03, 2 * std::numbers::pi / 1.9, 2.0}};

TEST(WaterMotion, IsThatOfLinearWavesBelowAndBeyondTheProbe) {
  constexpr double step = 0.02, z = -0.48, ahead = 1.7;
  constexpr std::size_t n = 4000;
  std::vector<double> elevation(n);
  for (std::size_t j = 0; j < n; ++j)
    for (const Wave& v : waves)
      elevation[j] += v.amplitude * std::cos(v.omega * step * static_cast<double>(j) + v.phase);
  const auto m = fit::water_motion(elevation, step, {.water = tank, .level = z, .ahead = ahead});
  EXPECT_NEAR(m.main_period_s, 2.7, 0.05);
  ASSERT_EQ(m.velocity.size(), n - 2 * m.first);
  double worst_u = 0, worst_w = 0, worst_a = 0;
  const std::size_t further = 500;  // ten seconds from the ends: what the taper stirs up has died out
  for (std::size_t j = further; j + further < m.velocity.size(); ++j) {
    const double t = step * static_cast<double>(j + m.first);
    double u = 0, w = 0, a = 0;
    for (const Wave& v : waves) {
      const double k = hydro::waves::wavenumber(v.omega, tank), at = v.omega * t - k * ahead + v.phase;
      const double c = std::cosh(k * (z + 1.25)) / std::sinh(k * 1.25),
                   s = std::sinh(k * (z + 1.25)) / std::sinh(k * 1.25);
      u += v.amplitude * v.omega * c * std::cos(at);
      w -= v.amplitude * v.omega * s * std::sin(at);
      a -= v.amplitude * v.omega * v.omega * c * std::sin(at);
    }
    worst_u = std::max(worst_u, std::abs(m.velocity[j] - u));
    worst_w = std::max(worst_w, std::abs(m.rise[j] - w));
    worst_a = std::max(worst_a, std::abs(m.acceleration[j] - a));
  }
  // Of 0.17 m/s and 0.5 m/s²; what is left of the ends.
  EXPECT_LT(worst_u, 1e-3);
  EXPECT_LT(worst_w, 1e-3);
  EXPECT_LT(worst_a, 2e-3);
}

/// The sum of waves at (t, x) from the probe: velocity and acceleration.
std::pair<double, double> truth_at(double t, double x, double z) {
  double u = 0, a = 0;
  for (const Wave& v : waves) {
    const double k = hydro::waves::wavenumber(v.omega, tank), at = v.omega * t - k * x + v.phase;
    const double c = std::cosh(k * (z + 1.25)) / std::sinh(k * 1.25);
    u += v.amplitude * v.omega * c * std::cos(at);
    a -= v.amplitude * v.omega * v.omega * c * std::sin(at);
  }
  return {u, a};
}

TEST(WaterMotion, IsThatWhereTheBodyIsIfItIsFollowed) {
  constexpr double step = 0.02, z = -0.48, ahead = 1.7;
  constexpr std::size_t n = 4000;
  std::vector<double> elevation(n), excursion(n);
  for (std::size_t j = 0; j < n; ++j) {
    const double t = step * static_cast<double>(j);
    for (const Wave& v : waves) elevation[j] += v.amplitude * std::cos(v.omega * t + v.phase);
    excursion[j] = 0.8 * std::sin(0.9 * t) + 0.01 * t;  // up to a radian of the shorter wave, and a drift
  }
  const auto m =
      fit::water_motion(elevation, step, {.water = tank, .level = z, .ahead = ahead, .follow = true}, excursion);
  const auto rests = fit::water_motion(elevation, step, {.water = tank, .level = z, .ahead = ahead});
  double worst_u = 0, worst_a = 0, without = 0;
  for (std::size_t j = 500; j + 500 < m.velocity.size(); ++j) {
    const double t = step * static_cast<double>(j + m.first);
    const auto [u, a] = truth_at(t, ahead + excursion[j + m.first], z);
    worst_u = std::max(worst_u, std::abs(m.velocity[j] - u));
    worst_a = std::max(worst_a, std::abs(m.acceleration[j] - a));
    without = std::max(without, std::abs(rests.velocity[j] - u));
  }
  EXPECT_LT(worst_u, 1e-3);  // as where the body rests: what is left of the ends, of 0.17 m/s and 0.5 m/s²
  EXPECT_LT(worst_a, 2e-3);
  EXPECT_GT(without, 0.05);
  EXPECT_THROW(fit::water_motion(elevation, step, {.water = tank, .level = z, .follow = true}), hydro::InputError);
}

TEST(WaterMotion, OfARegularWaveIsFollowedExactly) {
  constexpr double step = 0.02, z = -0.48;
  constexpr std::size_t n = 2000;
  const Wave& v = waves[0];
  std::vector<double> elevation(n), excursion(n);
  for (std::size_t j = 0; j < n; ++j) {
    elevation[j] = v.amplitude * std::cos(v.omega * step * static_cast<double>(j) + v.phase);
    excursion[j] = 0.6 * std::cos(0.02 * static_cast<double>(j));
  }
  const auto m =
      fit::water_motion(elevation, step, {.water = tank, .level = z, .regular = true, .follow = true}, excursion);
  const double k = hydro::waves::wavenumber(v.omega, tank),
               u = v.amplitude * v.omega * std::cosh(k * (z + 1.25)) / std::sinh(k * 1.25);
  for (std::size_t j = 0; j < n; j += 37)
    EXPECT_NEAR(m.velocity[j], u * std::cos(v.omega * step * static_cast<double>(j) - k * excursion[j] + v.phase),
                1e-3 * u);  // the frequency is that of a peak: 1e-3 rad over the record
}

TEST(WaterMotion, NeedsABodyInTheWaterAndFivePeriods) {
  std::vector<double> elevation(400);
  for (std::size_t j = 0; j < 400; ++j) elevation[j] = 0.1 * std::cos(0.05 * static_cast<double>(j));
  EXPECT_THROW(fit::water_motion(elevation, 0.02, {.water = tank, .level = 0.1}), hydro::InputError);
  EXPECT_THROW(fit::water_motion(elevation, 0.02, {.water = tank, .level = -1.3}), hydro::InputError);
  EXPECT_THROW(fit::water_motion(elevation, 0.02, {.water = tank, .level = -0.5}), hydro::InputError);
}

TEST(WaterMotion, OfARegularWaveIsThatOfTheSinusoidUnderItsNoise) {
  constexpr double step = 0.02, z = -0.48, ahead = 1.7;
  constexpr std::size_t n = 2000;
  const Wave& v = waves[0];
  const auto noise = froude_test::ar1_noise(n, 0.5, 0.01, 3);
  std::vector<double> elevation(n);
  for (std::size_t j = 0; j < n; ++j)
    elevation[j] = 0.03 + v.amplitude * std::cos(v.omega * step * static_cast<double>(j) + v.phase) + noise[j];
  const auto m = fit::water_motion(elevation, step, {.water = tank, .level = z, .ahead = ahead, .regular = true});
  EXPECT_EQ(m.first, 0u);
  ASSERT_EQ(m.velocity.size(), n);
  EXPECT_NEAR(m.left, 0.01 * std::numbers::sqrt2 / v.amplitude, 0.02);
  const double k = hydro::waves::wavenumber(v.omega, tank), c = std::cosh(k * (z + 1.25)) / std::sinh(k * 1.25),
               s = std::sinh(k * (z + 1.25)) / std::sinh(k * 1.25), u = v.amplitude * v.omega * c;
  // The amplitude is known to 0.01·√(2/2000) and as much again for the memory: 0.7 % of 0.08; four deviations.
  for (std::size_t j = 0; j < n; j += 37) {
    const double at = v.omega * step * static_cast<double>(j) - k * ahead + v.phase;
    EXPECT_NEAR(m.velocity[j], u * std::cos(at), 0.028 * u);
    EXPECT_NEAR(m.rise[j], -v.amplitude * v.omega * s * std::sin(at), 0.028 * u);
    EXPECT_NEAR(m.acceleration[j], -u * v.omega * std::sin(at), 0.028 * u * v.omega);
  }
  for (std::size_t j = 0; j < n; ++j) elevation[j] += 0.06 * std::cos(1.6 * v.omega * step * static_cast<double>(j));
  EXPECT_THROW(fit::water_motion(elevation, step, {.water = tank, .level = z, .regular = true}), hydro::InputError);
}

}  // namespace
}  // namespace wave_motion_test
