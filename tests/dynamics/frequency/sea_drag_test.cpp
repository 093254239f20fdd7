#include "dynamics/frequency/sea_drag.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/force/restoring.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"

namespace sea_drag_test {
namespace {

using namespace dynamics;
using frequency::power_equivalent_speed;
constexpr double pi = std::numbers::pi;

TEST(SeaDrag, HasTheMomentsOfAGaussianOnALineAndInAPlane) {
  EXPECT_NEAR(power_equivalent_speed(3, 0), std::sqrt(8 / pi) * 3, 1e-5 * 3);  // |cos|³ by 64 points
  EXPECT_NEAR(power_equivalent_speed(2, 2), 1.5 * std::sqrt(pi / 2) * 2, 1e-12);
  // Between both, a plain sum over the plane: ⟨|w|³⟩/⟨|w|²⟩, cut at 8 standard deviations, whose density is 1e-14.
  double square = 0, cube = 0;
  for (double x = -8; x <= 8; x += 0.05)
    for (double y = -8; y <= 8; y += 0.05) {
      const double density = std::exp(-(x * x + y * y) / 2), speed = std::hypot(1.5 * x, 0.4 * y);
      square += density * speed * speed;
      cube += density * speed * speed * speed;
    }
  EXPECT_NEAR(power_equivalent_speed(1.5, 0.4) / (cube / square), 1, 2e-5);  // of the function, and of |w|³ near zero
}

/// One body that only surges on a spring, without radiation, dragged by a millimetre of cylinder at 2 m depth.
struct Surging {
  double factor = 3000;  ///< kg/m
  std::vector<RigidBody> bodies{RigidBody({.name = "b",
                                           .mass = 1000,
                                           .inertia = 1000 * Eigen::Matrix3d::Identity(),
                                           .rest_position = {},
                                           .free = {true, false, false, false, false, false}})};
  Model model(double stiffness = 1000) const {
    Matrix6 K = Matrix6::Zero();
    K(0, 0) = stiffness;
    std::vector<std::unique_ptr<const ForceKind>> forces;
    forces.push_back(
        std::make_unique<RestoringKind>("mooring", bodies, std::vector<Restoring>{{0, K, Matrix6::Zero()}}));
    return Model(bodies, {}, std::move(forces));
  }
  std::vector<DragPiece> pieces() const {
    return {{.body = 0, .arm = {0, 0, -2}, .axis = Eigen::Vector3d::UnitZ(), .factor = factor}};
  }
};

frequency::DragSea waves(std::vector<double> headings, std::vector<double> variances) {
  const auto rows = static_cast<Eigen::Index>(headings.size());
  return {.water = {},
          .heading = std::move(headings),
          .variance =
              Eigen::Map<Eigen::MatrixXd>(variances.data(), rows, static_cast<Eigen::Index>(variances.size()) / rows)};
}

// (D143), one degree of freedom and one frequency: w = u (k − ω²M)/(k − ω²M + iωC) with C = c √(8/π) σ makes a
// quadratic of s = σ²: (8/π) ω²c² s² + D² s = σ_u² D², D = k − ω²M.
TEST(SeaDrag, SolvesTheClosedFormOfOneDegreeOfFreedom) {
  for (const double omega : {0.9, 1.0001, 1.4, 2.5}) {
    const Surging of;
    const double variance = 0.3, k = omega * omega / 9.81, u2 = variance * std::pow(omega * std::exp(-2 * k), 2);
    const double D2 = std::pow(1000 - omega * omega * 1000, 2), a = 8 / pi * std::pow(omega * of.factor, 2);
    const double s = 2 * D2 * u2 / (D2 + std::sqrt(D2 * D2 + 4 * a * D2 * u2));
    const auto found = frequency::drag_in_sea(of.model(), {}, {omega}, of.pieces(), waves({0}, {variance}));
    // g of the data is standard gravity or 9.81: k differs by 4e-4, the velocity by 2 · 4e-4 · k z, k z up to 1.3.
    EXPECT_NEAR(found.sigma(0, 0) / std::sqrt(s), 1, 1e-3) << omega;
    EXPECT_NEAR(found.coefficient[0], of.factor * std::sqrt(8 / pi) * found.sigma(0, 0),
                3e-5 * found.coefficient[0]);  // |cos|³ by 64 points, and 1e-6 of where it stops
    EXPECT_EQ(found.sigma(0, 1), 0);
    EXPECT_LE(found.residual, 1e-6);
    EXPECT_LE(found.iterations, 20) << omega;
  }
}

// A body that cannot be moved sees the orbits themselves: two directions of equal energy at right angles make a plane
// of equal standard deviations.
TEST(SeaDrag, AddsDirectionsAndFrequencies) {
  const Surging of;
  const Model stiff = of.model(1e15);
  const auto one = frequency::drag_in_sea(stiff, {}, {0.8, 1.3}, of.pieces(), waves({0}, {0.1, 0.2}));
  const auto both =
      frequency::drag_in_sea(stiff, {}, {0.8, 1.3}, of.pieces(), waves({0, pi / 2}, {0.1, 0.1, 0.2, 0.2}));
  EXPECT_NEAR(both.sigma(0, 0) / one.sigma(0, 0), 1, 1e-9);
  EXPECT_NEAR(both.sigma(0, 1) / one.sigma(0, 0), 1, 1e-9);
  EXPECT_NEAR(both.coefficient[0] / one.coefficient[0], 1.5 * std::sqrt(pi / 2) / std::sqrt(8 / pi), 2e-5);
}

TEST(SeaDrag, GoesWithTheWavesAsWithTheCoefficientAndVanishesWithEither) {
  const Surging of{.factor = 3000};
  const std::vector<double> omega{0.9, 1.1};
  const auto in = [&](double factor, double height) {
    return frequency::drag_in_sea(of.model(), {}, omega, Surging{.factor = factor}.pieces(),
                                  waves({0}, {0.1 * height * height, 0.1 * height * height}));
  };
  const auto usual = in(3000, 1);
  // Twice the waves and half the factor are the same linear drag; twice stops at 1e-6.
  EXPECT_NEAR(in(1500, 2).coefficient[0] / usual.coefficient[0], 1, 3e-6);
  EXPECT_GT(in(3000, 2).coefficient[0], 1.3 * usual.coefficient[0]);
  // Of what next to no drag limits, drag goes with the factor, to its own share in the balance: ωc/|k − ω²M|, 1e-5.
  EXPECT_NEAR(in(2e-3, 1).coefficient[0] / in(1e-3, 1).coefficient[0], 2, 1e-4);
  EXPECT_EQ(in(3000, 0).coefficient[0], 0);
}

// Linear responses with these coefficients have the relative velocity that the coefficients were made for.
TEST(SeaDrag, IsWhatResponsesWithItConfirm) {
  const Surging of;
  const Model model = of.model();
  const std::vector<double> omega{0.9, 1.02, 1.3};
  const std::vector<double> variances{0.1, 0.2, 0.05};
  const auto found = frequency::drag_in_sea(model, {}, omega, of.pieces(), waves({0.4}, variances));
  const auto drag = frequency::drag_with(found.coefficient, model, omega, of.pieces(), {}, 0.4);
  const auto xi = frequency::response_amplitudes(model, {}, omega, 0.4, &drag);
  double x2 = 0, y2 = 0, xy = 0;
  for (Eigen::Index w = 0; w < 3; ++w) {
    const double variance = variances[static_cast<std::size_t>(w)];
    const std::complex<double> x =
        drag.velocity(0, w) - std::complex<double>(0, omega[static_cast<std::size_t>(w)]) * xi(0, w);
    const std::complex<double> y = drag.velocity(1, w);
    x2 += variance * std::norm(x);
    y2 += variance * std::norm(y);
    xy += variance * (x * std::conj(y)).real();
  }
  // The invariants of a symmetric 2 × 2 matrix; coefficients stop at 1e-6.
  EXPECT_NEAR(found.sigma.row(0).squaredNorm() / (x2 + y2), 1, 1e-5);
  EXPECT_NEAR(std::pow(found.sigma.row(0).prod(), 2) / (x2 * y2 - xy * xy), 1, 1e-5);
}

}  // namespace
}  // namespace sea_drag_test
