#include "fit/wave_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"

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

TEST(WaterMotion, NeedsABodyInTheWaterAndFivePeriods) {
  std::vector<double> elevation(400);
  for (std::size_t j = 0; j < 400; ++j) elevation[j] = 0.1 * std::cos(0.05 * static_cast<double>(j));
  EXPECT_THROW(fit::water_motion(elevation, 0.02, {.water = tank, .level = 0.1}), hydro::InputError);
  EXPECT_THROW(fit::water_motion(elevation, 0.02, {.water = tank, .level = -1.3}), hydro::InputError);
  EXPECT_THROW(fit::water_motion(elevation, 0.02, {.water = tank, .level = -0.5}), hydro::InputError);
}

}  // namespace
}  // namespace wave_motion_test
