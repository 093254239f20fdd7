#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "layouts.hpp"
#include "support/bottom_mounted_cylinders.hpp"
#include "support/plain_cylinder.hpp"

namespace hydro::cylinders::single_test {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

Solution solved(const std::vector<CylinderBody>& bodies, const std::vector<double>& omega, double tolerance,
                double depth = 14, const std::vector<double>& heading = {0.3}) {
  return solve(bodies, tank(depth), omega, heading, {.tolerance = tolerance, .threads = 1});
}

double largest_relative(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  double largest = 0;
  for (Eigen::Index i = 0; i < 5; ++i)
    for (Eigen::Index j = 0; j < 5; ++j)
      largest = std::max(largest, std::abs(a(i, j) - b(i, j)) / std::sqrt(b(i, i) * b(j, j)));
  return largest;
}

// The solver promises the tolerance; ten digits are compared with what six were asked for.
TEST(SingleCylinder, KeepsItsToleranceDownToNineDigits) {
  const std::vector<double> omega{0.4, 1.7, 3.5};
  for (const auto& [radius, draught, depth] : {std::tuple{0.8, 1.13, 14.0}, {5.0, 10.0, 30.0}, {1.0, 0.1, 2.0}}) {
    const auto best = solved({single(radius, draught)}, omega, 1e-9, depth);
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      const auto other = solved({single(radius, draught)}, omega, tolerance, depth);
      for (std::size_t i = 0; i < omega.size(); ++i) {
        EXPECT_LT(largest_relative(other.coefficients.A[i], best.coefficients.A[i]), tolerance) << omega[i];
        EXPECT_LT(largest_relative(other.coefficients.B[i], best.coefficients.B[i]), 10 * tolerance)
            << omega[i] << ": B of one frequency may be small beside that of the table";
      }
      EXPECT_LT(other.check.doubling, tolerance);
    }
  }
}

// Plain matching with n cosines is off by some n^{−4/3}: 0.5 % at 80, 0.3 % at 120 in heave, less in surge.
// Richardson's rule with that power leaves a tenth.
TEST(SingleCylinder, AgreesWithPlainEigenfunctionMatching) {
  const double omega = 1.7, a = 0.8, d = 1.13, h = 14;
  const double k = waves::wavenumber(omega, tank());
  const auto c = solved({single(a, d)}, {omega}, 1e-7).coefficients;
  const froude_test::PlainCylinder coarse(a, d, h, omega, k, 9.81, 60), fine(a, d, h, omega, k, 9.81, 120);
  const double gain = std::pow(2, 4.0 / 3);
  const auto extrapolated = [&](double at_60, double at_120) { return (gain * at_120 - at_60) / (gain - 1); };
  const auto heave_60 = coarse.heave(1000), heave_120 = fine.heave(1000);
  const auto surge_60 = coarse.surge(1000), surge_120 = fine.surge(1000);
  EXPECT_NEAR(extrapolated(heave_60.A, heave_120.A) / c.A[0](2, 2), 1, 2e-3);
  EXPECT_NEAR(extrapolated(heave_60.B, heave_120.B) / c.B[0](2, 2), 1, 2e-3);
  EXPECT_NEAR(extrapolated(surge_60.A, surge_120.A) / c.A[0](0, 0), 1, 2e-3);
  EXPECT_NEAR(extrapolated(surge_60.B, surge_120.B) / c.B[0](0, 0), 1, 2e-3);
}

// (C9) of MacCamy & Fuchs (1954): |F| = 4ρg tanh kh/(k² |H₁′(ka)|), 90° behind nothing but the wave's slope.
TEST(SingleCylinder, OnTheBottomIsThatOfMacCamyAndFuchs) {
  const CylinderBody pile{"pile", {0, 0, 0}, {}, {{{0, 0}, 2.0, {}}}};
  for (const double omega : {0.5, 1.2, 2.5}) {
    const auto c = solved({pile}, {omega}, 1e-6, 14, {0}).coefficients;
    const double k = waves::wavenumber(omega, tank());
    const Complex slope = froude_test::slope_H2(1, 2 * k);
    const Complex expected = -4 * 9810 * std::tanh(14 * k) / (k * k) / slope * 1.0;
    EXPECT_NEAR(std::abs(c.X[0](0, 0)) / std::abs(expected), 1, 1e-12);
    // The pressure falls as cosh k(z+h): the moment about the surface is −F (kh sinh − cosh + 1)/(k sinh)·… in closed
    // form.
    const double kh = 14 * k, arm = (1 / std::cosh(kh) - 1) / (k * std::tanh(kh));
    EXPECT_NEAR(std::abs(c.X[0](4, 0) / c.X[0](0, 0) - arm), 0, 1e-10 * std::abs(arm));
    EXPECT_EQ(std::abs(c.X[0](2, 0)), 0);
  }
}

TEST(SingleCylinder, TendsToTheBottomMountedOneAsTheGapCloses) {
  const CylinderBody pile{"pile", {0, 0, 0}, {}, {{{0, 0}, 2.0, {}}}};
  const auto limit = solved({pile}, {1.0}, 1e-6).coefficients;
  double last = 1;
  for (const double gap : {0.4, 0.1, 0.025}) {
    const auto c = solved({single(2, 14 - gap)}, {1.0}, 1e-6).coefficients;
    const double off = std::abs(c.X[0](0, 0) / limit.X[0](0, 0) - 1.0);
    EXPECT_LT(off, 0.5 * last) << gap;  // water that leaks through the gap: about in proportion to it
    last = off;
  }
  EXPECT_LT(last, 0.02);
}

// As ω → 0 the wave lifts the cylinder as a change of water level: X₃ → ρgS, and nothing pushes it sideways.
TEST(SingleCylinder, FeelsALongWaveAsATide) {
  const auto c = solved({single(0.8, 1.13)}, {0.02}, 1e-6).coefficients;
  const double stiffness = 9810 * pi * 0.64;
  EXPECT_NEAR(c.X[0](2, 0).real() / stiffness, 1, 2e-3);  // corrections (kd), k = 0.0017/m
  EXPECT_LT(std::abs(c.X[0](0, 0)), 0.01 * stiffness);
}

// ω → ∞ within reach: A(ω) has come near A(∞) at K a = 60; the way there is of the order 1/(Ka).
TEST(SingleCylinder, HasTheAddedMassThatHighFrequenciesTendTo) {
  const double omega = std::sqrt(60 * 9.81);
  const auto c = solved({single(1, 1)}, {omega / 2, omega}, 1e-4, 6).coefficients;
  for (const Eigen::Index i : {0, 2, 4}) {
    const double near = std::abs(c.A[1](i, i) / (*c.A_inf)(i, i) - 1),
                 far = std::abs(c.A[0](i, i) / (*c.A_inf)(i, i) - 1);
    EXPECT_LT(near, 2.0 / 60) << i;
    EXPECT_LT(near, far) << i;
  }
}

// Infinite depth is a depth of at least 60 sizes; one of 40 m for a cylinder of 1 m and K = 0.5 /m is some 1e-5 from
// it.
TEST(SingleCylinder, TakesInfinitelyDeepWater) {
  const double omega = std::sqrt(0.5 * 9.81);
  Water deep = tank();
  deep.depth = WaterDepth::infinite();
  const auto s = solve({single(1, 1)}, deep, {omega}, {0}, {.tolerance = 1e-5, .threads = 1});
  const auto finite = solved({single(1, 1)}, {omega}, 1e-5, 40, {0}).coefficients;
  EXPECT_LT(largest_relative(s.coefficients.A[0], finite.A[0]), 1e-4);
  EXPECT_LT(std::abs(s.coefficients.X[0](2, 0) / finite.X[0](2, 0) - 1.0), 1e-4);
  EXPECT_GE(s.check.effective_depth, 60);
  EXPECT_TRUE(s.coefficients.water.depth.is_infinite());
}

}  // namespace
}  // namespace hydro::cylinders::single_test
