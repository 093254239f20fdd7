#include "dynamics/frequency/linear_drag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/force/restoring.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"

namespace linear_drag_test {
namespace {

using namespace dynamics;
using frequency::energy_equivalent_speed;
constexpr double pi = std::numbers::pi;

TEST(LinearDrag, HasLorentzFactorOnALineAndTheSpeedItselfOnACircle) {
  const Eigen::Vector3cd line = std::polar(1.0, 0.7) * Eigen::Vector3d(1, 2, -2).cast<std::complex<double>>();
  EXPECT_NEAR(energy_equivalent_speed(line), 8 / (3 * pi) * 3, 1e-5 * 3);  // |cos|³ by 64 points
  const Eigen::Vector3cd circle(2, std::complex<double>(0, 2), 0);
  EXPECT_NEAR(energy_equivalent_speed(circle), 2, 1e-14);
  EXPECT_EQ(energy_equivalent_speed(Eigen::Vector3cd::Zero()), 0);
}

// An ellipse between both, against a plain sum of many points over the whole period.
TEST(LinearDrag, LosesAsMuchOnAnEllipseAsQuadraticDragDoes) {
  const Eigen::Vector3cd w(1.5, std::complex<double>(0.2, 0.6), -0.4);
  double quadratic = 0, linear = 0;
  for (int i = 0; i < 100000; ++i) {
    const Eigen::Vector3d now = (w * std::polar(1.0, 2 * pi * i / 100000)).real();
    quadratic += now.norm() * now.squaredNorm();
    linear += energy_equivalent_speed(w) * now.squaredNorm();
  }
  EXPECT_NEAR(linear / quadratic, 1, 1e-5);
}

/// One body that only surges on a spring, without radiation.
struct Surging {
  std::vector<RigidBody> bodies{RigidBody({.name = "b",
                                           .mass = 1000,
                                           .inertia = 1000 * Eigen::Matrix3d::Identity(),
                                           .rest_position = {},
                                           .free = {true, false, false, false, false, false}})};
  double stiffness = 1000, draught = 2;
  Model model() const {
    std::vector<std::unique_ptr<const ForceKind>> forces;
    Matrix6 K = Matrix6::Zero();
    K(0, 0) = stiffness;
    forces.push_back(
        std::make_unique<RestoringKind>("mooring", bodies, std::vector<Restoring>{{0, K, Matrix6::Zero()}}));
    return Model(bodies, {}, std::move(forces));
  }
  std::vector<DragPiece> pieces() const {
    return drag_pieces(bodies, 0, Eigen::Vector3d(0, 0, -draught), Eigen::Vector3d(0, 0, 0), 0.5, 1.1, 1000);
  }
};

// At its own frequency nothing but drag holds the body: it moves with the water, on the mean of its pieces, and
// (k − ω²M + iω Σcβ) ξ = Σcβ u. A long wave has nearly one velocity at all pieces, which then do not drag at all.
TEST(LinearDrag, AtResonanceCarriesABodyWithTheWater) {
  const Surging of;
  const Model model = of.model();
  const std::vector<double> omega{1};
  const auto drag = frequency::linearised_drag(model, {}, omega, of.pieces(), {{}, 0, {0.3}});
  const auto xi = frequency::response_amplitudes(model, {}, omega, 0, &drag);
  std::complex<double> pull = 0;
  double sum = 0;
  for (Eigen::Index i = 0; i < drag.coefficient.rows(); ++i) {
    pull += drag.coefficient(i, 0) * drag.velocity(3 * i, 0);
    sum += drag.coefficient(i, 0);
  }
  EXPECT_LT(std::abs(xi(0, 0) - pull / std::complex<double>(0, sum)), 1e-9);
  EXPECT_NEAR(std::abs(xi(0, 0)), 0.9, 0.1);  // e^{−kz} at mid-draught: k = 0.102 rad/m
}

// Off resonance: the coefficient satisfies its own definition, and grows with the waves.
TEST(LinearDrag, SettlesWhereItsOwnResponsePutsIt) {
  const Surging of;
  const Model model = of.model();
  const std::vector<double> omega{1.4, 0.97};
  double before = 0;
  for (const double a : {0.01, 0.1, 1.0, 10.0}) {
    const auto drag = frequency::linearised_drag(model, {}, omega, of.pieces(), {{}, 0, {a, a}});
    const auto xi = frequency::response_amplitudes(model, {}, omega, 0, &drag);
    for (Eigen::Index w = 0; w < 2; ++w)
      for (Eigen::Index i = 0; i < drag.coefficient.rows(); ++i) {
        Eigen::Vector3cd relative = drag.velocity.block<3, 1>(3 * i, w);
        relative[0] -= std::complex<double>(0, omega[static_cast<std::size_t>(w)]) * xi(0, w);
        relative[2] = 0;  // along the axis
        const double own = drag.pieces[static_cast<std::size_t>(i)].factor * energy_equivalent_speed(a * relative);
        EXPECT_NEAR(drag.coefficient(i, w), own, 1e-5 * drag.coefficient.col(w).maxCoeff());  // stops at 1e-6
      }
    EXPECT_GT(drag.coefficient(0, 0), before);
    before = drag.coefficient(0, 0);
  }
}

}  // namespace
}  // namespace linear_drag_test
