// Impacts, contact and friction between shapes, against closed forms.
#include "dynamics/force/contact.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/force/gravity.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "dynamics/integrate/ledger.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"
#include "support/motion.hpp"

namespace contact_test {
namespace {

using namespace dynamics;
using support::Motion;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double g = 9.81, pi = std::numbers::pi;

RigidBody ball(const Eigen::Vector3d& at, double mass = 2, double radius = 0.1) {
  return RigidBody({.name = "ball",
                    .mass = mass,
                    .inertia = 0.4 * mass * radius * radius * Eigen::Matrix3d::Identity(),
                    .rest_position = {at}});
}
const HalfSpace floor_level{{0, 0, 0}, {0, 0, 1}};

Contact on_floor(int body, const Shape& shape, double restitution, double friction, HalfSpace ground = floor_level) {
  return {"floor", body, {}, {shape, ground}, restitution, friction};
}

Model bodies_with_gravity(std::vector<RigidBody> bodies, std::vector<Contact> contacts, double gravity = g) {
  std::vector<std::unique_ptr<const ForceKind>> forces;
  if (gravity > 0) forces.push_back(std::make_unique<GravityKind>(bodies, gravity));
  forces.push_back(std::make_unique<ContactKind>(std::move(contacts)));
  return Model(std::move(bodies), {}, std::move(forces));
}

const ContactState& state_of(const Motion& run, std::size_t i = 0) {
  for (const auto& memory : run.workspace.memory)
    if (const auto* found = dynamic_cast<const ContactMemory*>(memory.get())) return found->contact[i];
  throw std::logic_error("no contact");
}
Eigen::Vector3d place(const Motion& run) { return run.workspace.state.pose[0].centre; }

// (D25), (D26): dropped from H the ball has v₀ = √(2gH); it comes back after 2 e v₀/g, e times that, … and lies still
// after t₀ (1 + e)/(1 − e), t₀ = v₀/g. The step is exact for a constant acceleration, so only the last bounces, which
// would all end within a step, are lost: the rest comes at most a step early.
TEST(Contact, LetsABallBounceUntilItsSeriesOfBouncesEnds) {
  constexpr double H = 0.5, e = 0.7, h = 0.01;
  const Model model = bodies_with_gravity({ball({0, 0, H + 0.1})}, {on_floor(0, Ball{{0, 0, 0}, 0.1}, e, 0)});
  Motion run(model, rest_state(model.bodies()));
  const double v0 = std::sqrt(2 * g * H), t0 = v0 / g, end = t0 * (1 + e) / (1 - e);
  run.go(h, static_cast<int>(end / h));
  EXPECT_EQ(state_of(run).is, ContactState::open);
  run.go(h, 1);
  EXPECT_EQ(state_of(run).is, ContactState::slides) << "closed";
  EXPECT_NEAR(place(run).z(), 0.1, 1e-9);
  EXPECT_NEAR(run.workspace.state.velocity.norm(), 0, 1e-9);
  EXPECT_NEAR(state_of(run).dissipated, 2 * g * H, 1e-9 * 2 * g * H) << "all that it had";
  EXPECT_NEAR(run.ledger.residual(), 0, 1e-9 * 2 * g * H);
}

TEST(Contact, KeepsTheTimeOfEachImpact) {
  constexpr double H = 0.5, e = 0.8, h = 0.013;
  const Model model = bodies_with_gravity({ball({0, 0, H + 0.1})}, {on_floor(0, Ball{{0, 0, 0}, 0.1}, e, 0)});
  Motion run(model, rest_state(model.bodies()));
  const double t0 = std::sqrt(2 * H / g);
  std::size_t seen = 0;
  double at = t0;
  for (int n = 0; n < 200 && seen < 5; ++n) {
    const double before = run.workspace.state.time;
    run.go(h, 1);
    if (state_of(run).impacts == seen) continue;
    ++seen;
    EXPECT_GT(at, before);
    EXPECT_LE(at, run.workspace.state.time + 1e-12);
    const double after = run.workspace.state.time - at, v = g * t0 * std::pow(e, static_cast<double>(seen));
    EXPECT_NEAR(place(run).z(), 0.1 + v * after - g * after * after / 2, 1e-10) << "a parabola from the exact instant";
    at += 2 * v / g;
  }
  EXPECT_EQ(seen, 5u);
}

// Sliding stops after v²/(2μg); what is left of the energy is heat. A floor that leans less than atan μ holds the
// block.
TEST(Contact, BringsASlidingBlockToRest) {
  constexpr double mu = 0.3, v = 2, h = 0.01;
  RigidBody block({.name = "block",
                   .mass = 4,
                   .inertia = Eigen::Matrix3d::Identity(),
                   .rest_position = {Eigen::Vector3d(0, 0, 0.1)}});
  std::vector<Contact> corners;
  for (const double x : {-0.4, 0.4})
    for (const double y : {-0.3, 0.3}) corners.push_back(on_floor(0, Ball{{x, y, -0.1}, 0}, 0, mu));
  const Model model = bodies_with_gravity({block}, corners);
  State start = rest_state(model.bodies());
  start.velocity.head<2>() << v * std::cos(0.4), v * std::sin(0.4);
  Motion run(model, start);
  run.go(h, 150);
  const double way = v * v / (2 * mu * g);
  EXPECT_NEAR(place(run).x(), way * std::cos(0.4), 1e-7);
  EXPECT_NEAR(place(run).y(), way * std::sin(0.4), 1e-7);
  EXPECT_NEAR(place(run).z(), 0.1, 1e-12);
  EXPECT_LT(run.workspace.state.velocity.norm(), 1e-10);
  double heat = 0;
  for (std::size_t i = 0; i < 4; ++i) heat += state_of(run, i).dissipated;
  EXPECT_NEAR(heat, 0.5 * 4 * v * v, 1e-6 * 0.5 * 4 * v * v) << "by the trapezium rule over a power that falls evenly";
}

TEST(Contact, HoldsABlockOnASlopeThatFrictionAllows) {
  for (const double slope : {0.28, 0.31}) {  // atan 0.3 = 0.2915
    constexpr double mu = 0.3;
    const Eigen::Vector3d up(std::sin(slope), 0, std::cos(slope));
    const Contact contact = on_floor(0, Ball{{0, 0, 0}, 0}, 0, mu, {{0, 0, 0}, up});
    RigidBody point({.name = "block",
                     .mass = 4,
                     .inertia = Eigen::Matrix3d::Identity(),
                     .rest_position = {Eigen::Vector3d(0, 0, 0)},
                     .free = {true, true, true, false, false, false}});
    const Model model = bodies_with_gravity({point}, {contact});
    Motion run(model, rest_state(model.bodies()));
    run.go(0.01, 100);
    const double a = slope < std::atan(mu) ? 0 : g * (std::sin(slope) - mu * std::cos(slope));
    EXPECT_NEAR(place(run).x(), a / 2 * std::cos(slope), 1e-9) << slope;
    EXPECT_EQ(state_of(run).is, a > 0 ? ContactState::slides : ContactState::sticks);
  }
}

// A bowling ball: it slides until v = ωR, which is 5/7 of what it began with, after 2 v₀/(7 μ g), and then rolls for
// ever.
TEST(Contact, LetsABallRollOnceItsSlipIsSpent) {
  constexpr double mu = 0.2, v0 = 3, R = 0.1;
  const Model model = bodies_with_gravity({ball({0, 0, R})}, {on_floor(0, Ball{{0, 0, 0}, R}, 0, mu)});
  State start = rest_state(model.bodies());
  start.velocity[0] = v0;
  Motion run(model, start);
  const double stop = 2 * v0 / (7 * mu * g);
  run.go(0.005, 400);
  ASSERT_EQ(state_of(run).is, ContactState::sticks);
  ASSERT_FALSE(run.events.empty());
  EXPECT_NEAR(run.events.back().time, stop, 1e-9);
  EXPECT_NEAR(run.workspace.state.velocity[0], 5.0 / 7 * v0, 1e-6);
  EXPECT_NEAR(run.workspace.state.velocity[4], 5.0 / 7 * v0 / R, 1e-4);
  EXPECT_NEAR(place(run).x(), v0 * stop - mu * g * stop * stop / 2 + 5.0 / 7 * v0 * (2 - stop), 1e-5);
}

// Housner (1963): a block b × 2b rocks about its corners as an inverted pendulum, α = atan(b/2 / b); where it comes
// down on the other corner its rate falls by r = 1 − (3/2) sin²α, for a uniform block, since the angular momentum about
// the new corner stays. The time of the first fall is a quadrature of the energy.
TEST(Contact, LetsABlockRockFromCornerToCorner) {
  constexpr double b = 0.25, height = 1.0, m = 10, h = 2e-3;
  const double R = std::hypot(b / 2, height / 2), alpha = std::atan2(b, height), start_angle = 0.5 * alpha;
  const double I = m / 12 * (b * b + height * height);
  const auto placed = [&](double theta) {  // about the right corner, which stands at x = b/2
    return Eigen::Vector3d(b / 2 - R * std::sin(alpha - theta), 0, R * std::cos(alpha - theta));
  };
  RigidBody block({.name = "block",
                   .mass = m,
                   .inertia = I * Eigen::Matrix3d::Identity(),
                   .rest_position = {Eigen::Vector3d(0, 0, height / 2)},
                   .free = {true, false, true, false, true, false}});
  const Model model = bodies_with_gravity({block}, {on_floor(0, Ball{{-b / 2, 0, -height / 2}, 0}, 0, 0.9),
                                                    on_floor(0, Ball{{b / 2, 0, -height / 2}, 0}, 0, 0.9)});
  State start = rest_state(model.bodies());
  start.pose[0].centre = placed(start_angle);
  start.pose[0].attitude = rotation_exp({0, start_angle, 0});
  Motion run(model, start);
  const double Io = I + m * R * R, p2 = m * g * R / Io;
  // ½θ̇² = p² (cos(α − θ₀) − cos(α − θ)); with θ = θ₀(1 − s²) the root at the start goes.
  double fall = 0;
  constexpr int parts = 2000;
  for (int i = 0; i < parts; ++i) {
    const double s = (i + 0.5) / parts, theta = start_angle * (1 - s * s);
    fall += 2 * start_angle * s / std::sqrt(2 * p2 * (std::cos(alpha - start_angle) - std::cos(alpha - theta))) / parts;
  }
  const double rate = std::sqrt(2 * p2 * (std::cos(alpha - start_angle) - std::cos(alpha)));
  run.go(h, static_cast<int>(fall / h) + 1);
  ASSERT_FALSE(run.events.empty());
  EXPECT_NEAR(run.events.front().time, fall, 1e-5) << "of a second-order step";
  const double r = 1 - 1.5 * std::sin(alpha) * std::sin(alpha);
  EXPECT_NEAR(std::abs(run.workspace.state.velocity[4]), r * rate, 5e-3 * rate) << "shortly after";
  EXPECT_EQ(state_of(run, 0).is, ContactState::sticks);
  EXPECT_EQ(state_of(run, 1).is, ContactState::open);
  run.go(h, 3000);
  EXPECT_NEAR(run.workspace.state.velocity.norm(), 0, 1e-9) << "it has come to rest";
}

TEST(Contact, PassesAnElasticBlowOnAndKeepsMomentum) {
  std::vector<RigidBody> bodies;
  std::vector<Contact> contacts;
  for (int i = 0; i < 5; ++i) bodies.push_back(ball({0.3 * i, 0, 0}));
  for (int i = 0; i < 4; ++i)
    contacts.push_back({"pair", i, i + 1, {Ball{{0, 0, 0}, 0.1}, Ball{{0, 0, 0}, 0.1}}, 1, 0});
  const Model model = bodies_with_gravity(bodies, contacts, 0);
  State start = rest_state(model.bodies());
  start.velocity[0] = 1.5;
  Motion run(model, start);
  run.go(0.01, 200);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(run.workspace.state.velocity[6 * i], 0, 1e-13);
  EXPECT_NEAR(run.workspace.state.velocity[24], 1.5, 1e-13);
  EXPECT_EQ(state_of(run, 0).impacts, 1u);
}

/// Five boxes side by side, touching, in water that couples all of them.
struct Row {
  std::vector<RigidBody> bodies;
  std::vector<Contact> contacts;
  Eigen::MatrixXd added;

  Row(double restitution, double friction) : added(30, 30) {
    for (int i = 0; i < 5; ++i)
      bodies.push_back(RigidBody({.name = "m",
                                  .mass = 900.0 + 50 * i,
                                  .inertia = Eigen::Vector3d(2000, 3000, 4000).asDiagonal(),
                                  .rest_position = {Eigen::Vector3d(4 * i, 0, 0.1 * i)}}));
    for (int i = 0; i < 4; ++i)
      for (const double y : {-1.5, 1.5})
        contacts.push_back(
            {"fender", i, i + 1, {Ball{{1.9, y, 0.2}, 0.1}, HalfSpace{{-2, 0, 0}, {-1, 0, 0}}}, restitution, friction});
    for (Eigen::Index i = 0; i < 30; ++i)
      for (Eigen::Index j = 0; j < 30; ++j) added(i, j) = std::cos(1.7 * static_cast<double>(i * j % 11));
    added = 40 * added * added.transpose();
  }
  Model model() const {
    std::vector<std::unique_ptr<const ForceKind>> forces;
    forces.push_back(std::make_unique<ContactKind>(contacts));
    return Model(bodies, {{{0, 1, 2, 3, 4}, added}}, std::move(forces));
  }
};

// All five meet at one instant. What contacts do is equal and opposite at one point, so that the momentum of bodies and
// water, linear and about the origin, stays to rounding; the kinetic energy that goes is what the ledger says.
TEST(Contact, OfFiveModulesAtOnceKeepsMomentum) {
  for (const double friction : {0.0, 0.4}) {
    const Row row(0.5, friction);
    const Model model = row.model();
    State start = rest_state(model.bodies());
    for (Eigen::Index i = 0; i < 30; ++i) start.velocity[i] = 0.2 * std::sin(2.3 * static_cast<double>(i));
    for (int i = 0; i < 5; ++i) start.velocity[6 * i] = 2 - i;
    const double before = model.kinetic_energy(start);
    Motion run(model, start);
    const State& now = run.workspace.state;
    const Eigen::VectorXd gained = model.mass_times(now, now.velocity - start.velocity);
    Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = linear;
    for (int i = 0; i < 5; ++i) {
      linear += gained.segment<3>(6 * i);
      angular +=
          gained.segment<3>(6 * i + 3) + start.pose[static_cast<std::size_t>(i)].centre.cross(gained.segment<3>(6 * i));
    }
    const double size = gained.cwiseAbs().maxCoeff();
    EXPECT_GT(size, 100);
    EXPECT_LT(linear.norm(), 1e-13 * size) << friction;
    EXPECT_LT(angular.norm(), 1e-12 * size) << friction << ": arms of 16 m";
    double lost = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      lost += state_of(run, i).dissipated;
      EXPECT_GE(model.forces()[0]->contact()->motion(i, now).parting, -1e-9) << "none goes on approaching";
    }
    EXPECT_GT(lost, 0);
    EXPECT_NEAR(before - model.kinetic_energy(now), lost, 1e-12 * before);
  }
}

TEST(Contact, SharesABlowEvenlyWhereItIsSymmetric) {
  Row row(0.3, 0);
  row.added = Eigen::MatrixXd::Zero(30, 30);
  const Model model = row.model();
  State start = rest_state(model.bodies());
  start.velocity[0] = 1;
  Motion run(model, start);
  EXPECT_NEAR(state_of(run, 0).dissipated, state_of(run, 1).dissipated, 1e-12);
  EXPECT_GT(state_of(run, 0).dissipated, 0);
}

/// Boxes one on another, each on four corners of the one below; the least with half-lengths about 0.3 m.
struct Stack {
  std::vector<RigidBody> bodies;
  std::vector<Contact> contacts;
  double restitution, friction;

  Stack(double e, double mu) : restitution(e), friction(mu) {}
  void put(double mass, const Eigen::Vector3d& half) {
    const double below = bodies.empty() ? 0 : bodies.back().properties().rest_position.xyz.z() + last_.z();
    const Eigen::Vector3d sides = 4 * half.cwiseProduct(half);
    bodies.push_back(
        RigidBody({.name = "box",
                   .mass = mass,
                   .inertia = Eigen::Vector3d(mass / 12 * (sides.y() + sides.z()), mass / 12 * (sides.x() + sides.z()),
                                              mass / 12 * (sides.x() + sides.y()))
                                  .asDiagonal(),
                   .rest_position = {Eigen::Vector3d(0, 0, below + half.z())}}));
    const int i = static_cast<int>(bodies.size()) - 1;
    for (const double x : {-1, 1})
      for (const double y : {-1, 1}) {
        const Ball corner{{x * half.x(), y * half.y(), -half.z()}, 0};
        if (i == 0) contacts.push_back(on_floor(0, corner, restitution, friction));
        if (i > 0)
          contacts.push_back(
              {"corner", i, i - 1, {corner, HalfSpace{{0, 0, last_.z()}, {0, 0, 1}}}, restitution, friction});
      }
    last_ = half;
  }

 private:
  Eigen::Vector3d last_;
};

// (D25) What goes down through a stack comes up again, so that impulses are larger than what they change, and speeds
// are known to the rounding of those sums, not to that of the fastest. A stack that falls as a whole, by h, meets the
// floor at √(2gh): the energy goes as the ledger has it, and it comes to rest where it began.
TEST(Contact, LetsAStackOfThreeSettle) {
  for (const double restitution : {0.0, 0.3, 0.6}) {
    Stack stack(restitution, 0.5);
    stack.put(30, {0.5, 0.4, 0.2});
    stack.put(20, {0.4, 0.3, 0.15});
    stack.put(10, {0.3, 0.2, 0.1});
    const Model model = bodies_with_gravity(stack.bodies, stack.contacts);
    State start = rest_state(model.bodies());
    for (Pose& pose : start.pose) pose.centre.z() += 0.05;
    Motion run(model, start);
    ASSERT_NO_THROW(run.go(0.01, 200)) << restitution;
    EXPECT_LT(run.workspace.state.velocity.norm(), 1e-9) << restitution;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(run.workspace.state.pose[i].centre.z(), model.bodies()[i].rest_centre().z(), 1e-8);
    EXPECT_NEAR(run.ledger.residual(), 0, 1e-6 * 60 * g * 0.05);
  }
}

// Stacks of any masses that are struck from below at once, each contact with its own speed: the impulses settle, and
// no contact goes on approaching.
// What wanders from corner to corner by less than 1e-6 a round is left (of sums up to 10 m/s).
TEST(Contact, FindsTheImpulsesOfAnyStack) {
  auto any = [n = 0](double from, double to) mutable {
    return from + (to - from) * (0.5 + 0.5 * std::sin(++n * 12.9898));
  };
  for (int trial = 0; trial < 60; ++trial) {
    const double restitution = trial % 3 == 0 ? 0 : 0.3;
    Stack stack(restitution, any(0.05, 0.9));
    const int high = 2 + trial % 4;
    for (int i = 0; i < high; ++i) stack.put(std::pow(10, any(0, 2)), {any(0.2, 0.5), any(0.2, 0.5), any(0.05, 0.3)});
    const Model model = bodies_with_gravity(stack.bodies, stack.contacts);
    State start = rest_state(model.bodies());
    for (Eigen::Index i = 0; i < start.velocity.size(); ++i) start.velocity[i] = any(-1, 1);
    const double before = model.kinetic_energy(start);
    Workspace w(model, start);
    GeneralizedAlpha integrator(model, {});
    ASSERT_NO_THROW(integrator.start(w)) << "stack " << trial;
    // By Newton's law with friction a bounce may give more than it takes (Kane's paradox); without bounce it cannot.
    if (restitution == 0) {
      EXPECT_LE(model.kinetic_energy(w.state), before * (1 + 1e-9)) << "stack " << trial;
    }
    for (std::size_t i = 0; i < stack.contacts.size(); ++i)
      EXPECT_GE(model.forces().back()->contact()->motion(i, w.state).parting, -1e-3) << "stack " << trial;
  }
}

// (D131) The wall is passed in a fraction of a step; the ball comes back from it at e times its speed all the same.
TEST(Contact, IsNotPassedThroughInOneStep) {
  constexpr double R = 0.1, e = 0.5, way = 3;
  const Contact wall{"wall", 0, {}, {Ball{{0, 0, 0}, R}, Box{{way + 0.5, 0, 0}, {0.5, 2, 2}}}, e, 0};
  for (const double v : {1.0, 20.0, 200.0, 3000.0})
    for (const double h : {0.001, 0.02, 0.1, 0.5}) {
      const Model model = bodies_with_gravity({ball({0, 0, 0}, 2, R)}, {wall}, 0);
      State start = rest_state(model.bodies());
      start.velocity[0] = v;
      Motion run(model, start);
      const double meets = (way - R) / v;
      run.go(h, static_cast<int>(meets / h) + 2);
      EXPECT_EQ(state_of(run).impacts, 1u) << v << " m/s, " << h << " s";
      EXPECT_NEAR(run.workspace.state.velocity[0], -e * v, 1e-12 * v);
      EXPECT_NEAR(place(run).x(), way - R - e * v * (run.workspace.state.time - meets), 1e-8 * v * h + 1e-9);
    }
}

// Two rods that swing through each other between two ends of a step, and two that go by.
TEST(Contact, OfRodsThatCrossIsSeen) {
  for (const double height : {0.0, 0.5}) {
    RigidBody rod({.name = "rod", .mass = 3, .inertia = Eigen::Matrix3d::Identity()});
    const Contact crossing{
        "rods", 0, {}, {Rod{{0, -1, 0}, {0, 1, 0}, 0.02}, Rod{{1, 0, height - 1}, {1, 0, height - 0.3}, 0.03}}, 0, 0};
    const Model model = bodies_with_gravity({rod}, {crossing}, 0);
    State start = rest_state(model.bodies());
    start.velocity[0] = 50;
    Motion run(model, start);
    run.go(0.1, 1);
    const bool meets = height - 0.3 + 0.05 > 0;  // the other ends below the way of the first, or not
    EXPECT_EQ(state_of(run).impacts, meets ? 1u : 0u) << height;
  }
}

TEST(Contact, OfShapesWithoutThicknessIsRefused) {
  EXPECT_THROW(ContactKind({{"thin", 0, {}, {Rod{{0, -1, 0}, {0, 1, 0}, 0}, Ball{{1, 0, 0}, 0}}, 0, 0}}),
               hydro::InputError);
}

TEST(Contact, OfShapesThatOverlapAtTheStartIsRefusedByName) {
  const Model model = bodies_with_gravity({ball({0, 0, 0.05})}, {on_floor(0, Ball{{0, 0, 0}, 0.1}, 0, 0)});
  Workspace w(model, rest_state(model.bodies()));
  GeneralizedAlpha integrator(model, {});
  EXPECT_THAT([&] { integrator.start(w); },
              ThrowsMessage<hydro::InputError>(testing::AllOf(HasSubstr("\"floor\""), HasSubstr("0.05 m"))));
}

/// Gradient and curvature of a gap are its derivatives.
void expect_derivatives(const GapConstraint& c) {
  ConstraintEnds at{{{0.1, 0.2, 0.3}, rotation_exp({0.2, -0.1, 0.3}).toRotationMatrix()},
                    {{1.4, 0.1, 0.5}, rotation_exp({-0.3, 0.2, 0.1}).toRotationMatrix()},
                    0};
  const Gradient G = gradient(c, at);
  for (int k = 0; k < 12; ++k) {
    const auto moved_by = [&](double way) {
      ConstraintEnds out = at;
      const Eigen::Vector3d move = way * Eigen::Vector3d::Unit(k % 3);
      if (k / 3 == 0) out.first.origin += move;
      if (k / 3 == 1) out.first.axes = rotation_exp(move).toRotationMatrix() * at.first.axes;
      if (k / 3 == 2) out.second.origin += move;
      if (k / 3 == 3) out.second.axes = rotation_exp(move).toRotationMatrix() * at.second.axes;
      return value(c, out);
    };
    const double by = 1e-6, slope = (moved_by(by) - moved_by(-by)) / (2 * by);
    EXPECT_NEAR(k < 6 ? G.first[k] : G.second[k - 6], slope, 1e-8) << k;
  }
}

TEST(Contact, HasTheDerivativesOfItsGap) {
  expect_derivatives({Ball{{0.1, 0, 0}, 0.2}, Ball{{0, 0.1, 0.05}, 0.1}});
  expect_derivatives({Ball{{0.1, 0, 0}, 0.2}, HalfSpace{{-0.3, 0, 0}, Eigen::Vector3d(-1, 0.2, 0.3).normalized()}});
  expect_derivatives(
      {Box{{0, 0.1, 0}, {0.3, 0.2, 0.4}, rotation_exp({0, 0, 0.4}).toRotationMatrix()}, Ball{{-0.1, 0, 0}, 0.1}});
  expect_derivatives({Rod{{0.1, -0.5, 0}, {0.2, 0.6, 0.1}, 0.1}, Rod{{-0.1, 0, -0.7}, {0, 0.1, 0.5}, 0.2}});
}

TEST(Contact, KnowsTheShortestWayOfEachPairOfShapes) {
  const ClosestPoints m = closest_points(Box{{0, 0, 0}, {1, 2, 3}}, Ball{{2, 3, 0}, 0.5});
  EXPECT_NEAR(m.gap, std::sqrt(2.0) - 0.5, 1e-15) << "from an edge";
  EXPECT_NEAR(closest_points(Box{{0, 0, 0}, {1, 2, 3}}, Ball{{0.9, 0, 0}, 0.5}).gap, -0.6, 1e-15)
      << "out by the nearest face";
  EXPECT_NEAR(closest_points(Rod{{0, 0, -1}, {0, 0, 1}, 0.3}, Rod{{2, 0, -3}, {2, 0, 0.5}, 0.4}).gap, 1.3, 1e-15)
      << "side by side";
  EXPECT_NEAR(closest_points(Rod{{0, 0, -1}, {0, 0, 1}, 0.3}, Rod{{2, 0, -3}, {2, 0, 0.5}, 0.4}).on_first.z(), -0.25,
              1e-15)
      << "in the middle of both";
  EXPECT_NEAR(closest_points(Rod{{0, 0, 0}, {1, 0, 0}, 0}, Rod{{3, 0, 0}, {4, 0, 0}, 0}).gap, 2, 1e-15) << "end to end";
  EXPECT_THROW(closest_points(Box{{0, 0, 0}, {1, 2, 3}}, floor_level), hydro::InputError);
}

}  // namespace
}  // namespace contact_test
