#include "dynamics/frequency/fastest.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/force/connector.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/force/restoring.hpp"

namespace fastest_test {
namespace {

using namespace dynamics;
using frequency::fastest_motion;

constexpr double g = 9.81;

RigidBody body(const std::string& name, Eigen::Vector3d at, double mass = 2) {
  return RigidBody(
      {.name = name, .mass = mass, .inertia = Eigen::Vector3d(0.3, 0.4, 0.5).asDiagonal(), .rest_position = {at}});
}

/// A chain of masses on springs along x, between a wall and nothing.
Model chain(int count, double stiffness) {
  std::vector<RigidBody> bodies;
  std::vector<AxialConnector> springs;
  for (int i = 0; i < count; ++i) {
    bodies.push_back(body(std::to_string(i), {i + 1.0, 0, 0}));
    const Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    const Point before = i > 0 ? Point(PointOnBody{i - 1, centre}) : PointOnGround{centre};
    springs.push_back({{{i, centre}, before}, {.stiffness = stiffness}, 1});
  }
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<AxialConnectorKind>(std::move(springs)));
  return {bodies, {}, std::move(forces)};
}

// ω = 2 √(k/m) sin((2n − 1)/(2n + 1) π/2), the highest of n masses held at one end.
TEST(FastestMotion, IsTheHighestOfAChainOfSprings) {
  for (const int n : {1, 2, 5, 40}) {
    const Model model = chain(n, 800);
    const double exact = 2 * std::sqrt(800 / 2.0) * std::sin((2 * n - 1.0) / (2 * n + 1.0) * std::numbers::pi / 2);
    const auto found = fastest_motion(model, rest_state(model.bodies()));
    EXPECT_LE(found.omega, exact * (1 + 1e-9)) << n;
    EXPECT_GE(found.omega, exact * 0.98) << n;  // from below, within a per cent or two
    EXPECT_EQ(found.mode % 6, 0) << "surge";
  }
}

/// A rod on a hinge about y at its upper end, seen from where it has turned by `angle` from hanging down.
Model rod(double length) {
  const double mass = 3, across = mass * length * length / 12;
  std::vector<RigidBody> bodies{RigidBody({.name = "rod",
                                           .mass = mass,
                                           .inertia = Eigen::Vector3d(across, across, 1e-3).asDiagonal(),
                                           .rest_position = {Eigen::Vector3d(0, 0, -length / 2)}})};
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<GravityKind>(bodies, g, std::vector<int>{0}));
  Joint hinge{};
  hinge.name = "hinge";
  hinge.kind = JointKind::hinge;
  hinge.first = 0;
  hinge.place = Eigen::Vector3d::Zero();
  hinge.axis = Eigen::Vector3d::UnitY();
  return {bodies, {}, std::move(forces), {hinge}};
}

State turned(const Model& model, double length, double angle) {
  State out = rest_state(model.bodies());
  out.pose[0].attitude = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY());
  out.pose[0].centre = out.pose[0].attitude * Eigen::Vector3d(0, 0, -length / 2);
  return out;
}

// √(3g/2l) hanging, standing on its head, where it topples at that rate, and let go level, where α = 3g/2l.
TEST(FastestMotion, OfARodIsThatOfAPendulumWhereverItStarts) {
  for (const double length : {0.1, 2.0}) {
    const Model model = rod(length);
    const double exact = std::sqrt(1.5 * g / length);
    for (const double angle : {0.0, std::numbers::pi, std::numbers::pi / 2})
      EXPECT_NEAR(fastest_motion(model, turned(model, length, angle)).omega, exact, 1e-6 * exact) << angle;
  }
}

TEST(FastestMotion, IsNoneWhereNothingRestores) {
  const Model model({body("free", {0, 0, 0})}, {}, {});
  EXPECT_EQ(fastest_motion(model, rest_state(model.bodies())).omega, 0);
}

}  // namespace
}  // namespace fastest_test
