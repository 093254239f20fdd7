#include "dynamics/model/equilibrium.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/force/connector.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"

namespace equilibrium_test {
namespace {

using namespace dynamics;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double g = 9.81;

RigidBody body(const Eigen::Vector3d& at, double mass = 3) {
  return RigidBody({.name = "bob", .mass = mass, .inertia = Eigen::Matrix3d::Identity(), .rest_position = {at}});
}
Model under_gravity(const RigidBody& b, std::vector<Joint> joints, std::vector<AxialConnector> springs = {}) {
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<GravityKind>(std::vector{b}, g));
  if (!springs.empty()) forces.push_back(std::make_unique<AxialConnectorKind>(std::move(springs)));
  return Model({b}, {}, std::move(forces), std::move(joints));
}

TEST(Equilibrium, HangsAWeightOnItsSpring) {
  // k = 100 N/m, 2 m long without load, from 5 m above: it hangs m g/k deeper, whatever way it was placed.
  const Model m = under_gravity(body({1, 0, 1}), {}, {{{{0, {0, 0, 0}}, PointOnGround{{0, 0, 5}}}, {100, 0}, 2}});
  const State rest = equilibrium(m, rest_state(m.bodies()));
  EXPECT_NEAR(rest.pose[0].centre.z(), 5 - 2 - 3 * g / 100, 1e-9);
  EXPECT_NEAR(rest.pose[0].centre.head<2>().norm(), 0, 1e-7) << "straight below";
}

TEST(Equilibrium, LetsAPendulumHang) {
  const Model m = under_gravity(
      body({2, 0, 0}),
      {{.name = "pin", .kind = JointKind::hinge, .first = 0, .second = {}, .place = {0, 0, 0}, .axis = {0, 1, 0}}});
  const State rest = equilibrium(m, rest_state(m.bodies()));
  EXPECT_LT((rest.pose[0].centre - Eigen::Vector3d(0, 0, -2)).norm(), 1e-7);
  EXPECT_LT(m.joints().values(rest).norm(), 1e-12);
}

TEST(Equilibrium, LeavesWhatNothingDrivesWhereItIs) {
  const Model m = under_gravity(
      body({7, 3, -2}),
      {{.name = "floor", .kind = JointKind::planar, .first = 0, .second = {}, .place = {7, 3, -2}, .axis = {0, 0, 1}}});
  EXPECT_EQ(equilibrium(m, rest_state(m.bodies())).pose[0].centre, Eigen::Vector3d(7, 3, -2));
}

TEST(Equilibrium, NamesWhatFallsForEver) {
  const Model m = under_gravity(body({0, 0, 0}), {});
  EXPECT_THAT([&] { equilibrium(m, rest_state(m.bodies())); },
              ThrowsMessage<hydro::InputError>(HasSubstr("nothing holds bob.heave against -29.43 N")));
}

}  // namespace
}  // namespace equilibrium_test
