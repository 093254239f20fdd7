#include "dynamics/frequency/modes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <cmath>
#include <numbers>

#include "dynamics/force/connector.hpp"
#include "dynamics/force/restoring.hpp"
#include "hydro/base/error.hpp"
#include "support/two_pole_body.hpp"

namespace modes_test {
namespace {

using namespace dynamics;
using frequency::free_motions;
using frequency::Mode;
using frequency::PotentialGroup;
using hydro::potential::Coefficients;

RigidBody body(const std::string& name, double x, std::array<bool, 6> free = {true, true, true, true, true, true}) {
  return RigidBody({.name = name,
                    .mass = 1000,
                    .inertia = 4000 * Eigen::Matrix3d::Identity(),  // radius of gyration 2 m
                    .rest_position = {Eigen::Vector3d(x, 0, 0)},
                    .free = free});
}

constexpr std::array<bool, 6> surge_only{true, false, false, false, false, false};

Model held(const std::vector<RigidBody>& bodies, const Matrix6& stiffness, const Matrix6& damping = Matrix6::Zero(),
           std::vector<AxialConnector> springs = {}) {
  std::vector<std::unique_ptr<const ForceKind>> f;
  std::vector<Restoring> r;
  for (int i = 0; i < static_cast<int>(bodies.size()); ++i) r.push_back({i, stiffness, damping});
  f.push_back(std::make_unique<RestoringKind>("mooring", bodies, r));
  if (!springs.empty()) f.push_back(std::make_unique<AxialConnectorKind>(std::move(springs)));
  return Model(bodies, {}, std::move(f));
}

Matrix6 diagonal(std::initializer_list<double> values) {
  Eigen::Matrix<double, 6, 1> d;
  std::copy(values.begin(), values.end(), d.data());
  return d.asDiagonal();
}

/// The two-pole body of `factor` kilograms in surge, tabulated finely; what interpolation adds is below 1e-7.
PotentialGroup two_poles(const support::TwoPoleBody& water, double factor) {
  Coefficients c;
  c.source = "two-pole body";
  c.body.emplace_back().name = "body1";
  for (int i = 1; i <= 2000; ++i) {
    const double omega = 0.002 * i;
    c.omega.push_back(omega);
    c.A.push_back(factor * (1 + water.A_minus_A_inf(omega)) * Eigen::MatrixXd::Identity(6, 6));
    c.B.push_back(factor * water.B(omega) * Eigen::MatrixXd::Identity(6, 6));
  }
  return {{0}, hydro::potential::FrequencyTable(c, {Eigen::Vector3d::Zero()}), true, false};
}

TEST(Modes, OfOneBodyOnSpringsAreTheSquareRootOfStiffnessOverMass) {
  // Rotations: 4000 kg m², and a shape of half a radian, whose edge at the radius of gyration moves one metre.
  const auto found = free_motions(held({body("a", 0)}, diagonal({1000, 4000, 9000, 64e3, 100e3, 144e3})), {});
  ASSERT_EQ(found.modes.size(), 6u);
  for (int i = 0; i < 6; ++i) {
    const Mode& mode = found.modes[static_cast<std::size_t>(i)];
    EXPECT_NEAR(mode.omega, i + 1, 1e-12 * (i + 1));
    Eigen::VectorXd shape = Eigen::VectorXd::Zero(6);
    shape[i] = i < 3 ? 1 : 0.5;
    EXPECT_LT((mode.shape - shape).norm(), 1e-12);
    EXPECT_NEAR(mode.energy_share(held({body("a", 0)}, Matrix6::Identity()))[i], 1, 1e-12);
    EXPECT_FALSE(mode.outside_data);
  }
}

TEST(Modes, OfAChainAreThoseOfLagrange) {
  // n equal masses between two walls, springs k: ω_j = 2 √(k/m) sin(jπ/(2(n + 1))), shapes sin(ijπ/(n + 1)).
  constexpr int n = 7;
  constexpr double k = 2500, m = 1000;
  std::vector<RigidBody> bodies;
  std::vector<AxialConnector> springs;
  for (int i = 0; i < n; ++i) bodies.push_back(body(fmt::format("m{}", i + 1), 10.0 * i, surge_only));
  const Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  springs.push_back({{{0, centre}, PointOnGround{{-10, 0, 0}}}, {k, 0}, 10});
  for (int i = 0; i + 1 < n; ++i) springs.push_back({{{i, centre}, PointOnBody{i + 1, centre}}, {k, 0}, 10});
  springs.push_back({{{n - 1, centre}, PointOnGround{{10.0 * n, 0, 0}}}, {k, 0}, 10});
  const Model model = held(bodies, Matrix6::Zero(), Matrix6::Zero(), springs);
  const auto found = free_motions(model, {});
  ASSERT_EQ(found.modes.size(), static_cast<std::size_t>(n));
  for (int j = 1; j <= n; ++j) {
    const Mode& mode = found.modes[static_cast<std::size_t>(j - 1)];
    const double angle = j * std::numbers::pi / (n + 1), exact = 2 * std::sqrt(k / m) * std::sin(angle / 2);
    EXPECT_NEAR(mode.omega, exact, 1e-12 * exact);
    Eigen::VectorXd shape(n);
    for (int i = 0; i < n; ++i) shape[i] = std::sin((i + 1) * angle);
    Eigen::Index largest;
    shape.cwiseAbs().maxCoeff(&largest);
    for (int i = 0; i < n; ++i)  // the largest may stand at two places with different signs
      EXPECT_NEAR(std::abs(mode.shape[6 * i]), std::abs(shape[i] / shape[largest]), 1e-10);
  }
}

/// How far the shapes are from being linearly dependent: the least singular value of unit columns.
double independence(const std::vector<Mode>& modes) {
  Eigen::MatrixXd shapes(modes.front().shape.size(), static_cast<Eigen::Index>(modes.size()));
  for (std::size_t i = 0; i < modes.size(); ++i) shapes.col(static_cast<Eigen::Index>(i)) = modes[i].shape.normalized();
  return Eigen::JacobiSVD<Eigen::MatrixXd>(shapes).singularValues().minCoeff();
}

// Three bodies that feel nothing of each other, surge and sway on springs alike: six modes of one frequency, each a
// motion of one body, whose eigenvectors no solver tells apart.
TEST(Modes, OfOneFrequencyAreAsManyMotions) {
  const std::vector<RigidBody> bodies{body("a", 0), body("b", 20), body("c", 40)};
  const Matrix6 K = diagonal({4000, 4000, 9000, 64e3, 100e3, 144e3}), D = diagonal({80, 80, 0, 0, 0, 0});
  for (const double damped_share : {0.0, 1.0}) {
    const auto found = free_motions(held(bodies, K, damped_share * D), {});
    ASSERT_EQ(found.modes.size(), 18u);
    EXPECT_NEAR(independence(found.modes), 1, 1e-9);
    for (std::size_t i = 0; i < 6; ++i) {
      const Mode& mode = found.modes[i];
      EXPECT_NEAR(mode.omega, 2, 1e-12);
      EXPECT_NEAR((mode.shape.cwiseAbs().array() > 1e-9).count(), 1, 0);
      ASSERT_TRUE(mode.damped);
      EXPECT_NEAR(-mode.damped->s.real(), damped_share * 0.04, 1e-12);  // D/2m
    }
  }
}

// Two alike, of which one is damped: the mode that is damped belongs to it, though both have one frequency.
TEST(Modes, OfOneFrequencyKeepTheirDampingApart) {
  const std::vector<RigidBody> bodies{body("a", 0, surge_only), body("b", 20, surge_only)};
  std::vector<std::unique_ptr<const ForceKind>> f;
  const Matrix6 K = diagonal({4000, 0, 0, 0, 0, 0}), D = diagonal({80, 0, 0, 0, 0, 0});
  f.push_back(
      std::make_unique<RestoringKind>("mooring", bodies, std::vector<Restoring>{{0, K, D}, {1, K, Matrix6::Zero()}}));
  const auto found = free_motions(Model(bodies, {}, std::move(f)), {});
  ASSERT_EQ(found.modes.size(), 2u);
  for (const Mode& mode : found.modes) {
    ASSERT_TRUE(mode.damped);
    const bool of_a = std::abs(mode.shape[0]) > 0.5;
    EXPECT_NEAR(-mode.damped->s.real(), of_a ? 0.04 : 0, 1e-12);
    EXPECT_NEAR(std::abs(mode.damped->shape[of_a ? 6 : 0]), 0, 1e-9);
  }
  EXPECT_NEAR(independence(found.modes), 1, 1e-9);
}

TEST(Modes, TellWhatIsAdriftAndWhatTopples) {
  const auto found = free_motions(held({body("a", 0)}, diagonal({0, 0, 9000, -50, 100e3, 0})), {});
  EXPECT_EQ(found.modes.size(), 2u);
  EXPECT_EQ(found.adrift.size(), 3u);
  ASSERT_EQ(found.toppling.size(), 1u);
  EXPECT_NEAR(found.toppling[0][3], 0.5, 1e-12);
}

TEST(Modes, WithDampersAreTheRootsOfTheQuadratic) {
  // s² + 2ζω s + ω² with ω = 1, 2 …; the last is overdamped and creeps.
  const auto found = free_motions(
      held({body("a", 0)}, diagonal({1000, 4000, 9000, 64e3, 100e3, 144e3}), diagonal({20, 400, 3000, 3200, 0, 60e3})),
      {});
  const double zeta[]{0.01, 0.1, 0.5, 0.1, 0};
  for (int i = 0; i < 5; ++i) {
    const Mode& mode = found.modes[static_cast<std::size_t>(i)];
    ASSERT_TRUE(mode.damped);
    EXPECT_NEAR(mode.damped->damping_ratio(), zeta[i], 1e-12);
    EXPECT_NEAR(mode.damped->s.imag(), (i + 1) * std::sqrt(1 - zeta[i] * zeta[i]), 1e-11);
  }
  EXPECT_FALSE(found.modes[5].damped);
}

TEST(Modes, HaveTheAddedMassOfTheirOwnFrequency) {
  const support::TwoPoleBody water{};
  const PotentialGroup group = two_poles(water, 300);
  const auto found = free_motions(held({body("a", 0, surge_only)}, diagonal({1500, 0, 0, 0, 0, 0})), {group});
  ASSERT_EQ(found.modes.size(), 1u);
  const double omega = found.modes[0].omega;
  // The law itself, with the closed form of A: 1e-6 is what interpolation of the table leaves.
  EXPECT_NEAR(omega * omega * (1000 + 300 * (1 + water.A_minus_A_inf(omega))), 1500, 1500e-6);
  EXPECT_FALSE(found.modes[0].outside_data);
}

TEST(Modes, FindsAllThreeWhereTheAddedMassFallsSteeply) {
  // Sharp radiation near 1.5 rad/s: ω² (M + A(ω)) rises, falls and rises again through the stiffness.
  const support::TwoPoleBody water{.decay = 0.08, .frequency = 1.5};
  const PotentialGroup group = two_poles(water, 500);
  constexpr double k = 1.5 * 1.5 * 1500;
  int crossings = 0;
  double before = 1;
  for (double omega = 0.01; omega < 4; omega += 1e-3) {
    const double now = k - omega * omega * (1000 + 500 * (1 + water.A_minus_A_inf(omega)));
    crossings += (now > 0) != (before > 0);
    before = now;
  }
  ASSERT_EQ(crossings, 3);
  const auto found = free_motions(held({body("a", 0, surge_only)}, diagonal({k, 0, 0, 0, 0, 0})), {group});
  ASSERT_EQ(found.modes.size(), 3u);
  for (const Mode& mode : found.modes)
    EXPECT_NEAR(mode.omega * mode.omega * (1000 + 500 * (1 + water.A_minus_A_inf(mode.omega))), k, 1e-5 * k);
}

TEST(Modes, OfARadiatingBodyDecayAsItsExactPolynomialSays) {
  // (s² (M + A∞) + c s K̂(s) + k) ((s + a)² + b²) = 0 with K̂ = s/((s + a)² + b²): four roots. What (Q3) takes of a
  // decaying motion for a steady one is of order ζ²: 4.1 to 4.4 ζ² |s| here, for ζ from 0.4 % to 5 %.
  const support::TwoPoleBody water{};
  constexpr double a = 0.3, b = 1.1, k = 2500;
  for (const double factor : {20.0, 60.0, 200.0}) {
    const PotentialGroup group = two_poles(water, factor);
    const auto found = free_motions(held({body("a", 0, surge_only)}, diagonal({k, 0, 0, 0, 0, 0})), {group});
    const double M = 1000 + factor;
    Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
    const double w2 = a * a + b * b;
    companion.row(0) << -2 * a * M, -(M * w2 + k + factor), -2 * a * k, -k * w2;
    companion.row(0) /= M;
    companion(1, 0) = companion(2, 1) = companion(3, 2) = 1;
    ASSERT_GE(found.modes.size(), 1u);
    const Mode& mode = found.modes.back();
    ASSERT_TRUE(mode.damped);
    double nearest = 1e9;
    for (const auto& root : companion.eigenvalues()) nearest = std::min(nearest, std::abs(root - mode.damped->s));
    const double zeta = mode.damped->damping_ratio();
    EXPECT_GT(zeta, 0.003);
    EXPECT_LT(nearest, 5 * zeta * zeta * std::abs(mode.damped->s)) << factor << " kg, damping ratio " << zeta;
  }
}

TEST(Modes, BelowAndAboveTheDataSaySo) {
  const support::TwoPoleBody water{};
  const PotentialGroup group = two_poles(water, 300);
  const auto slow = free_motions(held({body("a", 0, surge_only)}, diagonal({1e-3, 0, 0, 0, 0, 0})), {group});
  const auto fast = free_motions(held({body("a", 0, surge_only)}, diagonal({1e6, 0, 0, 0, 0, 0})), {group});
  ASSERT_EQ(slow.modes.size(), 1u);
  ASSERT_EQ(fast.modes.size(), 1u);
  EXPECT_TRUE(slow.modes[0].outside_data);
  EXPECT_TRUE(fast.modes[0].outside_data);
  const double at_first = 1300 + 300 * water.A_minus_A_inf(0.002), at_last = 1300 + 300 * water.A_minus_A_inf(4);
  EXPECT_NEAR(slow.modes[0].omega, std::sqrt(1e-3 / at_first), 1e-9);
  EXPECT_NEAR(fast.modes[0].omega, std::sqrt(1e6 / at_last), 1e-9);
}

TEST(Modes, TellWhereMassAndAddedMassAreNotPositive) {
  // M + A is 1000, −500, 1000, 1000 kg at 1, 2, 3, 4 rad/s: K − ω²(M + A) with K = 4000 N/m changes sign once above.
  Coefficients c;
  c.source = "gap resonance";
  c.body.emplace_back().name = "body1";
  for (const double A : {0.0, -1500.0, 0.0, 0.0}) {
    c.omega.push_back(static_cast<double>(c.omega.size() + 1));
    c.A.push_back(A * Eigen::MatrixXd::Identity(6, 6));
    c.B.push_back(Eigen::MatrixXd::Zero(6, 6));
  }
  const PotentialGroup group{{0}, hydro::potential::FrequencyTable(c, {Eigen::Vector3d::Zero()}), true, false};
  const auto found = free_motions(held({body("a", 0, surge_only)}, diagonal({4000, 0, 0, 0, 0, 0})), {group});
  EXPECT_THAT(found.indefinite_at, testing::ElementsAre(2.0));
  ASSERT_EQ(found.modes.size(), 1u);
  const double omega = found.modes[0].omega;
  EXPECT_GT(omega, 2);
  EXPECT_LT(omega, 3);
  EXPECT_NEAR(omega * omega * (1000 + group.table.added_mass(omega)(0, 0)), 4000, 1e-9);
}

}  // namespace
}  // namespace modes_test
