// Small motions about a state other than rest as placed: a pendulum that a steady load holds out of the vertical.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/force/constant_load.hpp"
#include "dynamics/force/drag.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/frequency/linear_drag.hpp"
#include "dynamics/frequency/modes.hpp"
#include "dynamics/model/equilibrium.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "laws/signal_laws.hpp"

namespace small_motions_test {
namespace {

using namespace dynamics;
using frequency::SmallMotions;

constexpr double g = 9.81, mass = 3, inertia = 2, length = 2, load = 20;  // N along x, at the bob

/// A bob under a hinge at the origin, with a load that leans it forward by atan(load / m g).
Model leaning_pendulum() {
  const std::vector<RigidBody> bodies{RigidBody({.name = "bob",
                                                 .mass = mass,
                                                 .inertia = Eigen::Vector3d(1, inertia, 2.5).asDiagonal(),
                                                 .rest_position = {{0, 0, -length}}})};
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<GravityKind>(bodies, g));
  forces.push_back(std::make_unique<ConstantLoadKind>(
      std::vector<ConstantLoad>{{{0, Eigen::Vector3d::Zero()}, {load, 0, 0}, Eigen::Vector3d::Zero()}}));
  return {bodies,
          {},
          std::move(forces),
          {{.name = "hinge",
            .kind = JointKind::hinge,
            .first = 0,
            .second = {},
            .place = Eigen::Vector3d::Zero(),
            .axis = Eigen::Vector3d::UnitY()}}};
}

const double lean = std::atan2(load, mass*g), pull = std::hypot(load, mass*g);

TEST(SmallMotions, OfAPendulumThatLeansAreFasterByTheLoadThatLeansIt) {
  const Model model = leaning_pendulum();
  const SmallMotions about(model, equilibrium(model, rest_state(model.bodies())));
  const Eigen::Vector3d centre = about.still.pose[0].centre;
  EXPECT_NEAR(centre.x(), length * std::sin(lean), 1e-7);
  // Weight and load make one field of √((m g)² + F²), in which it hangs straight.
  const auto found = frequency::free_motions(about, {});
  ASSERT_EQ(found.modes.size(), 1u);
  EXPECT_NEAR(found.modes[0].omega, std::sqrt(pull * length / (inertia + mass * length * length)), 1e-7);
  // It moves across its own line: a pitch of one takes the bob by −L along (cos, −sin) of the lean.
  const auto& shape = found.modes[0].shape;
  EXPECT_NEAR(shape[0] / shape[4], -length * std::cos(lean), 1e-7);
  EXPECT_NEAR(shape[2] / shape[4], -length * std::sin(lean), 1e-7);
}

TEST(SmallMotions, LoadsInAHingeVaryInTheBodysOwnAxes) {
  const Model model = leaning_pendulum();
  const SmallMotions about(model, equilibrium(model, rest_state(model.bodies())));
  const auto variation = laws::load_variations(model.joints(), 0, End::first, about.still, about.linear.multipliers);
  // The same joint in a state that has turned a little further about the hinge, with multipliers a little changed.
  const double step = 1e-6;
  Eigen::VectorXd move = Eigen::VectorXd::Zero(6), change = Eigen::VectorXd::Random(model.joints().count());
  move[4] = step;
  move.head<3>() = Eigen::Vector3d(0, step, 0).cross(about.still.pose[0].centre);
  change *= step * about.linear.multipliers.norm();
  const auto load_at = [&](double sign) {
    return model.joints().load_on(0, End::first, moved(about.still, sign * move),
                                  about.linear.multipliers + sign * change);
  };
  const Vector6 found = (load_at(1) - load_at(-1)) / (2 * step);
  const Vector6 told = (variation.by_motion * move + variation.by_multiplier * change) / step;
  // Central differences: rounding 1e-16 · 36 N / 1e-6.
  EXPECT_LT((found - told).norm(), 1e-7 * about.linear.multipliers.norm());
}

// Drag on the rod, forced by nothing but the water: pieces are turned with the bodies, in the water where they were.
TEST(SmallMotions, DragTurnsWithItsBody) {
  const Model model = leaning_pendulum();
  const SmallMotions about(model, equilibrium(model, rest_state(model.bodies())));
  const auto pieces = drag_pieces(model.bodies(), 0, {0, 0, 0}, {0, 0, -1}, 0.1, 1, 1000);
  ASSERT_FALSE(pieces.empty());
  const auto drag = frequency::linearised_drag(about, {}, {1.5}, pieces, {{}, 0, {0.1}});
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    EXPECT_NEAR(drag.pieces[i].axis.x(), std::sin(lean), 1e-7) << "down the rod, which leans forward";
    EXPECT_NEAR(drag.pieces[i].axis.z(), -std::cos(lean), 1e-7);
    EXPECT_NEAR(drag.pieces[i].arm.norm(), pieces[i].arm.norm(), 1e-12);
  }
}

}  // namespace
}  // namespace small_motions_test
