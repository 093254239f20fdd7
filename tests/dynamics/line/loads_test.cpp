#include "loads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dynamics/line/node_damping.hpp"
#include "dynamics/line/stepper.hpp"
#include "hydro/base/random.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "springs.hpp"
#include "support/counted_waves.hpp"
#include "support/line_models.hpp"

namespace loads_test {
namespace {

using namespace support;
namespace hw = hydro::waves;
using Eigen::Vector3d;

std::shared_ptr<const hw::WaveField> still(double current = 0) {
  const hydro::Water water{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(30)};
  return std::make_shared<hw::HarmonicField>(std::vector<hw::Harmonic>{}, water, hw::HarmonicField::Options{},
                                             hw::Current::uniform({current, 0}));
}

std::shared_ptr<const NodeForce> damping(bool componentwise) {
  return std::make_shared<NodeDamping>(NodeDamping::Coefficients{0.3, 0.7, componentwise});
}

Description wet_line(Wet wet, double current) {
  Description d;
  d.nodes.assign(5, Node{.mass = 1, .forces = {damping(false)}});
  Segment s = Segment::rod(1, 2);
  s.diameter = 0.2;
  s.cd = 1.3;
  s.cd_tangential = 0.1;
  s.ca = 0.8;
  d.segments.assign(4, s);
  d.water = {.field = still(current), .wet = wet, .buoyancy = true};
  return d;
}

struct Sample {
  Places x{3, 5}, v{3, 5}, a{3, 5};
  explicit Sample(std::uint64_t seed) {
    const hydro::RandomStream random(seed, 1);
    std::uint64_t k = 0;
    for (Places* p : {&x, &v, &a})
      for (int i = 0; i < 15; ++i) p->data()[i] = random.normal(k++);
    for (int i = 0; i < 5; ++i) x.col(i) = Vector3d(0.8 * i, 0, -1.3 + 0.5 * i) + 0.1 * x.col(i);
  }
};

Places force(const Line& line, const Places& x, const Places& v, const Places& a) {
  Loads loads(line);
  Places out = Places::Zero(3, line.nodes());
  loads.add({0, x, v, a}, {0, 0, 0}, out, nullptr);
  return out;
}

/// A chain of four rods that hangs into waves of 2 s and 0.2 m, four metres long.
struct ChainInWaves {
  std::shared_ptr<const support::CountedWaves> waves =
      std::make_shared<support::CountedWaves>(hw::linear_field(hw::Sea::regular(
          hydro::WaveAmplitude::from_metres(0.2), hydro::AngularFrequency::from_period_s(2),
          hydro::Angle::from_degrees(20), {.density = 1000, .depth = hydro::WaterDepth::from_metres(30)})));
  Line line;
  State state;

  ChainInWaves() : line(description()) {
    state.position = state.velocity = Places::Zero(3, 5);
    state.position.row(2) = Eigen::RowVectorXd::LinSpaced(5, -0.5, -4.5);
    state.tension = Eigen::VectorXd::Zero(4);
  }
  Description description() const {
    Description d = wet_line(Wet::all, 0);
    for (Node& n : d.nodes) n = {};
    d.held = {{.node = 0}};
    d.water.field = waves;
    d.water.buoyancy = false;
    return d;
  }
  void run(Stepper& stepper, double h, int steps) {
    for (int i = 0; i < steps; ++i) stepper.step(state, h);
  }
};

TEST(LineFlow, IsTakenOnceAStep) {
  for (const Scheme scheme : {Scheme::energy_momentum, Scheme::generalised_alpha}) {
    ChainInWaves chain;
    Stepper stepper(chain.line, {.scheme = scheme});
    stepper.start(chain.state);
    chain.waves->asked = 0;
    chain.run(stepper, 0.01, 50);
    EXPECT_EQ(chain.waves->asked, 50u * 5u) << name_of(scheme);
  }
}

TEST(LineFlow, OfTheBalanceAfterAStepIsThatOfTheStep) {
  ChainInWaves chain;
  Stepper stepper(chain.line, {.scheme = Scheme::generalised_alpha});
  stepper.start(chain.state);
  chain.run(stepper, 0.01, 50);
  chain.waves->asked = 0;
  Stepper::Balance balance;
  ASSERT_TRUE(stepper.find_balance(chain.state, balance));
  EXPECT_EQ(chain.waves->asked, 0u);
  State beside = chain.state;
  beside.position.col(4).x() += 1e-3;
  ASSERT_TRUE(stepper.find_balance(beside, balance));
  EXPECT_EQ(chain.waves->asked, 5u) << "a state to which no step has led has the flow where it is";
}

// Errors of second order fall by 4, here to 4.001; a flow taken where the step begins leaves less than 2.
TEST(LineFlow, LeavesStepsTheirOrder) {
  const auto after = [](double h) {
    ChainInWaves chain;
    Stepper stepper(chain.line, {.scheme = Scheme::energy_momentum});
    stepper.start(chain.state);
    chain.run(stepper, h, static_cast<int>(std::lround(0.8 / h)));
    return chain.state.position;
  };
  const Places coarse = after(0.02), middle = after(0.01), fine = after(0.005);
  EXPECT_NEAR((coarse - middle).norm() / (middle - fine).norm(), 4, 0.05);
}

TEST(LineLoads, DerivativesAreThoseOfTheLoads) {
  for (const bool componentwise : {false, true}) {
    Description d = wet_line(Wet::all, 0.4);
    for (Node& n : d.nodes) n.forces = {damping(componentwise)};
    const Line line(d);
    const Sample s(3);
    const By by{.x = 0.6, .v = 1.7, .a = 2.9};
    Loads loads(line);
    Blocks blocks;
    blocks.set_zero(5, 4);
    Places sink = Places::Zero(3, 5);
    loads.add({0, s.x, s.v, s.a}, by, sink, &blocks);
    constexpr double e = 1e-6, rounding = 1e-6;  // of loads of some 1000 N over 2e-6
    for (int j = 0; j < 5; ++j)
      for (int c = 0; c < 3; ++c) {
        Places u = Places::Zero(3, 5);
        u(c, j) = e;
        const Places slope = (force(line, s.x + by.x * u, s.v + by.v * u, s.a + by.a * u) -
                              force(line, s.x - by.x * u, s.v - by.v * u, s.a - by.a * u)) /
                             (2 * e);
        for (int i = 0; i < 5; ++i) {
          Vector3d block = Vector3d::Zero();
          const auto k = static_cast<std::size_t>(i);
          if (i == j) block = blocks.diagonal[k].col(c);
          if (j == i + 1) block = blocks.upper[k].col(c);
          if (i == j + 1) block = blocks.lower[k - 1].col(c);
          EXPECT_LT((slope.col(i) - block).norm(), rounding) << i << ' ' << j << ' ' << c;
        }
      }
  }
}

// A level rod across the stream: ½ρC_D D U² per length; along it the skin's; at rest the sum of both ends is the whole.
TEST(LineLoads, DragOfARodIsMorisons) {
  Description d = wet_line(Wet::all, 0.5);
  d.gravity = 0;
  d.water.buoyancy = false;
  const Line line(d);
  Places x(3, 5), zero = Places::Zero(3, 5);
  for (int i = 0; i < 5; ++i) x.col(i) = Vector3d(0, i, -3);
  EXPECT_NEAR(force(line, x, zero, zero).row(0).sum(), 0.5 * 1000 * 1.3 * 0.2 * 0.25 * 4, 1e-9);
  for (int i = 0; i < 5; ++i) x.col(i) = Vector3d(i, 0, -3);
  EXPECT_NEAR(force(line, x, zero, zero).row(0).sum(), 0.5 * 1000 * 0.1 * 3.141592653589793 * 0.2 * 0.25 * 4, 1e-9);
}

TEST(LineLoads, AddedMassOfARodIsAcrossItsAxisAlone) {
  Description d = wet_line(Wet::all, 0);
  d.gravity = 0;
  d.water.buoyancy = false;
  const Line line(d);
  Places x(3, 5), zero = Places::Zero(3, 5), a = Places::Zero(3, 5);
  for (int i = 0; i < 5; ++i) x.col(i) = Vector3d(i, 0, -3);
  a.row(0).setConstant(1);
  a.row(2).setConstant(2);
  const Places f = force(line, x, zero, a);
  EXPECT_NEAR(f.row(0).sum(), 0, 1e-12);
  EXPECT_NEAR(f.row(2).sum(), -2 * 0.8 * 1000 * 3.141592653589793 / 4 * 0.04 * 4, 1e-9);
}

TEST(LineLoads, WhatIsOutOfTheWaterFeelsNoneOfIt) {
  Description d = wet_line(Wet::below_surface, 0.5);
  d.gravity = 0;
  for (Node& n : d.nodes) n.forces.clear();
  const Line line(d);
  Places x(3, 5), zero = Places::Zero(3, 5);
  // Upright, from 2.5 m below to 1.5 m above: 2.5 m are wet.
  for (int i = 0; i < 5; ++i) x.col(i) = Vector3d(0, 0, -2.5 + i);
  const Places f = force(line, x, zero, zero);
  EXPECT_NEAR(f.row(0).sum(), 0.5 * 1000 * 1.3 * 0.2 * 0.25 * 2.5, 1e-9);
  EXPECT_NEAR(f.row(2).sum(), 1000 * 9.81 * 3.141592653589793 / 4 * 0.04 * 2.5, 1e-9);
  EXPECT_EQ(f.col(4).norm(), 0);
}

/// The wet area of a circle of radius 0.1 m by its chords, over its own; `depth` of its centre, m.
double wet_share(double depth) {
  constexpr int strips = 20000;
  double area = 0;
  for (int i = 0; i < strips; ++i) {
    const double z = -0.1 + 0.2 * (i + 0.5) / strips;  // above the centre
    if (z < depth) area += 2 * std::sqrt(0.01 - z * z) * 0.2 / strips;
  }
  return area / (3.141592653589793 * 0.01);
}

// (D158): a line that floats level is wet by a segment of its circular section, and lifted as much.
TEST(LineLoads, GrowAsASectionDipsIntoTheWater) {
  Description d = wet_line(Wet::below_surface, 0);
  d.gravity = 0;
  for (Node& n : d.nodes) n.forces.clear();
  const Line line(d);
  Places x(3, 5), zero = Places::Zero(3, 5);
  const double whole = 1000 * 9.81 * 3.141592653589793 / 4 * 0.04 * 4;
  for (const double depth : {-0.2, -0.1, -0.05, 0.0, 0.03, 0.1, 0.3}) {
    for (int i = 0; i < 5; ++i) x.col(i) = Vector3d(i, 0, -depth);
    // The strips are off by half of one at the surface, 1/15 000 of the section.
    EXPECT_NEAR(force(line, x, zero, zero).row(2).sum(), whole * wet_share(depth), 1e-4 * whole) << depth;
  }
}

// (D158): drag, added mass and lift have one share, and no corner where the section dips in or goes under.
TEST(LineLoads, GrowSmoothlyAsALevelLineSinks) {
  Description d = wet_line(Wet::below_surface, 0.4);
  d.gravity = 0;
  for (Node& n : d.nodes) n.forces.clear();
  const Line line(d);
  Places x(3, 5), zero = Places::Zero(3, 5);
  const auto loads = [&](double depth, double speed, double acceleration) {
    for (int i = 0; i < 5; ++i) x.col(i) = Vector3d(i, 0, -depth);
    const Places v = Vector3d(0, speed, 0).replicate(1, 5), a = Vector3d(0, acceleration, 0).replicate(1, 5);
    return Vector3d(force(line, x, v, a).rowwise().sum());
  };
  const Vector3d lifted = loads(0.3, 0, 0), dragged = loads(0.3, 1, 0) - lifted, moved = loads(0.3, 0, 1) - lifted;
  for (const double depth : {-0.09, -0.02, 0.05, 0.0999}) {
    const double share = loads(depth, 0, 0).z() / lifted.z();
    EXPECT_NEAR((loads(depth, 1, 0) - loads(depth, 0, 0)).y(), share * dragged.y(), 1e-12 * std::abs(dragged.y()));
    EXPECT_NEAR((loads(depth, 0, 1) - loads(depth, 0, 0)).y(), share * moved.y(), 1e-12 * std::abs(moved.y()));
  }
  constexpr double small = 1e-6;  // m; of a slope of lift / 0.16 m in the middle, √(small/R) of it is left at the ends
  for (const double edge : {-0.1, 0.1})
    EXPECT_LT(std::abs(loads(edge + small, 0, 0).z() - loads(edge - small, 0, 0).z()) / small,
              0.01 * lifted.z() / 0.16);
}

// Where links go through the surface, steeply or nearly level.
TEST(LineLoads, HaveTheDerivativesOfWhatTheSurfaceCuts) {
  Description d = wet_line(Wet::below_surface, 0.4);
  const Line line(d);
  const Places zero = Places::Zero(3, 5);
  Places x(3, 5);
  for (int i = 0; i < 5; ++i) x.col(i) = Vector3d(0.9 * i, 0.1 * i, i < 2 ? 0.4 * i - 0.6 : 0.03 * i - 0.1);
  Loads loads(line);
  Places out = Places::Zero(3, 5);
  Blocks by;
  by.set_zero(5, 4);
  loads.add({0, x, zero, zero}, {1, 0, 0}, out, &by);
  constexpr double small = 1e-6;
  for (int i = 1; i < 4; ++i) {
    Places up = x, down = x;
    up(2, i) += small;
    down(2, i) -= small;
    const Places slope = (force(line, up, zero, zero) - force(line, down, zero, zero)) / (2 * small);
    const auto at = static_cast<std::size_t>(i);
    // N/m, of 2000: where the Gauss points go is left out of drag and lift, neither of which is straight along a link
    EXPECT_LT((slope.col(i) - by.diagonal[at].col(2)).norm(), 4) << i;
    EXPECT_LT((slope.col(i + 1) - by.lower[at].col(2)).norm(), 4) << i;
    EXPECT_LT((slope.col(i - 1) - by.upper[at - 1].col(2)).norm(), 4) << i;
    EXPECT_LT(by.diagonal[at](2, 2), -20) << i;  // N/m: there is something to tell
  }
}

TEST(LineLoads, PowersAreForcesTimesVelocities) {
  for (const Wet wet : {Wet::all, Wet::below_surface}) {
    Description d = wet_line(wet, 0.4);
    const Line line(d);
    const Sample s(5);
    Loads loads(line);
    const LoadPowers p = loads.powers({0, s.x, s.v, s.a});
    const double constant = line.constant_load().cwiseProduct(s.v).sum();
    EXPECT_NEAR(force(line, s.x, s.v, s.a).cwiseProduct(s.v).sum() - constant,
                p.drag_supplied - p.drag_dissipated + p.inertia_supplied + p.buoyancy_supplied - p.damping, 1e-9);
    EXPECT_GT(p.drag_dissipated, 0);
    EXPECT_GT(p.damping, 0);
  }
}

// (D79): what the mean force takes over a step is what the spring stores.
TEST(LineSprings, MeanForceTimesWayIsTheEnergyStored) {
  const auto stored = [](double e) { return e > 0 ? 50 * e * e : 0.0; };
  for (const double from : {-0.3, -1e-9, 0.0, 0.2, 1.0})
    for (const double to : {-0.4, 0.0, 1e-9, 0.2, 0.7}) {
      const double mean = one_sided_spring(100, from, to).force;
      EXPECT_NEAR(mean * (to - from), stored(to) - stored(from), 1e-14) << from << ' ' << to;
      EXPECT_GE(mean, 0);
    }
}

TEST(LineSprings, NeverPushWhateverTheDamper) {
  for (const double d : {-1e6, -10.0, 0.0, 10.0, 1e6}) {
    EXPECT_GE(with_damper(one_sided_spring(100, 0.1, 0.1), d).force, 0);
    EXPECT_EQ(with_damper(one_sided_spring(100, -0.1, -0.2), d).force, 0);
  }
}

TEST(LineSprings, DerivativesAreThoseOfTheForce) {
  for (const double from : {-0.3, 0.2})
    for (const double to : {-0.4, 0.1, 0.7})
      for (const double d : {-30.0, 4.0}) {
        constexpr double e = 1e-7;
        const auto at = [&](double x, double y) { return with_damper(one_sided_spring(100, from, x), y); };
        EXPECT_NEAR(at(to, d).by_stretch, (at(to + e, d).force - at(to - e, d).force) / (2 * e), 1e-4);
        EXPECT_NEAR(at(to, d).by_damper, (at(to, d + e).force - at(to, d - e).force) / (2 * e), 1e-6);
      }
}

}  // namespace
}  // namespace loads_test
