// Coulomb friction that sticks and slips, against closed forms.
#include "dynamics/force/friction.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/force/restoring.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "dynamics/integrate/ledger.hpp"
#include "dynamics/model/assemble.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"
#include "laws/force_kind_laws.hpp"
#include "support/motion.hpp"
#include "support/ramp_load.hpp"

namespace friction_test {
namespace {

using namespace dynamics;
using support::Motion;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double mass = 2;

RigidBody body(const std::string& name, const Eigen::Vector3d& at = {0, 0, 0}, double m = mass) {
  return RigidBody({.name = name, .mass = m, .inertia = m * Eigen::Matrix3d::Identity(), .rest_position = {at}});
}
Joint rail(int first, std::optional<int> second) {
  return {.name = "rail", .kind = JointKind::slider, .first = first, .second = second, .place = {0, 0, 0}};
}
Joint pin(int first, std::optional<int> second, const Eigen::Vector3d& place = {0, 0, 0}) {
  return {.name = "pin", .kind = JointKind::hinge, .first = first, .second = second, .place = place, .axis = {0, 1, 0}};
}

/// Friction of joints by number: joint, static, dynamic level.
struct Levels {
  std::size_t joint;
  double breakaway, sliding;
};
std::vector<Friction> on_joints(const std::vector<RigidBody>& bodies, const std::vector<Joint>& joints,
                                const std::vector<Levels>& levels) {
  std::vector<Friction> out;
  for (const Levels& l : levels)
    out.push_back({joints[l.joint].name, JointCoordinate(bodies, joints[l.joint]), l.breakaway, l.sliding});
  return out;
}

Model with_friction(std::vector<RigidBody> bodies, std::vector<Joint> joints, const std::vector<Levels>& friction,
                    std::unique_ptr<const ForceKind> other = nullptr) {
  std::vector<std::unique_ptr<const ForceKind>> forces;
  if (other) forces.push_back(std::move(other));
  forces.push_back(std::make_unique<FrictionKind>(on_joints(bodies, joints, friction)));
  return Model(std::move(bodies), {}, std::move(forces), std::move(joints));
}

std::unique_ptr<const ForceKind> spring(const std::vector<RigidBody>& bodies, int on, double k) {
  Matrix6 K = Matrix6::Zero();
  K(0, 0) = k;
  return std::make_unique<RestoringKind>("mooring", bodies, std::vector<Restoring>{{on, K}});
}

TEST(Friction, BringsASledgeToRestWhereItsEnergyIsSpent) {
  // v₀ = 3 m/s, T = 1.5 N: rest after v₀ m/T = 4 s and ½ m v₀²/T = 6 m, in the middle of a step.
  const Model model = with_friction({body("sledge")}, {rail(0, {})}, {{0, 2.0, 1.5}});
  State start = rest_state(model.bodies());
  start.velocity[0] = 3;
  Motion run(model, start);
  run.go(0.3, 40);
  EXPECT_EQ(run.changes(), 1);
  // The motion is a parabola, which the method follows exactly; a root is found to 1e-12 of the step.
  EXPECT_NEAR(run.workspace.state.pose[0].centre.x(), 6, 1e-11);
  EXPECT_NEAR(run.workspace.state.velocity[0], 0, 1e-11);
  EXPECT_NEAR(run.ledger.entries().back().dissipated, 9, 1e-11);
  EXPECT_NEAR(run.ledger.residual(), 0, 1e-10);
}

TEST(Friction, LetsGoWhereTheLoadReachesTheStaticLevel) {
  // Torque 0.5 t: it holds until 3.7/0.5 = 7.4 s, then I θ'' = 0.5 t − 3, I = 2.
  const Model model =
      with_friction({body("arm")}, {pin(0, {})}, {{0, 3.7, 3.0}}, std::make_unique<support::RampLoad>(0, 0.5));
  Motion run(model, rest_state(model.bodies()));
  run.go(0.03, 246);  // 7.38 s
  EXPECT_LT(rotation_log(run.workspace.state.pose[0].attitude).norm(), 1e-14);
  run.go(0.03, 54);  // 9 s
  EXPECT_EQ(run.changes(), 1);
  const double t = 9 - 7.4, theta = (0.7 / 2 * t * t + 0.5 / 6 * t * t * t) / mass;
  const double error = std::abs(rotation_log(run.workspace.state.pose[0].attitude).y() - theta);
  EXPECT_LT(error, 2e-4 * theta) << "second order: (h/t)² of the cubic part";
  // Work is the level times the angle, which is what the ledger has to the last digits.
  EXPECT_NEAR(run.ledger.entries().back().dissipated, 3 * rotation_log(run.workspace.state.pose[0].attitude).y(),
              1e-12);
}

TEST(Friction, StopsASpringSwingByTheSameStretchEveryHalfPeriod) {
  // k = 50 N/m, T = 3 N, released 1 m out: each half swing ends 2T/k = 0.12 m nearer; rest where k|x| <= T_s: after
  // eight half swings at 1 − 8 · 0.12 = 0.04 m (k x = 2 N).
  std::vector<RigidBody> bodies{body("sledge")};
  const Model model = with_friction(bodies, {rail(0, {})}, {{0, 3.3, 3.0}}, spring(bodies, 0, 50));
  State start = rest_state(model.bodies());
  start.pose[0].centre.x() = 1;
  Motion run(model, start, 1.0);
  run.go(0.02, 300);
  EXPECT_EQ(run.changes(), 8) << "between two swings it stands still for no time";
  // At ρ∞ = 1 the method keeps the energy of a linear spring, and friction takes exactly T times the way.
  EXPECT_NEAR(run.workspace.state.pose[0].centre.x(), 0.04, 1e-12);
  EXPECT_NEAR(run.ledger.entries().back().dissipated, 0.5 * 50 * (1 - 0.04 * 0.04), 1e-11);
}

TEST(Friction, SticksAndSlipsOnABeltForEverTheSameWay) {
  // A belt (so heavy that nothing slows it) at v = 0.1 m/s drags a block of 2 kg on a spring, k = 50: it sticks until
  // k x = T_s, slips with ω = 5 about T_d/k from there, and sticks again when it has the belt's speed. With
  // a = (T_s − T_d)/k the slip lasts 2(π − atan(aω/v))/ω and the stick 2a/v.
  const double k = 50, v = 0.1, breakaway = 3.5, sliding = 3, omega = 5;
  std::vector<RigidBody> bodies{body("block"), body("belt", {0, 0, 0}, 1e12)};
  const Model model = with_friction(
      bodies,
      {rail(0, {}), {.name = "contact", .kind = JointKind::slider, .first = 1, .second = 0, .place = {0, 0, 0}}},
      {{1, breakaway, sliding}}, spring(bodies, 0, k));
  State start = rest_state(model.bodies());
  start.velocity[6] = v;  // the belt; the block lies still and is dragged at once
  start.velocity[0] = v;
  Motion run(model, start, 1.0);
  std::vector<double> slips;
  const double h = 2e-3;
  for (int i = 0; i < 4000; ++i) {
    const int before = run.changes();
    run.go(h, 1);
    if (run.changes() > before && (run.changes() - before) % 2 == 1 && run.changes() % 2 == 1)
      slips.push_back(run.workspace.state.time);
  }
  const double a = (breakaway - sliding) / k;
  const double period = 2 * a / v + 2 * (std::numbers::pi - std::atan(a * omega / v)) / omega;
  EXPECT_NEAR(slips.front(), breakaway / k / v, 1.001 * h) << "the first after it was dragged to the static level";
  ASSERT_GE(slips.size(), 5u);
  EXPECT_EQ(
      run.changes(),
      static_cast<int>(2 * std::floor((8 - breakaway / k / v) / period) + 1) +
          ((std::fmod(8 - breakaway / k / v, period) > 2 * (std::numbers::pi - std::atan(a * omega / v)) / omega) ? 1
                                                                                                                  : 0));
  EXPECT_NEAR((slips[4] - slips[0]) / 4, period, h / 2) << "times are told to a step only";
}

/// A sledge on a rail with friction, or a latch, as given.
Model sledge(const Friction& law, std::unique_ptr<const ForceKind> other = nullptr) {
  std::vector<std::unique_ptr<const ForceKind>> forces;
  if (other) forces.push_back(std::move(other));
  forces.push_back(std::make_unique<FrictionKind>(std::vector{law}));
  return Model({body("sledge")}, {}, std::move(forces), {rail(0, {})});
}
JointCoordinate along_rail() { return JointCoordinate({body("sledge")}, rail(0, {})); }

// m v̇ = −T(v): the time to rest is ∫ m dv/T(v), by Simpson's rule, from v₀ = 2 m/s where T has fallen to its dynamic
// level.
TEST(Friction, OfStribeckRisesAsTheSledgeSlows) {
  const Friction law{.name = "rail", .coordinate = along_rail(), .breakaway = 6, .sliding = 2, .stribeck = 0.5};
  const double from = 2;
  constexpr int pieces = 2000;
  double time = 0;
  for (int i = 0; i <= pieces; ++i)
    time += (i == 0 || i == pieces ? 1 : i % 2 == 1 ? 4 : 2) * mass / law.level(from * i / pieces) * from / pieces / 3;
  const Model model = sledge(law);
  State start = rest_state(model.bodies());
  start.velocity[0] = from;
  Motion run(model, start);
  run.go(0.01, 200);
  ASSERT_EQ(run.changes(), 1);
  EXPECT_NEAR(run.events[0].time, time, 1e-4) << "second order of the step, against 1.7 s";
  EXPECT_NEAR(run.ledger.entries().back().dissipated, 0.5 * mass * from * from, 1e-4);
}

// A load that grows past the static level: it slips once, and since the level falls with its speed it never sticks
// again.
TEST(Friction, OfStribeckLetsGoOnceUnderAGrowingLoad) {
  const Model model =
      sledge({.name = "rail", .coordinate = along_rail(), .breakaway = 6, .sliding = 2, .stribeck = 0.05},
             std::make_unique<support::RampLoad>(1, 0));
  Motion run(model, rest_state(model.bodies()));
  run.go(0.01, 800);
  EXPECT_EQ(run.changes(), 1);
  EXPECT_NEAR(run.events[0].time, 6, 1e-9) << "1 N/s reaches 6 N";
}

// A latch holds a swing for a while at each of its ends: amplitude stays, the period is longer by two holds.
TEST(Friction, OfALatchHoldsASwingAtItsEnds) {
  const double k = 50, omega = 5, hold = 0.37, far = 0.8;  // √(50 N/m / 2 kg)
  const Friction latch{.name = "rail",
                       .coordinate = along_rail(),
                       .breakaway = std::numeric_limits<double>::infinity(),
                       .sliding = 0,
                       .hold = hold};
  const Model model = sledge(latch, spring({body("sledge")}, 0, k));
  State start = rest_state(model.bodies());
  start.pose[0].centre.x() = far;
  Motion run(model, start, 1.0);
  run.go(0.005, 1200);
  ASSERT_GE(run.changes(), 10);
  const double half = std::numbers::pi / omega;
  double last = 0;  // what begins at rest has been held long enough, and goes at once
  for (int i = 0; i < 10; ++i) {
    const auto& e = run.events[static_cast<std::size_t>(i)];
    EXPECT_EQ(e.becomes == 0, i % 2 == 0) << "rest, release, rest, release";
    EXPECT_NEAR(e.time - last, e.becomes == 0 ? half : hold, 2e-4) << "(ωh)²/12 of a half period";
    last = e.time;
  }
  double farthest = 0;
  for (int i = 0; i < 400; ++i) {
    run.go(0.005, 1);
    farthest = std::max(farthest, std::abs(run.workspace.state.pose[0].centre.x()));
  }
  EXPECT_NEAR(farthest, far, 1e-9) << "a latch takes no energy, and the method keeps it at ρ∞ = 1";
  EXPECT_EQ(run.ledger.entries().back().dissipated, 0);
  EXPECT_EQ(model.forces().back()->effect(), "latch");
}

TEST(Friction, OfManyJointsHoldsOnlyWhatItMust) {
  // A chain of three arms, torque on the first: its own pin lets go, the others hold.
  std::vector<RigidBody> bodies{body("a", {1, 0, 0}), body("b", {3, 0, 0}), body("c", {5, 0, 0})};
  const Model model = with_friction(bodies, {pin(0, {}), pin(1, 0, {2, 0, 0}), pin(2, 1, {4, 0, 0})},
                                    {{0, 3, 2}, {1, 50, 40}, {2, 50, 40}}, std::make_unique<support::RampLoad>(0, 1));
  Motion run(model, rest_state(model.bodies()));
  run.go(0.05, 100);
  EXPECT_EQ(run.changes(), 1);
  for (std::size_t i : {1u, 2u})
    EXPECT_LT(run.workspace.state.pose[i].attitude.angularDistance(run.workspace.state.pose[0].attitude), 1e-12)
        << "arm " << i << " turns with the first";
  EXPECT_GT(rotation_log(run.workspace.state.pose[0].attitude).norm(), 1e-3);
}

TEST(Friction, ObeysTheLawsOfForcesWhileItSlips) {
  std::vector<RigidBody> bodies{body("a", {1, 0, 0}), body("b", {3, 0, 0}), body("c", {5, 0, 0})};
  Joint slider{.name = "s", .kind = JointKind::slider, .first = 0, .second = 1, .place = {2, 1, 0}, .axis = {1, 2, 3}};
  const FrictionKind kind([&] {
    auto all = on_joints(bodies, {slider, pin(2, 1, {4, 0, 1}), pin(0, {})}, {{0, 4, 3}, {1, 5, 4}, {2, 2, 2}});
    all[0].stribeck = 1.2, all[1].stribeck = 0.7;
    return all;
  }());
  FrictionMemory memory(3);
  memory.direction = {1, -1, 1};
  State state = rest_state(bodies);
  state.velocity = Eigen::VectorXd::LinSpaced(18, -1, 1.5);
  for (std::size_t i = 0; i < 3; ++i)
    state.pose[i].attitude = rotation_exp(Eigen::Vector3d(0.2, -0.3, 0.1 + 0.2 * static_cast<double>(i)));
  laws::expect_pure(kind, state, rest_state(bodies), &memory);
  laws::expect_true_jacobians(kind, state, &memory);
  laws::expect_energy_balance(kind, state, &memory);
}

TEST(Friction, WantsPositiveLevelsInOrder) {
  const auto of = [](double breakaway, double sliding) {
    return on_joints({body("a")}, {rail(0, {})}, {{0, breakaway, sliding}});
  };
  EXPECT_THAT([&] { FrictionKind(of(1, 2)); }, ThrowsMessage<hydro::InputError>(HasSubstr("below the dynamic")));
  EXPECT_THAT([&] { FrictionKind(of(1, 0)); }, ThrowsMessage<hydro::InputError>(HasSubstr("must be positive")));
}

}  // namespace
}  // namespace friction_test
