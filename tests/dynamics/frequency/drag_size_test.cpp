#include "dynamics/frequency/drag_size.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "dynamics/force/restoring.hpp"
#include "dynamics/frequency/linear_drag.hpp"
#include "hydro/waves/dispersion.hpp"

namespace drag_size_test {
namespace {

using namespace dynamics;
constexpr double pi = std::numbers::pi;
using Complex = std::complex<double>;

/// A body that surges and heaves on springs, with one member that hangs from it.
struct Held {
  std::vector<RigidBody> bodies{RigidBody({.name = "b",
                                           .mass = 1000,
                                           .inertia = 1000 * Eigen::Matrix3d::Identity(),
                                           .rest_position = {},
                                           .free = {true, false, true, false, false, false}})};
  double stiffness = 1000, load = 4e3;
  Model model() const {
    std::vector<std::unique_ptr<const ForceKind>> forces;
    Matrix6 K = Matrix6::Zero();
    K(0, 0) = K(2, 2) = stiffness;
    forces.push_back(
        std::make_unique<RestoringKind>("mooring", bodies, std::vector<Restoring>{{0, K, Matrix6::Zero()}}));
    return Model(bodies, {}, std::move(forces));
  }
  std::vector<DragPiece> pieces() const {
    return drag_pieces(bodies, 0, Eigen::Vector3d(0, 0, -2), Eigen::Vector3d(0, 0, 0), 0.5, 1.1, 1000);
  }
  Eigen::VectorXcd waves() const {
    Eigen::VectorXcd X = Eigen::VectorXcd::Zero(6);
    X[0] = Complex(0, load);
    return X;
  }
};

// Held fast, the member feels the waves alone: ∫ c (8/(3π)) ω² e^{2kz} dz over its length, c = ½ ρ C_D D.
TEST(DragLeftOut, OnAFixedMemberIsTheIntegralOfTheWavesVelocity) {
  const Held of;
  const Model model = of.model();
  const frequency::SmallMotions about(model);
  const auto pieces = of.pieces();
  const double omega = 1.3, k = hydro::waves::wavenumber(omega, {});
  frequency::DragLeftOut size(about, pieces, {});
  Eigen::VectorXcd still = Eigen::VectorXcd::Zero(6);
  still[0] = 1e-12;  // what does no work at all is left out
  size.take(omega, 0, still, of.waves());
  const double c = 0.5 * 1000 * 1.1 * 0.5;
  const double drag = c * 8 / (3 * pi) * omega * omega * (1 - std::exp(-4 * k)) / (2 * k);
  ASSERT_TRUE(size.largest());
  EXPECT_EQ(size.largest()->mode, 0);
  EXPECT_EQ(size.largest()->omega, omega);
  EXPECT_NEAR(size.largest()->per_metre, drag / of.load, 2e-5 * drag / of.load);  // 64 points of |cos|³
}

// (k − ω²M) ξ = X + Q(ξ) of the one motion, solved again and again: in waves of which the size says that drag is a
// hundredth, the response changes by a hundredth, but for terms of second order.
TEST(DragLeftOut, IsWhatTheResponseChangesByInSmallWaves) {
  const Held of;
  const Model model = of.model();
  const frequency::SmallMotions about(model);
  const auto pieces = of.pieces();
  const double omega = 1.4;
  const Complex Z = of.stiffness - omega * omega * 1000, X = of.waves()[0];
  frequency::DragLeftOut size(about, pieces, {});
  Eigen::VectorXcd xi = Eigen::VectorXcd::Zero(6);
  xi[0] = X / Z;
  size.take(omega, 0, xi, of.waves());
  const double a = 0.01 / size.largest()->per_metre, k = hydro::waves::wavenumber(omega, {});
  Complex with = X / Z;
  for (int turn = 0; turn < 50; ++turn) {
    Complex drag = 0;
    for (const DragPiece& piece : pieces) {
      const Complex w = omega * std::exp(k * piece.arm.z()) - Complex(0, omega) * with;
      drag += piece.factor * 8 / (3 * pi) * a * std::abs(w) * w;
    }
    with = (X + drag) / Z;
  }
  EXPECT_NEAR(std::abs(with - X / Z) / std::abs(X / Z), 0.01, 3 * 0.01 * 0.01);  // its square, with |w| w's factor
}

// Heave is rounding alone, on which a vertical member has no drag; surge is what counts, at the frequency of most drag.
TEST(DragLeftOut, IsOfTheModesThatWavesMove) {
  const Held of;
  const Model model = of.model();
  const frequency::SmallMotions about(model);
  const auto pieces = of.pieces();
  frequency::DragLeftOut size(about, pieces, {});
  EXPECT_FALSE(size.largest());
  for (const double omega : {0.7, 1.02, 1.5}) {
    Eigen::VectorXcd xi = Eigen::VectorXcd::Zero(6), X = of.waves();
    X[2] = 1e-13, X[4] = 1e-9;
    xi[0] = X[0] / (of.stiffness - omega * omega * 1000), xi[2] = 1e-16;
    size.take(omega, 0, xi, X);
  }
  ASSERT_TRUE(size.largest());
  EXPECT_EQ(size.largest()->mode, 0);
  EXPECT_EQ(size.largest()->omega, 1.02);  // near the motion's own, 1 rad/s
}

}  // namespace
}  // namespace drag_size_test
