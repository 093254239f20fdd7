// Joints closed in periodic motions, and Hill's equation of one motion, against laws and closed forms.
#include "dynamics/frequency/periodic_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/force/connector.hpp"
#include "dynamics/force/drag.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/frequency/hill_equation.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"
#include "support/hill_determinant.hpp"

namespace periodic_model_test {
namespace {

using namespace dynamics;
using namespace dynamics::frequency;
using Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;
constexpr double pi = std::numbers::pi, g = 9.81;

RigidBody body(const std::string& name, const Vector3d& at) {
  return RigidBody({.name = name, .mass = 3, .inertia = Vector3d(1, 2, 2.5).asDiagonal(), .rest_position = {at}});
}

/// A rod on a universal joint at the origin, and a collar that slides along it: three motions, in space. Other loads
/// than weight may act.
Model rod_with_collar(std::vector<std::unique_ptr<const ForceKind>> forces = {}) {
  std::vector<RigidBody> bodies{body("rod", {0, 0, -2}), body("collar", {0, 0, -3})};
  forces.push_back(std::make_unique<GravityKind>(bodies, g));
  return Model(bodies, {}, std::move(forces),
               {{.name = "top", .kind = JointKind::universal, .first = 0, .second = {}, .place = Vector3d::Zero()},
                {.name = "slide",
                 .kind = JointKind::slider,
                 .first = 0,
                 .second = 1,
                 .place = {0, 0, -3},
                 .axis = Vector3d::UnitZ()}});
}

/// y(t) of three frequencies, far from small.
CoordinateMotion wild(double t) {
  CoordinateMotion m{t, VectorXd(3), VectorXd(3), VectorXd(3)};
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double w = 1 + static_cast<double>(i), a = 2.0;
    m.value[i] = a * std::sin(w * t + 0.3), m.rate[i] = a * w * std::cos(w * t + 0.3);
    m.acceleration[i] = -w * w * m.value[i];
  }
  return m;
}

TEST(PeriodicModel, KeepsJointsClosedAndVelocitiesAreDerivatives) {
  const Model model = rod_with_collar();
  const SmallMotions about(model);
  PeriodicModel periodic(model, about, {}, 1);
  ASSERT_EQ(periodic.size(), 3);
  constexpr double h = 1e-5;
  for (const double t : {0.2, 1.1, 2.7}) {
    const auto now = periodic.bodies(wild(t)), before = periodic.bodies(wild(t - h)),
               after = periodic.bodies(wild(t + h));
    EXPECT_LT(model.joints().values(now.state).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_GT(rotation_log(now.state.pose[0].attitude).norm(), 0.2);
    for (int b = 0; b < 2; ++b) {
      const auto i = static_cast<std::size_t>(b);
      // Central differences: h² of a motion of some metres, and rounding over h.
      const Vector3d v = (after.state.pose[i].centre - before.state.pose[i].centre) / (2 * h);
      EXPECT_LT((v - now.state.twist(b).head<3>()).norm(), 1e-8);
      const Vector3d turn =
          rotation_log(after.state.pose[i].attitude * before.state.pose[i].attitude.conjugate()) / (2 * h);
      EXPECT_LT((turn - now.state.twist(b).tail<3>()).norm(), 1e-8);
    }
    const VectorXd a = (after.state.velocity - before.state.velocity) / (2 * h);
    EXPECT_LT((a - now.acceleration).cwiseAbs().maxCoeff(), 1e-7);
  }
}

// What the coordinates' equations do not balance takes the power that the bodies' own do not: joints give none.
TEST(PeriodicModel, ResidualIsThatOfVirtualPower) {
  const Model model = rod_with_collar();
  const SmallMotions about(model);
  PeriodicModel periodic(model, about, {}, 1);
  Workspace workspace(model, about.still);
  const CoordinateMotion m = wild(0.7);
  const auto now = periodic.bodies(m);
  const double power = now.state.velocity.dot(model.residual(now.state, now.acceleration, workspace));
  EXPECT_NEAR(periodic.at(m, VectorXd()).residual.dot(m.rate), power, 1e-10 * std::abs(power));
}

/// A spring and damper from the rod to the ground, and drag on the collar: loads by places and by velocities.
std::vector<std::unique_ptr<const ForceKind>> spring_and_drag() {
  std::vector<std::unique_ptr<const ForceKind>> out;
  const Ends ends{{0, Vector3d(0.1, 0.2, -1)}, PointOnGround{Vector3d(2, 1, -3)}};
  out.push_back(
      std::make_unique<AxialConnectorKind>(std::vector<AxialConnector>{{ends, {.stiffness = 40, .damping = 5}, 2}}));
  out.push_back(std::make_unique<DragKind>(
      std::vector<DragPiece>{{.body = 1, .arm = {0.3, 0, -0.5}, .axis = Vector3d::UnitZ(), .factor = 4}},
      std::nullopt));
  return out;
}

TEST(PeriodicModel, DerivativesAreThoseOfItsResidual) {
  const Model model = rod_with_collar(spring_and_drag());
  const SmallMotions about(model);
  PeriodicModel periodic(model, about, {}, 1);
  const CoordinateMotion m = wild(0.7);
  const PeriodicSample at = periodic.at(m, VectorXd()), roughly = periodic.roughly_at(m, VectorXd());
  const double size = at.residual.norm(), h = 1e-3;
  const auto slope = [&](VectorXd CoordinateMotion::*of, Eigen::Index k, double step) {
    CoordinateMotion high = m, low = m;
    (high.*of)[k] += step, (low.*of)[k] -= step;
    return VectorXd((periodic.residual_at(high, VectorXd()) - periodic.residual_at(low, VectorXd())) / (2 * step));
  };
  for (Eigen::Index k = 0; k < 3; ++k) {
    const VectorXd by_a = slope(&CoordinateMotion::acceleration, k, 1), by_y = slope(&CoordinateMotion::value, k, h),
                   by_v = slope(&CoordinateMotion::rate, k, h);
    EXPECT_LT((by_a - at.by_acceleration.col(k)).norm(), 1e-10 * size);  // linear
    EXPECT_LT((by_y - at.by_value.col(k)).norm(), 1e-5 * size);          // a step a hundred times as long: h²
    EXPECT_LT((by_v - at.by_rate.col(k)).norm(), 1e-5 * size);           // of drag, h²
    // Differences to one side, by 1e-5 m.
    EXPECT_LT((by_y - roughly.by_value.col(k)).norm(), 1e-4 * size);
    EXPECT_LT((at.by_rate - roughly.by_rate).norm(), 1e-10 * size);
  }
}

// A law: what it was asked before changes nothing. It begins with the places where bodies were last at that time, and
// what is derived from places is as good as the last step by which joints are closed, 1e-10 of metres; ten of them.
TEST(PeriodicModel, AnswersTheSameWhateverItWasAskedBefore) {
  const Model model = rod_with_collar();
  const SmallMotions about(model);
  PeriodicModel fresh(model, about, {}, 1), used(model, about, {}, 1);
  CoordinateMotion m = wild(0.7), other = wild(1.9), near = wild(0.71);
  other.time = near.time = m.time;
  const VectorXd expected = fresh.residual_at(m, VectorXd());
  for (const CoordinateMotion& before : {near, other}) {
    used.residual_at(before, VectorXd());
    EXPECT_LT((used.residual_at(m, VectorXd()) - expected).norm(), 1e-9 * expected.norm());
    EXPECT_GT((used.residual_at(before, VectorXd()) - expected).norm(), 1e-3 * expected.norm());  // it does move
  }
  other.time = 3;
  EXPECT_LT((used.at(m, VectorXd()).residual - expected).norm(), 1e-9 * expected.norm());
}

TEST(PeriodicModel, RefusesBodiesThatTurnAboutTwoAxesOfThree) {
  std::vector<RigidBody> bodies{RigidBody({.name = "hull",
                                           .mass = 3,
                                           .inertia = Vector3d(1, 2, 2.5).asDiagonal(),
                                           .free = {true, true, true, true, true, false}})};
  const Model model(bodies, {}, {}, {});
  const SmallMotions about(model);
  EXPECT_THAT([&] { PeriodicModel(model, about, {}, 1); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("two axes of three")));
}

/// ẍ + 0.1 ẋ + 4 x = s cos t drives q̈ + 2c q̇ + (δ + α x) q = 0.
struct Driven final : PeriodicSystem {
  explicit Driven(double with) : size_of(with) {}
  double size_of;
  static constexpr double alpha = 0.7, c = 0.02, delta = 0.26;
  Eigen::Index size() const override { return 2; }
  double omega() const override { return 1; }
  PeriodicSample at(const CoordinateMotion& m, const VectorXd&) override {
    const double x = m.value[0], q = m.value[1];
    const Eigen::Vector2d r(m.acceleration[0] + 0.1 * m.rate[0] + 4 * x - size_of * std::cos(m.time),
                            m.acceleration[1] + 2 * c * m.rate[1] + (delta + alpha * x) * q);
    return {r, Eigen::Matrix2d{{4, 0}, {alpha * q, delta + alpha * x}}, Eigen::Matrix2d{{0.1, 0}, {0, 2 * c}},
            Eigen::Matrix2d::Identity()};
  }
};

TEST(HillEquation, OfAMotionThatAnotherDrivesIsMathieusAndGrowsWhereHillsDeterminantsSay) {
  const HillEquation equation =
      hill_equation([](double s) { return std::make_unique<Driven>(s); }, 1e-3, VectorXd::Unit(2, 1), 0.5);
  const double per_size = Driven::alpha / std::abs(std::complex<double>(3, 0.1));  // ε of Mathieu
  const double expected = support::hill_boundary(Driven::delta, Driven::c) / per_size;
  const auto found = equation.least_growing(2);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(*found, expected, 2e-3);  // as promised, of 2
}

}  // namespace
}  // namespace periodic_model_test
