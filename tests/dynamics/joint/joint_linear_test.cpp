// Small motions with joints: modes, responses and loads in joints, against single bodies and closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>

#include "dynamics/force/gravity.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/frequency/modes.hpp"
#include "dynamics/model/assemble.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "laws/signal_laws.hpp"

namespace joint_linear_test {
namespace {

using namespace dynamics;
using frequency::free_motions;
using testing::Each;
using testing::SizeIs;

constexpr double g = 9.81;

RigidBody body(const std::string& name, const Eigen::Vector3d& at, double mass, const Eigen::Matrix3d& inertia) {
  return RigidBody({.name = name, .mass = mass, .inertia = inertia, .rest_position = {at}});
}
Eigen::Matrix3d diagonal(double x, double y, double z) { return Eigen::Vector3d(x, y, z).asDiagonal(); }

Joint joint(JointKind kind, int first, std::optional<int> second, const Eigen::Vector3d& place) {
  return {.name = "joint",
          .kind = kind,
          .first = first,
          .second = second,
          .place = place,
          .axis = Eigen::Vector3d::UnitY()};
}

Model model_of(std::vector<RigidBody> bodies, std::vector<Joint> joints, std::vector<Restoring> springs = {},
               bool weight = false) {
  std::vector<std::unique_ptr<const ForceKind>> forces;
  if (weight) forces.push_back(std::make_unique<GravityKind>(bodies, g));
  if (!springs.empty()) forces.push_back(std::make_unique<RestoringKind>("mooring", bodies, springs));
  return Model(std::move(bodies), {}, std::move(forces), std::move(joints));
}

/// Two rods of 3 and 2 kg hung under each other: hinge at 0, centres at −1 and −2.5 m, second hinge at −2 m.
Model double_pendulum() {
  return model_of(
      {body("top", {0, 0, -1}, 3, diagonal(1, 1, 0.1)), body("low", {0, 0, -2.5}, 2, diagonal(0.5, 0.5, 0.1))},
      {joint(JointKind::hinge, 0, {}, {0, 0, 0}), joint(JointKind::hinge, 1, 0, {0, 0, -2})}, {}, true);
}

TEST(JointLinear, ACompoundPendulumHasItsPeriodFromTheLoadInItsHinge) {
  // Nothing but the hinge's load at rest, m g, restores it: ω² = m g l / (I + m l²).
  const Model m = model_of({body("bob", {0, 0, -2}, 3, diagonal(1, 2, 2.5))},
                           {joint(JointKind::hinge, 0, {}, {0, 0, 0})}, {}, true);
  const auto found = free_motions(m, {});
  ASSERT_THAT(found.modes, SizeIs(1));
  EXPECT_NEAR(found.modes[0].omega, std::sqrt(3 * g * 2 / (2 + 3 * 4.0)), 1e-12);
  EXPECT_NEAR(found.modes[0].shape[0] / found.modes[0].shape[4], -2, 1e-12)
      << "the bob goes back as its rod leans forward";
}

TEST(JointLinear, ADoublePendulumHasTheTwoFrequenciesOfItsPairOfAngles) {
  // Angles of both rods: M = [I₁ + m₁l₁² + m₂L₁², m₂L₁l₂; ., I₂ + m₂l₂²], K = diag(m₁l₁ + m₂L₁, m₂l₂) g.
  Eigen::Matrix2d M, K;
  M << 1 + 3 + 2 * 4, 2 * 2 * 0.5, 2 * 2 * 0.5, 0.5 + 2 * 0.25;
  K << (3 + 2 * 2) * g, 0, 0, 2 * 0.5 * g;
  const Eigen::Vector2d w2 = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d>(K, M).eigenvalues();
  const auto found = free_motions(double_pendulum(), {});
  ASSERT_THAT(found.modes, SizeIs(2));
  for (int i : {0, 1}) EXPECT_NEAR(found.modes[static_cast<std::size_t>(i)].omega, std::sqrt(w2[i]), 1e-11);
}

TEST(JointLinear, TwoBodiesWeldedTogetherSwingAsTheOneBodyTheyMake) {
  const Matrix6 spring = (Vector6() << 100, 200, 300, 400, 500, 600).finished().asDiagonal();
  const Eigen::Vector3d a(1, 0, 0), b(-2, 0.5, 1), centre = (4 * a + 2 * b) / 6;
  const auto moved = [](double mass, const Eigen::Vector3d& d) {
    return Eigen::Matrix3d(mass * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose()));
  };
  const Model pair = model_of({body("a", a, 4, diagonal(2, 3, 4)), body("b", b, 2, diagonal(1, 1, 1.5))},
                              {joint(JointKind::fixed, 0, 1, {0, 0, 0})}, {{0, spring}});
  // The same spring holds the same point: about the common centre it is carried there.
  const Matrix6 T = shift_from_centre(a - centre);
  const Model one =
      model_of({body("one", centre, 6, diagonal(3, 4, 5.5) + moved(4, a - centre) + moved(2, b - centre))}, {},
               {{0, T.transpose() * spring * T}});
  const auto of_pair = free_motions(pair, {}), of_one = free_motions(one, {});
  ASSERT_THAT(of_pair.modes, SizeIs(6));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(of_pair.modes[i].omega / of_one.modes[i].omega, 1, 1e-12);
}

TEST(JointLinear, WhatJointsAndHeldModesCarryIsNotOutOfBalance) {
  const auto linear = double_pendulum().linear_at_rest();
  EXPECT_LT(linear.unbalanced.norm(), 1e-12 * 5 * g);
  // A pendulum that leans is not at rest: its moment about the hinge, m g l, is left over.
  const Model leaning =
      model_of({body("bob", {2, 0, 0}, 3, diagonal(1, 2, 2.5))}, {joint(JointKind::hinge, 0, {}, {0, 0, 0})}, {}, true);
  const Eigen::VectorXd left = leaning.linear_at_rest().unbalanced;
  const double about_hinge = left[4] - 2 * left[2];  // pitch moment, z × x: a force up at +x pitches nose up, negative
  EXPECT_NEAR(about_hinge, 3 * g * 2, 1e-9);
}

TEST(JointLinear, LoadsVaryAboutRestAsTheirDerivativesSay) {
  const Model m = double_pendulum();
  const State rest = rest_state(m.bodies());
  const Eigen::VectorXd lambda = Eigen::VectorXd::LinSpaced(m.joints().count(), -3, 4);
  for (const int j : {0, 1})
    for (const End end : {End::first, End::second}) {
      if (j == 0 && end == End::second) continue;  // the ground
      const auto variation = laws::load_variations(m.joints(), j, end, rest, lambda);
      constexpr double step = 1e-6;
      for (int mode = 0; mode < m.modes(); ++mode) {
        const auto at = [&](double d) {
          State moved = rest;
          Pose& pose = moved.pose[static_cast<std::size_t>(mode / 6)];
          if (mode % 6 < 3)
            pose.centre[mode % 6] += d;
          else
            pose.attitude = rotation_exp(d * Eigen::Vector3d::Unit(mode % 6 - 3));
          return m.joints().load_on(j, end, moved, lambda);
        };
        const Vector6 slope = (at(step) - at(-step)) / (2 * step);
        // Central differences: step² of third derivatives and 1e-16 / step of rounding, of loads of order ten.
        EXPECT_LT((slope - variation.by_motion.col(mode)).norm(), 1e-8) << "joint " << j << ", mode " << mode;
      }
      EXPECT_LT((variation.by_multiplier * lambda - m.joints().load_on(j, end, rest, lambda)).norm(), 1e-13);
    }
}

TEST(JointLinear, ThePairOfLoadsOfAJointIsEqualAndOpposite) {
  const Model m = double_pendulum();
  State s = rest_state(m.bodies());
  for (Pose& p : s.pose) {  // both turned together about the upper hinge
    const Eigen::Quaterniond R = rotation_exp(Eigen::Vector3d(0, 0.7, 0));
    p.centre = R * p.centre;
    p.attitude = R;
  }
  const Eigen::VectorXd lambda = Eigen::VectorXd::LinSpaced(m.joints().count(), -3, 4);
  const Vector6 first = m.joints().load_on(1, End::first, s, lambda),
                second = m.joints().load_on(1, End::second, s, lambda);
  EXPECT_LT((first + second).norm(), 1e-12) << "the same axes here, the same place";
}

TEST(CloseJoints, CarriesAlongWhatIsNotPlaced) {
  // A second body welded to one that is placed goes where it must; velocities too.
  const Model m =
      model_of({body("a", {1, 0, 0}, 4, diagonal(2, 3, 4)), body("b", {-2, 0.5, 1}, 2, diagonal(1, 1, 1.5))},
               {joint(JointKind::fixed, 0, 1, {0, 0, 0})});
  State s = rest_state(m.bodies());
  const Eigen::Quaterniond R = rotation_exp(Eigen::Vector3d(0.3, -0.6, 0.9));
  const Eigen::Vector3d shift(3, 2, 1), omega(0.2, -0.4, 0.1);
  s.pose[0] = {R * s.pose[0].centre + shift, R};
  s.velocity.segment<3>(3) = omega;
  close_joints(m, {true, false}, s);
  EXPECT_LT((s.pose[1].centre - (R * Eigen::Vector3d(-2, 0.5, 1) + shift)).norm(), 1e-13);
  EXPECT_LT(s.pose[1].attitude.angularDistance(R), 1e-13);
  close_joint_velocities(m, {true, false}, s);
  EXPECT_LT((s.velocity.segment<3>(6) - omega.cross(s.pose[1].centre - s.pose[0].centre)).norm(), 1e-13);
  EXPECT_LT((s.velocity.segment<3>(9) - omega).norm(), 1e-13);
  EXPECT_THAT(std::vector<double>(s.velocity.data(), s.velocity.data() + 3), Each(0.0))
      << "of a body that was given one";
}

TEST(JointCoordinates, TellsTheAngleOfAHingeAndTheWayOfASlider) {
  const Model hinge = double_pendulum();
  State s = rest_state(hinge.bodies());
  const Eigen::Quaterniond R = rotation_exp(Eigen::Vector3d(0, 2.5, 0));
  s.pose[1].attitude = R;
  EXPECT_NEAR(hinge.joints().coordinate(1, s), -2.5, 1e-14) << "the first body of the joint is the one that turned";
  const Model slider =
      model_of({body("a", {0, 0, 0}, 1, diagonal(1, 1, 1)), body("b", {0, 1, 0}, 1, diagonal(1, 1, 1))},
               {joint(JointKind::slider, 0, 1, {0, 1, 0})});
  s = rest_state(slider.bodies());
  for (Pose& p : s.pose) {
    p.attitude = rotation_exp(Eigen::Vector3d(0.4, 0, 0));
    p.centre = p.attitude * p.centre;
  }
  s.pose[1].centre += 0.75 * (s.pose[0].attitude * Eigen::Vector3d::UnitY());
  EXPECT_NEAR(slider.joints().coordinate(0, s), 0.75, 1e-14);
}

}  // namespace
}  // namespace joint_linear_test
