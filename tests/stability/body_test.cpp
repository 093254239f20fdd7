// Hard cases of bodies: each must finish, keep its invariant, and say so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/force/buoyancy.hpp"
#include "dynamics/force/connector.hpp"
#include "dynamics/force/friction.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"
#include "support/double_pendulum.hpp"
#include "support/hull_meshes.hpp"
#include "support/motion.hpp"

namespace body_test {
namespace {

using namespace dynamics;
using support::Motion;
using Forces = std::vector<std::unique_ptr<const ForceKind>>;

RigidBody block(const std::string& name, const Eigen::Vector3d& at, double mass, double radius = 1) {
  return RigidBody({.name = name,
                    .mass = mass,
                    .inertia = mass * radius * radius * Eigen::Matrix3d::Identity(),
                    .rest_position = {at}});
}
double rotation_of(const State& s, std::size_t body) { return rotation_log(s.pose[body].attitude).norm(); }

/// The double pendulum, let go level, with friction of this level in both hinges.
Model rubbing(double level) {
  const Model free = support::double_pendulum(0.4);
  std::vector<Joint> joints = free.joints().joints();
  std::vector<Friction> friction;
  for (const Joint& j : joints) friction.push_back({j.name, JointCoordinate(free.bodies(), j), 1.2 * level, level});
  Forces forces;
  forces.push_back(std::make_unique<GravityKind>(free.bodies(), support::rod_gravity));
  forces.push_back(std::make_unique<FrictionKind>(std::move(friction)));
  return Model(free.bodies(), {}, std::move(forces), std::move(joints));
}

TEST(HardBodies, FrictionFromNextToNothingToWhatHoldsEverything) {
  for (const double level : {1e-6, 1e-3, 0.1, 1.0, 5.0, 20.0, 1e3, 1e6}) {
    const Model model = rubbing(level);
    Motion run(model, rest_state(model.bodies()));
    run.go(0.005, 800);
    EXPECT_LT(std::abs(run.ledger.residual()), 2e-3 * run.ledger.turnover() + 1e-12)
        << level << " N m: second order of the step";
    EXPECT_LT(model.joints().values(run.workspace.state).norm(), 1e-11) << level;
    if (level > 100) {
      EXPECT_LT(run.workspace.state.velocity.norm(), 1e-12) << "40 N m do not move it";
    }
  }
}

// Two light modules on moorings, one pushed: whatever joins them, the step is the same and energy only falls.
TEST(HardBodies, ConnectorsFromSoftToAllButRigidInOneStep) {
  for (double k = 1; k < 2e9; k *= 10) {
    const std::vector<RigidBody> bodies{block("a", {0, 0, 0}, 10), block("b", {2, 0, 0}, 10)};
    Forces forces;
    const Matrix6 moored = 100 * Matrix6::Identity();
    forces.push_back(
        std::make_unique<RestoringKind>("mooring", bodies, std::vector<Restoring>{{0, moored}, {1, moored}}));
    forces.push_back(std::make_unique<BushingConnectorKind>(
        std::vector<BushingConnector>{{{{0, {1, 0, 0}}, PointOnBody{1, {-1, 0, 0}}},
                                       Eigen::Vector3d::Constant(k),
                                       {0, 0, 0},
                                       {0, 0, 0},
                                       {0, 0, 0},
                                       {0, 0, 0}}}));
    const Model model(bodies, {}, std::move(forces));
    State start = rest_state(bodies);
    start.velocity << 0.3, 0.1, -0.2, 0.1, 0.2, 0.3, 0, 0, 0, 0, 0, 0;
    Motion run(model, start, 0.5);
    const double begun = model.kinetic_energy(start);
    run.go(0.05, 400);
    double held = run.ledger.kinetic();
    for (const auto& e : run.ledger.entries()) held += e.stored;
    EXPECT_LT(held, begun * (1 + 1e-9)) << k << " N/m";
    EXPECT_GT(held, 0.1 * begun) << k << " N/m: motion that the step resolves is kept";
  }
}

// A platform on six floaters: hinged to it, or free on bushings, with added mass twice their own; pushed once.
class PlatformWithSixFloaters : public testing::TestWithParam<bool> {};

TEST_P(PlatformWithSixFloaters, SwingsAndComesToRest) {
  std::vector<RigidBody> bodies{block("deck", {0, 0, 3}, 30e3, 6)};
  std::vector<Joint> hinges;
  std::vector<BushingConnector> bushings;
  std::vector<Restoring> afloat;
  std::vector<AddedMass> added;
  for (int i = 0; i < 6; ++i) {
    const double angle = i * std::numbers::pi / 3;
    const Eigen::Vector3d at(8 * std::cos(angle), 8 * std::sin(angle), 0), out(std::cos(angle), std::sin(angle), 0);
    bodies.push_back(block(fmt::format("float{}", i), at, 2e3, 1));
    const Eigen::Vector3d top = at + Eigen::Vector3d(0, 0, 1.5);
    hinges.push_back({.name = fmt::format("hinge{}", i),
                      .kind = JointKind::hinge,
                      .first = 0,
                      .second = i + 1,
                      .place = top,
                      .axis = Eigen::Vector3d::UnitZ().cross(out)});
    bushings.push_back({{{0, top - Eigen::Vector3d(0, 0, 3)}, PointOnBody{i + 1, top - at}},
                        Eigen::Vector3d::Constant(1e7),
                        Eigen::Vector3d::Constant(1e4),
                        Eigen::Vector3d::Constant(1e5),
                        Eigen::Vector3d::Constant(1e3),
                        {0, 0, 0}});
    Matrix6 C = Matrix6::Zero(), D = Matrix6::Zero();
    C.diagonal() << 2e3, 2e3, 60e3, 40e3, 40e3, 2e3;
    D.diagonal() << 4e3, 4e3, 8e3, 4e3, 4e3, 4e3;
    afloat.push_back({i + 1, C, D});
    Matrix6 A = Matrix6::Zero();
    A.diagonal() << 4e3, 4e3, 4e3, 2e3, 2e3, 500;
    added.push_back({{i + 1}, A});
  }
  Forces forces;
  forces.push_back(std::make_unique<RestoringKind>("hydrostatics", bodies, afloat));
  const bool hinged = GetParam();
  if (!hinged) forces.push_back(std::make_unique<BushingConnectorKind>(bushings));
  const Model model(bodies, added, std::move(forces), hinged ? hinges : std::vector<Joint>{});
  State start = rest_state(bodies);
  start.velocity.setZero();
  for (std::size_t b = 0; b < bodies.size(); ++b) start.velocity[6 * static_cast<Eigen::Index>(b) + 2] = 0.8;
  Motion run(model, start);
  double before = model.kinetic_energy(start), worst = 0;
  for (int second = 0; second < 120; ++second) {
    run.go(0.1, 10);
    double held = run.ledger.kinetic();
    for (const auto& e : run.ledger.entries()) held += e.stored;
    worst = std::max(worst, held - before);
    before = held;
  }
  EXPECT_LT(worst, 1e-3 * model.kinetic_energy(start)) << "energy falls, but for the second order of the step";
  EXPECT_LT(run.workspace.state.velocity.norm(), 0.02);
  for (std::size_t b = 0; b < bodies.size(); ++b) EXPECT_LT(rotation_of(run.workspace.state, b), 0.05);
}
INSTANTIATE_TEST_SUITE_P(HardBodies, PlatformWithSixFloaters, testing::Bool(),
                         [](const auto& which) { return which.param ? "Hinged" : "OnBushings"; });

// A plate in water: added mass ten times its own, on the left of the equations, so the period is √((M + A)/C).
TEST(HardBodies, AddedMassTenTimesTheMass) {
  const std::vector<RigidBody> bodies{block("plate", {0, 0, 0}, 100)};
  Matrix6 A = 1000 * Matrix6::Identity(), C = 4.4e3 * Matrix6::Identity();
  Forces forces;
  forces.push_back(std::make_unique<RestoringKind>("hydrostatics", bodies, std::vector<Restoring>{{0, C}}));
  const Model model(bodies, {{{0}, A}}, std::move(forces));
  State start = rest_state(bodies);
  start.pose[0].centre.z() = 0.5;
  Motion run(model, start, 1.0);
  run.go(0.01, 157);  // half a period of π s, to 1 ms
  EXPECT_NEAR(run.workspace.state.pose[0].centre.z(), -0.5, 1e-4) << "(ωh)²/12 of a half period and its end";
  EXPECT_LT(std::abs(run.ledger.residual()), 1e-8 * run.ledger.turnover());
}

// Top-heavy: from a hair's breadth off upright it turns over, through half a turn, and keeps its energy.
TEST(HardBodies, CapsizeThroughHalfATurn) {
  const hydro::Water water{.density = 1000, .gravity = 9.81};
  namespace hh = hydro::hydrostatics;
  const double mass = 1000 * 10 * 2 * 0.9;
  const std::vector<RigidBody> bodies{RigidBody({.name = "pontoon",
                                                 .mass = mass,
                                                 .inertia = mass * Eigen::Vector3d(1.2, 9, 9).asDiagonal(),
                                                 .rest_position = {Eigen::Vector3d(0, 0, -0.9)},
                                                 .centre_of_gravity = {Eigen::Vector3d(0, 0, 1.6)}})};
  const auto shape = std::make_shared<const FloatingShape>(hh::Hull(support::box_mesh({-5, -1, 0}, {5, 1, 2})));
  Forces forces;
  forces.push_back(std::make_unique<GravityKind>(bodies, water.gravity));
  forces.push_back(std::make_unique<BuoyancyKind>(bodies, std::vector<Buoyancy>{{0, shape}}, water));
  const Model model(bodies, {}, std::move(forces));
  State start = rest_state(bodies);
  start.velocity[3] = 1e-3;
  Motion run(model, start, 1.0);
  double farthest = 0;
  for (int i = 0; i < 2000; ++i) {
    run.go(0.01, 1);
    farthest = std::max(farthest, rotation_of(run.workspace.state, 0));
  }
  EXPECT_GT(farthest, 3.0) << "over, by 180 degrees";
  EXPECT_LT(std::abs(run.ledger.residual()), 1e-3 * run.ledger.turnover());
}

// A stiff swing of 0.1 s by steps of 1 s: it halves, or says why not; what it leaves is finite and has no more energy.
TEST(HardBodies, StepTenTimesTheFastestPeriod) {
  const std::vector<RigidBody> bodies{block("a", {0, 0, 0}, 10)};
  Forces forces;
  forces.push_back(std::make_unique<AxialConnectorKind>(
      std::vector<AxialConnector>{{{{0, {0, 0, 0}}, PointOnGround{{0, 0, 3}}}, {.stiffness = 4e4}, 2.9}}));
  forces.push_back(std::make_unique<GravityKind>(bodies, 9.81));
  const Model model(bodies, {}, std::move(forces));
  State start = rest_state(bodies);
  start.velocity[0] = 3;
  Motion run(model, start, 0.5);
  const double begun = model.kinetic_energy(start);
  try {
    run.go(1.0, 60);
  } catch (const hydro::NumericsError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("cannot go on"));
  }
  EXPECT_TRUE(run.workspace.state.velocity.allFinite());
  EXPECT_LT(model.kinetic_energy(run.workspace.state), 20 * begun + 10 * 9.81 * 6);
}

}  // namespace
}  // namespace body_test
