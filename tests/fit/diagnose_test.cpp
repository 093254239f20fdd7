#include "fit/diagnose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"
#include "support/morison_records.hpp"

namespace diagnose_test {
namespace {

const fit::Cylinder& cylinder = froude_test::moved_cylinder;
constexpr double period = 4, step = 0.02;

/// C_A = 1 and a C_D that grows by `growth` from cycle to cycle.
fit::ForceRecord made(double growth) {
  fit::ForceRecord r;
  const double omega = 2 * std::numbers::pi / period;
  for (int j = 0; j < 1600; ++j) {
    const double t = step * j, cd = 1.2 + growth * std::floor(t / period + 1e-9);
    r.time.push_back(t);
    r.velocity.push_back(0.4 * omega * std::cos(omega * t));
    r.acceleration.push_back(-0.4 * omega * omega * std::sin(omega * t));
    r.force.push_back(fit::morison_force(cylinder, cd, 1.0, r.velocity.back(), r.acceleration.back()));
  }
  return r;
}

TEST(CycleFits, FollowACoefficientThatChangesFromCycleToCycle) {
  const std::vector<double> starts{0, 4, 8, 12, 16, 20, 24, 28};
  const auto cycles = fit::fit_cycles(cylinder, made(0.1), starts);
  ASSERT_EQ(cycles.size(), 7u);
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    EXPECT_NEAR(cycles[i].cd, 1.2 + 0.1 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(cycles[i].inertia, 1.0, 1e-9);
  }
  EXPECT_THROW(fit::fit_cycles(cylinder, made(0), std::vector{0.0, 0.1}), hydro::InputError);
}

TEST(FourierAverages, AreThoseOfKeuleganAndCarpenter) {
  auto r = made(0);
  const auto exact = fit::fourier_averages(cylinder, r, period);
  EXPECT_NEAR(exact.cd, 1.2, 1e-6);
  EXPECT_NEAR(exact.inertia, 1.0, 1e-6);
  // By their integrals: C_D = −(3/(4ρDLu_m²)) ∫ F cos θ dθ over a period, with the force of the mass taken off.
  const double omega = 2 * std::numbers::pi / period, um = 0.4 * omega;
  for (std::size_t j = 0; j < r.time.size(); ++j) r.force[j] += 3 * std::cos(5 * omega * r.time[j]);
  double integral = 0;
  for (std::size_t j = 0; j < 200; ++j)
    integral += (r.force[j] + 5.9 * r.acceleration[j]) * std::cos(omega * r.time[j]) * omega * step;
  EXPECT_NEAR(fit::fourier_averages(cylinder, r, period).cd, -3 * integral / (4 * 997 * 0.06 * um * um), 1e-3);
}

TEST(Residuals, NameTheHarmonicsThatAreLeft) {
  Eigen::VectorXd e(1600);
  const auto noise = froude_test::ar1_noise(1600, 0, 0.5, 2);
  for (Eigen::Index j = 0; j < e.size(); ++j)
    e[j] = 2 * std::cos(2 * std::numbers::pi * 3 * step * static_cast<double>(j) / period) +
           noise[static_cast<std::size_t>(j)];
  const auto report = fit::look_at_residuals(e, 20, step, period);
  ASSERT_EQ(report.harmonics.size(), 7u);
  EXPECT_NEAR(report.harmonics[2].amplitude, 2, 0.08);  // noise: 0.5·√(2/1600) = 0.018
  EXPECT_LT(report.harmonics[4].amplitude, 0.08);
  EXPECT_NEAR(report.harmonic_share, 2 / (2 + 0.25), 0.02);
  EXPECT_LT(report.ljung_box_p, 1e-6);
}

TEST(Residuals, ThatAreWhiteAreCalledSoAtTheRightRate) {
  int small = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto noise = froude_test::ar1_noise(1600, 0, 1, 300 + i);
    const Eigen::VectorXd e = Eigen::Map<const Eigen::VectorXd>(noise.data(), 1600);
    small += fit::look_at_residuals(e, 20, step, period).ljung_box_p < 0.05;
  }
  EXPECT_LE(small, 24);  // 10 ± 3.1; four and a half deviations above
}

}  // namespace
}  // namespace diagnose_test
