#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "dynamics/force/connector.hpp"
#include "dynamics/force/constant_load.hpp"
#include "dynamics/force/force_law.hpp"
#include "dynamics/force/pto.hpp"
#include "dynamics/force/recorded_load.hpp"
#include "laws/force_kind_laws.hpp"

namespace spring_test {
namespace {

using namespace dynamics;
const auto bodies = support::two_bodies();

const LineLaw cubic{.stiffness = 200, .damping = 30, .cubic = 50, .quadratic_damping = 12};
const LineLaw table{.damping = 5, .table_x = {-1, 0.1, 0.6, 2}, .table_force = {-300, 0, 100, 700}};
const LineLaw cable{.stiffness = 200, .damping = 90, .tension_only = true};

TEST(LineLaw, SpringsHaveTheirClosedForms) {
  EXPECT_NEAR(cubic.at(0.5, 0).force, 200 * 0.5 + 50 * 0.125, 1e-12);
  EXPECT_NEAR(cubic.at(0.5, -2).force, 106.25 - 30 * 2 - 12 * 4, 1e-12);
  EXPECT_NEAR(table.at(0.35, 0).force, 50, 1e-12);
  EXPECT_NEAR(table.at(3, 0).force, 700 + 600 / 1.4, 1e-10);  // the last piece goes on
  EXPECT_NEAR(table.at(-2, 0).force, -300 - 300 / 1.1, 1e-10);
  EXPECT_NEAR(table.at(0.6, 0).stored, (0.5 * 0.5 * 100) + (-0.1 * 0.5 * 300 / 1.1 * 0.1), 1e-12);
}

TEST(LineLaw, ForceIsTheSlopeOfTheEnergyAndDerivativesAreTrue) {
  constexpr double e = 1e-6;
  for (const LineLaw* law : {&cubic, &table, &cable})
    for (const double x : {-1.7, -0.4, 0.05, 0.3, 1.1, 2.6})
      for (const double v : {-1.3, 0.0, 0.8}) {
        const SpringDamperForce a = law->at(x, v);
        const double slope = (law->at(x + e, 0).stored - law->at(x - e, 0).stored) / (2 * e);
        EXPECT_NEAR(law->at(x, 0).force, slope, 1e-6) << x;
        EXPECT_NEAR(a.by_x, (law->at(x + e, v).force - law->at(x - e, v).force) / (2 * e), 1e-6) << x << ' ' << v;
        // A damper that its spring bounds has a corner of curvature c²/S at rest: e c²/S = 8e-4.
        EXPECT_NEAR(a.by_rate, (law->at(x, v + e).force - law->at(x, v - e).force) / (2 * e), 1e-3) << x << ' ' << v;
        EXPECT_GE(a.dissipated, 0);
        EXPECT_NEAR(a.force * v, law->at(x, 0).force * v + a.dissipated, 1e-9);
      }
}

// (D51): whatever the rate, a cable neither pushes nor jumps as it tightens.
TEST(LineLaw, ACableNeverPushesAndTightensWithoutAJump) {
  for (const double v : {-50.0, -1.0, 0.0, 1.0, 50.0}) {
    EXPECT_EQ(cable.at(-0.1, v).force, 0);
    EXPECT_LT(cable.at(1e-9, v).force, 1e-6);
    for (const double x : {0.01, 0.1, 1.0}) EXPECT_GE(cable.at(x, v).force, 0);
  }
  EXPECT_NEAR(cable.at(1000, 1).force, 200e3 + 90, 0.05);  // pulled hard, the damper is as it says
}

TEST(PtoLaw, KeepsToItsLimitAndItsStops) {
  const PtoLaw law{.line = {.stiffness = -350, .damping = 60, .cubic = 20},
                   .preload = 100,
                   .force_limit = 500,
                   .lower = EndStop{-2, 1e4, 0},
                   .upper = EndStop{3, 1e4, 200}};
  EXPECT_NEAR(law.at(1, 0.5).force, -350 + 20 + 30 + 100, 1e-12);
  EXPECT_EQ(law.at(2, -9).force, -500);
  EXPECT_EQ(law.at(2, 20).force, 500);
  EXPECT_NEAR(law.at(3.1, 0).force, -350 * 3.1 + 20 * 3.1 * 3.1 * 3.1 + 100 + 1000, 1e-9);
  EXPECT_LT(law.at(-2.1, 0).force, -500);
}

TEST(ForceLaws, HoldForEveryLawOfAnAxialConnector) {
  const Ends between{{0, Eigen::Vector3d(1, 0.5, 0.2)}, PointOnBody{1, Eigen::Vector3d(-1, 0.5, -0.1)}};
  const Ends to_ground{{1, Eigen::Vector3d(1, 0, 0)}, PointOnGround{Eigen::Vector3d(9, 1, -2)}};
  laws::expect_force_laws(
      AxialConnectorKind({{between, cubic, 1.5}, {between, table, 1.6}, {to_ground, cable, 2}, {to_ground, cable, 9}}),
      bodies);
}

Joint joint(JointKind kind, std::optional<int> second = 1) {
  return {.name = "j", .kind = kind, .first = 0, .second = second, .place = {2, 0.3, -0.2}, .axis = {0.2, 1, 0.4}};
}

TEST(ForceLaws, HoldForPowerTakeOffOnSlidersAndHinges) {
  const PtoLaw plain{.line = cubic, .preload = 40, .lower = {}, .upper = {}};
  PtoLaw bounded = plain;
  bounded.force_limit = 60;
  bounded.upper = EndStop{0.1, 3000, 200};
  bounded.lower = EndStop{-0.1, 3000, 200};
  for (const JointKind kind : {JointKind::slider, JointKind::hinge})
    for (const PtoLaw& law : {plain, bounded})
      laws::expect_force_laws(PtoKind({{JointCoordinate(bodies, joint(kind), 0), law},
                                       {JointCoordinate(bodies, joint(kind, std::nullopt), 1), law, -1}}),
                              bodies);
}

TEST(ForceLaws, HoldForSpringsByATableOnSlidersAndHinges) {
  // It has two places of rest, at −1 and 1, and pushes away from 0.
  const LineLaw bistable{.table_x = {-2, -0.5, 0.5, 2}, .table_force = {-100, 50, -50, 100}};
  for (const JointKind kind : {JointKind::slider, JointKind::hinge})
    laws::expect_force_laws(
        CoordinateForceKind<LineLaw>({{JointCoordinate(bodies, joint(kind), 0), bistable, 1, "a"},
                                      {JointCoordinate(bodies, joint(kind, std::nullopt), 1), bistable, -1, "b"}},
                                     {"spring", "by a table", "the spring"}),
        bodies);
}

TEST(Pto, OfAHingeTurnsTheSecondBodyBackAndTheFirstForth) {
  State s = rest_state(bodies);
  s.pose[1].attitude = rotation_exp(0.1 * Eigen::Vector3d(0.2, 1, 0.4).normalized());
  const PtoKind kind(
      {{JointCoordinate(bodies, joint(JointKind::hinge), 0), {.line = {.stiffness = 500}, .lower = {}, .upper = {}}}});
  const Eigen::VectorXd F = laws::load(kind, s, nullptr);
  const Eigen::Vector3d moment = 50 * Eigen::Vector3d(0.2, 1, 0.4).normalized();
  EXPECT_LT((F.segment<3>(9) + moment).norm(), 1e-10);
  EXPECT_LT((F.segment<3>(3) - moment).norm(), 1e-10);
  EXPECT_LT(F.head<3>().norm() + F.segment<3>(6).norm(), 1e-12);
}

TEST(ForceLaws, HoldForRecordedLoads) {
  const Eigen::MatrixXd on_modes = Eigen::MatrixXd::Random(12, 4);
  const RecordedLoadKind kind({{0.5, on_modes}, {0.2, 2 * on_modes}});
  laws::expect_force_laws(kind, bodies);
  State s = rest_state(bodies);
  s.time = 0.35;  // between samples 0 and 1 of the first record, 1 and 2 of the second
  const Eigen::VectorXd between =
      0.3 * on_modes.col(0) + 0.7 * on_modes.col(1) + 0.5 * on_modes.col(1) + 1.5 * on_modes.col(2);
  EXPECT_LT((laws::load(kind, s, nullptr) - between).norm(), 1e-12);
  s.time = 99;
  EXPECT_LT((laws::load(kind, s, nullptr) - 3 * on_modes.col(3)).norm(), 1e-12) << "as at its end";
}

TEST(ForceLaws, HoldForConstantLoads) {
  laws::expect_force_laws(
      ConstantLoadKind({{0, {1, 2, 3}, {10, -20, 30}, {5, 6, -7}}, {1, {0, 0, 0}, {4, 0, 0}, {0, 0, 0}}}), bodies);
}

}  // namespace
}  // namespace spring_test
