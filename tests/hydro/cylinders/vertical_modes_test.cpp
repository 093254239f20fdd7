#include "hydro/cylinders/vertical_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "layouts.hpp"

namespace hydro::cylinders::vertical_modes_test {
namespace {

using std::numbers::pi;

// (C1) in long double: the residual κh − (nπ − atan(K/κ)) of a root that is right to its last bit is below its spacing.
TEST(VerticalModes, EvanescentRootsAreRightToRounding) {
  for (const double K : {1e-6, 0.01, 0.3, 2.0, 50.0})
    for (const double n : {1.0, 2.0, 7.0, 60.0, 3000.0}) {
      const long double y = static_cast<long double>(evanescent_root(n, K, 14)) * 14.0L;
      const long double residual = y - (static_cast<long double>(n) * std::numbers::pi_v<long double> -
                                        std::atan(static_cast<long double>(K) * 14.0L / y));
      EXPECT_LT(std::abs(static_cast<double>(residual / y)), 4e-16) << "K = " << K << ", n = " << n;
    }
}

TEST(VerticalModes, RootsTendToThoseOfARigidAndOfAFreeSurface) {
  EXPECT_NEAR(evanescent_root(3, 1e-12, 10), 3 * pi / 10, 1e-12);  // K → 0: tan κh = 0
  EXPECT_NEAR(evanescent_root(3, 1e12, 10), 2.5 * pi / 10, 1e-12);
  EXPECT_DOUBLE_EQ(evanescent_root(3, std::numeric_limits<double>::infinity(), 10), 2.5 * pi / 10);
}

// (C2) by Simpson's rule, 2000 intervals: error some (κ h/2000)⁴.
TEST(VerticalModes, AreOrthonormalOverTheDepth) {
  const Water water = tank();
  const VerticalModes modes = VerticalModes::at(1.3, water, 4);
  const double h = 14, N0 = modes.wave_norm_scaled();
  const auto Z = [&](int n, double z) {
    if (n == 0) return (std::exp(modes.k * z) + std::exp(-modes.k * (z + 2 * h))) / 2 / std::sqrt(N0);
    const double kappa = modes.kappa[static_cast<std::size_t>(n - 1)];
    return std::cos(kappa * (z + h)) / std::sqrt(modes.norm(kappa));
  };
  constexpr int steps = 2000;
  for (int n = 0; n < 5; ++n)
    for (int l = 0; l < 5; ++l) {
      double sum = 0;
      for (int i = 0; i <= steps; ++i)
        sum += (i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2) * Z(n, -h * i / steps) * Z(l, -h * i / steps) / 3;
      EXPECT_NEAR(sum / steps, n == l ? 1 : 0, 1e-9) << n << ", " << l;
    }
  EXPECT_NEAR(modes.wave_at_surface(), Z(0, 0), 1e-14);
  EXPECT_NEAR(modes.cos_at_surface(3), std::cos(modes.kappa[2] * h), 1e-13);
  EXPECT_NEAR(modes.sin_at_surface(3), std::sin(modes.kappa[2] * h), 1e-13);
}

TEST(VerticalModes, NeedAFiniteDepth) {
  EXPECT_THROW(VerticalModes::at(1, {.depth = WaterDepth::infinite()}, 3), InputError);
}

}  // namespace
}  // namespace hydro::cylinders::vertical_modes_test
