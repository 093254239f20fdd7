// Friction of the bed on nodes that lie on it. (D95)
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/line/driven.hpp"
#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/node_damping.hpp"
#include "dynamics/line/stepper.hpp"
#include "support/line_models.hpp"

namespace friction_test {
namespace {

using namespace support;
using Eigen::Vector3d;

constexpr double g = 9.81, mu = 0.4, weight_per_metre = 10 * g, diameter = 0.05, bed_stiffness = 1e6;
constexpr double sunk = weight_per_metre / (bed_stiffness * diameter);  // m, by its own weight
constexpr double slip = mu * sunk;                                      // m, what the bed gives way before it slips

/// `n` metres of line of 10 kg/m on the bed at z = 0.
Description lying(int n) {
  Description d;
  d.nodes.assign(static_cast<std::size_t>(n) + 1, Node{});
  Segment s = Segment::rod(1, 10);
  s.axial_stiffness = 1e6;
  s.axial_damping = 3e3;
  s.diameter = diameter;
  d.segments.assign(static_cast<std::size_t>(n), s);
  d.gravity = g;
  d.bed = {{.z = 0, .stiffness = bed_stiffness, .damping = 1e4, .friction = mu}};
  return d;
}

/// Straight along x, as deep as the bed lets it sink.
State straight(const Line& line, double speed = 0) {
  State s{.position = Places::Zero(3, line.nodes()), .velocity = Places::Zero(3, line.nodes()), .tension = {}};
  for (int i = 0; i < line.nodes(); ++i) s.position.col(i) = Vector3d(i, 0, -sunk);
  s.velocity.row(0).setConstant(speed);
  s.tension = Eigen::VectorXd::Zero(line.segments());
  return s;
}

void run(Stepper& stepper, State& s, double duration, double h) {
  for (int i = 0; i < static_cast<int>(std::lround(duration / h)); ++i) stepper.step(s, h);
}

// v²/2μg; then the bed gives some of the way back on which friction builds up.
TEST(BedFriction, StopsASlidingLineAsCoulombHasIt) {
  for (const Scheme scheme : {Scheme::energy_momentum, Scheme::generalised_alpha}) {
    const Line line(lying(4));
    State s = straight(line, 1.0);
    Stepper stepper(line, {.scheme = scheme});
    stepper.start(s);
    const double motion = stepper.energies().kinetic;
    run(stepper, s, 2, 1e-3);
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(s.position(0, i) - i, 1 / (2 * mu * g) - slip / 2, slip);
    // All of the motion is lost but what the shear may hold: ½ μ²W d of ½ m v².
    EXPECT_NEAR(stepper.energies().lost_friction / motion, 1, mu * mu * g * sunk + 1e-3);
    EXPECT_LT(std::abs(stepper.energies().residual()), 1e-3 * motion);  // generalised-α at this step
  }
}

class Steady final : public Path {
 public:
  Place at(double t) const override { return {Vector3d(-0.2 * t, 0, -sunk), Vector3d(-0.2, 0, 0), Vector3d::Zero()}; }
};

// Dragged by its end, the line is drawn taut from there on: T falls by μw a metre.
TEST(BedFriction, DrawsADraggedLineTautByItsWeight) {
  Description d = lying(10);
  d.held = {{.node = 0, .path = std::make_shared<Steady>()}};
  const Line line(d);
  State s = straight(line, -0.2);
  Stepper stepper(line, {.scheme = Scheme::generalised_alpha});
  stepper.start(s);
  run(stepper, s, 4, 5e-3);
  const auto balance = *stepper.balance(s);
  for (int j = 0; j < 10; ++j) {  // half a metre of every end node, a metre of all others beyond the segment
    const double beyond = 10 - j - 0.5;
    EXPECT_NEAR(balance.tension[j], mu * weight_per_metre * beyond, 0.01 * mu * weight_per_metre) << j;
  }
}

// Below μW it stays, however long: the shear holds without creep.
TEST(BedFriction, HoldsForEverWhatPullsLess) {
  Description d = lying(4);
  d.nodes.back().force = Vector3d(0.3 * mu * 4 * weight_per_metre, 0, 0);
  const Line line(d);
  State s = straight(line);
  Stepper stepper(line, {.scheme = Scheme::generalised_alpha});
  stepper.start(s);
  run(stepper, s, 20, 0.01);
  const Places before = s.position;
  run(stepper, s, 40, 0.01);
  EXPECT_LT((s.position - before).cwiseAbs().maxCoeff(), 1e-6 * slip);
  EXPECT_LT(s.position(0, 0), slip);
  d.nodes.back().force *= 4;  // 1.2 μW
  const Line pulled(d);
  Stepper other(pulled, {.scheme = Scheme::generalised_alpha});
  s = straight(pulled);
  other.start(s);
  run(other, s, 2, 0.01);
  EXPECT_NEAR(s.velocity(0, 0), 0.2 * mu * g * 2, 0.01 * mu * g);  // (F − μW)/m for 2 s
}

// Friction is against what would slide, whatever its direction on the bed.
TEST(BedFriction, HasNoPreferredDirection) {
  double way[2];
  for (int k = 0; k < 2; ++k) {
    const Line line(lying(3));
    State s = straight(line);
    s.velocity.row(k == 0 ? 0 : 1).setConstant(0.7);
    Stepper stepper(line, {.scheme = Scheme::energy_momentum});
    stepper.start(s);
    run(stepper, s, 0.15, 1e-3);
    way[k] = s.position(k == 0 ? 0 : 1, 2) - (k == 0 ? 2 : 0);
  }
  EXPECT_NEAR(way[0], way[1], 1e-12);
}

// Of energy-momentum the loss is never negative, step by step, and the ledger closes to rounding.
TEST(BedFriction, NeverGivesBackWhatItLost) {
  Description d = lying(6);
  d.held = {{.node = 0}};
  const Line line(d);
  State s = straight(line);
  for (int i = 0; i < 7; ++i) s.velocity.col(i) = Vector3d(0, 0.6 * i * std::cos(i), 0.3 * i);  // flung up and aside
  Stepper stepper(line, {});
  stepper.start(s);
  double before = 0;
  for (int i = 0; i < 1500; ++i) {
    stepper.step(s, 2e-3);
    const double lost = stepper.energies().lost_friction;
    EXPECT_GE(lost, before - 1e-10) << i;  // rounding of the joules held
    before = lost;
  }
  EXPECT_GT(before, 1);
  EXPECT_LT(std::abs(stepper.energies().residual()), 1e-8 * stepper.energies().dissipated());
}

/// A mooring that sags on a bed with friction, its fairlead moved aside until much of it slips.
struct Dragged {
  static Description description() {
    Description d;
    Segment s = Segment::rod(59.0 / 15, 8 * 59.0 / 15);
    s.axial_stiffness = 30e6;
    s.axial_damping = 1e5;
    s.catenary = true;
    s.diameter = 0.036;
    d.nodes.assign(16, Node{.forces = {std::make_shared<NodeDamping>(NodeDamping::Coefficients{1})}});
    d.segments.assign(15, s);
    d.held = {{.node = 0}, {.node = 15}};
    d.gravity = g;
    d.bed = {{.z = -14, .stiffness = 3e6, .damping = 3e4, .friction = 0.6}};
    return d;
  }
  DrivenLine line{description(), {15}, 0.8};
  Vector3d fairlead{0, 0, -1.1}, velocity{0.3, 1.0, 0.1};
  double t = 0;

  Dragged() {
    const Line still(description());
    State s = ends_at(still, fairlead);
    s.position.col(0) = Vector3d(56, 0, -14);
    line.start(equilibrium(still, hanging_shape(still, s)), {{fairlead, velocity}}, Places::Zero(3, 1));
    for (int i = 1; i <= 40; ++i) line.accept(t = 0.05 * i, {{fairlead += 0.05 * velocity, velocity}});
  }
  Vector3d pull(const Vector3d& dx, const Vector3d& dv) {
    return line.pulls(t + 0.05, {{fairlead + 0.05 * velocity + dx, velocity + dv}}).force.col(0);
  }
};

TEST(BedFriction, TakesWhatSlipsOfAMooring) {
  Dragged m;
  EXPECT_GT(m.line.energies().lost_friction, 10);
  const Eigen::Matrix2Xd strain = m.line.state().position.topRows<2>() - m.line.state().grip;
  EXPECT_GT(strain.colwise().norm().maxCoeff(), 0);
}

TEST(BedFriction, HasTheDerivativesOfItsStep) {
  Dragged m;
  constexpr double e = 1e-5;
  Eigen::Matrix3d by_x, by_v;
  for (int c = 0; c < 3; ++c) {
    const Vector3d d = e * Vector3d::Unit(c), none = Vector3d::Zero();
    by_x.col(c) = (m.pull(d, none) - m.pull(-d, none)) / (2 * e);
    by_v.col(c) = (m.pull(none, d) - m.pull(none, -d)) / (2 * e);
  }
  m.pull(Vector3d::Zero(), Vector3d::Zero());
  const auto& p = m.line.pulls(m.t + 0.05, {{m.fairlead + 0.05 * m.velocity, m.velocity}});
  EXPECT_LT((p.by_place - by_x).cwiseAbs().maxCoeff(), 1e-5 * by_x.cwiseAbs().maxCoeff());  // e² and rounding over e
  EXPECT_LT((p.by_velocity - by_v).cwiseAbs().maxCoeff(), 1e-5 * by_v.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace friction_test
