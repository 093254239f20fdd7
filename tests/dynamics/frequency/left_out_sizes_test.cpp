// Inertia of members in a linear response, and how large friction and what is not linear in a load are beside one,
// (D146)-(D148), each against a closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "dynamics/force/restoring.hpp"
#include "dynamics/frequency/friction_size.hpp"
#include "dynamics/frequency/load_departure.hpp"
#include "dynamics/frequency/rao.hpp"
#include "hydro/waves/dispersion.hpp"

namespace left_out_sizes_test {
namespace {

using namespace dynamics;
using Complex = std::complex<double>;
using Eigen::VectorXcd;

RigidBody surging(const char* name, double mass, double x = 0) {
  return RigidBody({.name = name,
                    .mass = mass,
                    .inertia = mass * Eigen::Matrix3d::Identity(),
                    .rest_position = {Eigen::Vector3d(x, 0, 0)},
                    .free = {true, false, false, false, false, false}});
}

Restoring held(int body, double stiffness) {
  Matrix6 K = Matrix6::Zero();
  K(0, 0) = stiffness;
  return {body, K, Matrix6::Zero()};
}

std::vector<std::unique_ptr<const ForceKind>> springs(const std::vector<RigidBody>& bodies,
                                                      const std::vector<Restoring>& all) {
  std::vector<std::unique_ptr<const ForceKind>> out;
  out.push_back(std::make_unique<RestoringKind>("mooring", bodies, all));
  return out;
}

Friction rail(const std::vector<RigidBody>& bodies, int first, std::optional<int> second, double still, double moving) {
  return {"rail",
          JointCoordinate(bodies,
                          {.name = "rail", .kind = JointKind::slider, .first = first, .second = second, .place = {}}),
          still, moving};
}

// Whatever springs and mass are, what holds one body still carries all of the wave load.
TEST(FrictionLeftOut, OfOneBodyHoldsTheWaveLoad) {
  const std::vector<RigidBody> bodies{surging("b", 1000)};
  const Model model(bodies, {}, springs(bodies, {held(0, 700)}));
  const frequency::SmallMotions about(model);
  const std::vector<Friction> joints{rail(bodies, 0, {}, 300, 200)};
  const std::vector<frequency::PotentialGroup> no_waves;
  frequency::FrictionLeftOut size(about, no_waves, joints);
  EXPECT_FALSE(size.largest());
  for (const auto& [omega, load] : {std::pair{0.8, 3e3}, {1.3, 4e3}, {2.0, 1e3}}) {
    VectorXcd xi = VectorXcd::Zero(6);
    xi[0] = Complex(0, load) / (700 - omega * omega * 1000);
    size.take(omega, {xi, 0.5 * xi});  // of two headings
  }
  const auto largest = size.largest();
  ASSERT_TRUE(largest);
  EXPECT_EQ(largest->omega, 1.3);
  EXPECT_NEAR(largest->holding, 4e3, 1e-9 * 4e3);  // rounding
  EXPECT_NEAR(largest->sticks_below(joints[0]), 300 / 4e3, 1e-9);
  // Half of the amplitude of a square wave's first harmonic, (2/π) ∫ sin over half a turn of |T|: 4/π T.
  EXPECT_NEAR(largest->is_share_from(joints[0], 0.1), 4 / std::numbers::pi * 200 / (0.1 * 4e3), 1e-9);
}

// Two bodies on springs, held to each other by r: (X₁ − r)/Z₁ = (X₂ + r)/Z₂.
TEST(FrictionLeftOut, BetweenTwoBodiesHoldsWhatKeepsThemTogether) {
  const std::vector<RigidBody> bodies{surging("a", 1000), surging("b", 1700, 3)};
  const Model model(bodies, {}, springs(bodies, {held(0, 700), held(1, 5000)}));
  const frequency::SmallMotions about(model);
  const std::vector<Friction> joints{rail(bodies, 0, 1, 300, 200)};
  const std::vector<frequency::PotentialGroup> no_waves;
  frequency::FrictionLeftOut size(about, no_waves, joints);
  const double omega = 1.1;
  const Complex X1(3e3, 500), X2(-1e3, 2e3), Z1 = 700 - omega * omega * 1000, Z2 = 5000 - omega * omega * 1700;
  VectorXcd xi = VectorXcd::Zero(12);
  xi[0] = X1 / Z1, xi[6] = X2 / Z2;
  size.take(omega, {xi});
  const double wanted = std::abs((X1 / Z1 - X2 / Z2) / (1.0 / Z1 + 1.0 / Z2));
  EXPECT_NEAR(size.largest().value().holding, wanted, 1e-9 * wanted);
}

/// T − k x − k₃x³ − d u − c|u|u along x.
class Hardening final : public ForceKind {
 public:
  std::string effect() const override { return "hardening"; }
  std::size_t elements() const override { return 1; }
  std::string method() const override { return "as it is written"; }
  bool linear_at_rest() const override { return true; }
  void add_load(const Instant& now, LoadSink& out) const override {
    const double x = now.state.pose[0].centre.x(), u = now.state.velocity[0];
    out.add_mode(0, 90 - 700 * x - 50 * x * x * x - 30 * u - 20 * std::abs(u) * u);
  }
  void add_jacobian(const Instant& now, JacobianSink& out) const override {
    const double x = now.state.pose[0].centre.x(), u = now.state.velocity[0];
    Matrix6 by_q = Matrix6::Zero(), by_v = Matrix6::Zero();
    by_q(0, 0) = -700 - 150 * x * x;
    by_v(0, 0) = -30 - 40 * std::abs(u);
    out.add(0, 0, by_q, by_v);
  }
  EnergyFlow energy(const Instant&) const override { return {}; }
};

// At the ends of the motion u = 0 and k₃x³ is all that departs, in the middle c u² is; both are among the eight phases
// of a response that is real.
TEST(DepartureFromLinear, IsTheCubeOrTheSquareWhicheverIsLarger) {
  const std::vector<RigidBody> bodies{surging("b", 1000)};
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<Hardening>());
  const Model model(bodies, {}, std::move(forces));
  const frequency::SmallMotions about(model);
  VectorXcd xi = VectorXcd::Zero(6), X = VectorXcd::Zero(6);
  xi[0] = 1.4, X[0] = Complex(0, 2e3);
  for (const double amplitude : {0.2, 2.0}) {
    frequency::DepartureFromLinear size(about, amplitude);
    EXPECT_FALSE(size.largest());
    size.take(0.9, xi, X);
    const double x = amplitude * 1.4, wanted = std::max(50 * x * x * x, 20 * 0.81 * x * x) / (amplitude * 2e3);
    const auto largest = size.largest();
    ASSERT_TRUE(largest);
    EXPECT_EQ(largest->effect, "hardening");
    EXPECT_EQ(largest->mode, 0);
    EXPECT_EQ(largest->omega, 0.9);
    EXPECT_NEAR(largest->motion, x, 1e-12);
    EXPECT_NEAR(largest->share, wanted, 1e-12) << amplitude;  // rounding
  }
}

// A spring that is linear departs by rounding; in modes in which waves do no work nothing is told.
TEST(DepartureFromLinear, OfALinearSpringIsNothing) {
  const std::vector<RigidBody> bodies{surging("b", 1000)};
  const Model model(bodies, {}, springs(bodies, {held(0, 700)}));
  const frequency::SmallMotions about(model);
  frequency::DepartureFromLinear size(about, 3);
  VectorXcd xi = VectorXcd::Zero(6), X = VectorXcd::Zero(6);
  xi[0] = Complex(0.3, 1), X[0] = 1e3;
  size.take(0.9, xi, X);
  ASSERT_TRUE(size.largest());
  EXPECT_LT(size.largest()->share, 1e-12);
}

struct Cylinder {
  static constexpr double diameter = 0.5, draught = 2, ca = 0.9, density = 1000;
  std::vector<RigidBody> bodies{surging("b", 1000)};
  double per_length = density * std::numbers::pi / 4 * diameter * diameter;
  std::vector<frequency::InertiaPiece> pieces() const {
    std::vector<frequency::InertiaPiece> out;
    for (const DragPiece& p :
         drag_pieces(bodies, 0, Eigen::Vector3d(0, 0, -draught), Eigen::Vector3d::Zero(), diameter, 1, density)) {
      const double displaced = p.factor / (0.5 * density * diameter) * per_length;
      out.push_back({p, displaced, ca * displaced});
    }
    return out;
  }
};

// A vertical cylinder in deep water about its top: u = ωe^{kz} goes with the wave and u̇ leads it by a quarter, so the
// load in surge is i (1 + C_A) ρ¼πD² ω² ∫e^{kz} dz, and that in pitch the same of z e^{kz}.
TEST(MemberInertia, OfAVerticalCylinderIsMorisonsIntegral) {
  const Cylinder of;
  const frequency::MemberInertia inertia{of.pieces(), {.density = Cylinder::density}};
  const State still = rest_state(of.bodies);
  for (const double omega : {0.4, 1.3, 2.5}) {
    const double k = hydro::waves::wavenumber(omega, inertia.water), T = Cylinder::draught;
    const Complex per_metre(0, (1 + Cylinder::ca) * of.per_length * omega * omega);
    const VectorXcd X = inertia.excitation(of.bodies, still, omega, 0);
    const double along = (1 - std::exp(-k * T)) / k, moment = (T * std::exp(-k * T) - along) / k;
    // Three points of Gauss miss T⁷/2e6 of the sixth derivative, k⁶ of the load and 6k⁵ of its moment, kT below 1.3.
    EXPECT_NEAR(std::abs(X[0] - per_metre * along), 0, 3e-6 * std::abs(per_metre) * T) << omega;
    EXPECT_NEAR(std::abs(X[4] - per_metre * moment), 0, 1.2e-5 * std::abs(per_metre) * T * T) << omega;
    EXPECT_EQ(std::abs(X[2]), 0) << "it has no load along its axis";
  }
  Eigen::MatrixXd added = Eigen::MatrixXd::Zero(6, 6);
  inertia.add_mass(still, added);
  const double mass = Cylinder::ca * of.per_length * Cylinder::draught, T = Cylinder::draught;
  EXPECT_NEAR(added(0, 0), mass, 1e-12 * mass);
  EXPECT_NEAR(added(1, 1), mass, 1e-12 * mass);
  EXPECT_NEAR(added(2, 2), 0, 1e-12 * mass);
  EXPECT_NEAR(added(0, 4), -mass * T / 2, 1e-12 * mass * T);
  EXPECT_NEAR(added(4, 4), mass * T * T / 3, 1e-12 * mass * T * T);
}

// (Q1) with a member in the place of coefficients: (k − ω²(m + C_A ρV)) ξ = X.
TEST(MemberInertia, StandsInTheEquationsOfMotion) {
  const Cylinder of;
  constexpr double stiffness = 700, omega = 1.3;
  const Model model(of.bodies, {}, springs(of.bodies, {held(0, stiffness)}));
  const frequency::MemberInertia inertia{of.pieces(), {.density = Cylinder::density}};
  const frequency::SmallMotions about(model, rest_state(of.bodies), inertia);
  const Complex X = inertia.excitation(of.bodies, about.still, omega, 0)[0],
                wanted = X / (stiffness - omega * omega * (1000 + Cylinder::ca * of.per_length * Cylinder::draught));
  const Complex xi = frequency::response_amplitudes(about, {}, {omega}, 0)(0, 0);
  EXPECT_NEAR(std::abs(xi - wanted), 0, 1e-12 * std::abs(wanted));
}

}  // namespace
}  // namespace left_out_sizes_test
