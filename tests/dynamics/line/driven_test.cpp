// Lines with ends on bodies: one system, one step. (D90)-(D92)
#include "dynamics/line/driven.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/force/constant_load.hpp"
#include "dynamics/force/fastened_line.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/frequency/modes.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "dynamics/integrate/ledger.hpp"
#include "dynamics/integrate/start_with_lines.hpp"
#include "dynamics/line/catenary.hpp"
#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/node_damping.hpp"
#include "dynamics/model/equilibrium.hpp"
#include "hydro/waves/kinematics/field.hpp"
#include "laws/force_kind_laws.hpp"
#include "support/line_networks.hpp"

namespace driven_test {
namespace {

using namespace support;
using dynamics::FastenedLine;
using dynamics::FastenedLineKind;
using dynamics::GeneralizedAlpha;
using dynamics::RigidBody;
using dynamics::Workspace;
using Eigen::Vector3d;

constexpr double gravity = 9.81;

std::shared_ptr<const NodeForce> quadratic_damping() {
  return std::make_shared<NodeDamping>(NodeDamping::Coefficients{.quadratic = 0.5});
}

/// `n` springs in a row of 5 m and 10 kg, held at both ends.
Description springs(int n, double axial_stiffness) {
  Description d;
  d.nodes.assign(static_cast<std::size_t>(n) + 1, Node{.forces = {quadratic_damping()}});
  Segment s = Segment::rod(5.0 / n, 10.0 / n);
  s.axial_stiffness = axial_stiffness;
  s.axial_damping = 1e-3 * axial_stiffness;
  d.segments.assign(static_cast<std::size_t>(n), s);
  d.held = {{.node = 0}, {.node = n}};
  d.gravity = gravity;
  return d;
}

/// From the origin to the centre of a body.
FastenedLine hung(const Description& d, const Vector3d& at = Vector3d::Zero()) {
  const int n = static_cast<int>(d.segments.size());
  return {.name = "l", .run = d, .still = d, .places = Places::Zero(3, n + 1), .ends = {{n, {0, at}}}};
}

RigidBody bob(double mass, const Vector3d& place, bool turns = false) {
  return RigidBody({.name = "bob",
                    .mass = mass,
                    .inertia = mass * Vector3d(0.1, 0.12, 0.15).asDiagonal(),
                    .rest_position = {place},
                    .free = {true, true, true, turns, turns, turns}});
}

std::vector<std::unique_ptr<const dynamics::ForceKind>> weight_and_line(const std::vector<RigidBody>& bodies,
                                                                        std::vector<FastenedLine> lines) {
  std::vector<std::unique_ptr<const dynamics::ForceKind>> out;
  std::vector<int> all;
  for (std::size_t i = 0; i < bodies.size(); ++i) all.push_back(static_cast<int>(i));
  out.push_back(std::make_unique<dynamics::GravityKind>(bodies, gravity, all));
  out.push_back(std::make_unique<FastenedLineKind>(std::move(lines)));
  return out;
}

// A body without rotation is a bob of the line: stepped apart, both must be the same to what Newton leaves, whether the
// body weighs nothing beside the line or the line nothing beside the body, and however stiff the line is.
TEST(FastenedLine, MovesItsBodyAsABobOfItsOwn) {
  for (const double mass : {0.05, 5.0, 5e4})
    for (const double stiffness : {1e4, 1e9}) {
      // The heavy body on the stiff line begins just taut: after a snap both halve their steps, each by itself.
      const Vector3d place = mass * stiffness > 1e13 ? Vector3d(4, 1, -2.83) : Vector3d(3, 1, -2.5);
      Description whole = springs(4, stiffness);
      const Line held(whole);
      whole.held.pop_back();
      whole.nodes.back() = Node{.mass = mass, .forces = {quadratic_damping()}};
      const Line line(whole);
      dynamics::line::State bobs = equilibrium(held, hanging_shape(held, ends_at(held, place)));
      Stepper stepper(line, {.scheme = Scheme::generalised_alpha});
      stepper.start(bobs);

      const std::vector<RigidBody> bodies{bob(mass, place)};
      const dynamics::Model model(bodies, {}, weight_and_line(bodies, {hung(springs(4, stiffness))}));
      Workspace w(model, dynamics::rest_state(bodies));
      GeneralizedAlpha integrator(model, {});
      dynamics::start_with_lines(integrator, w);
      double farthest = 0, off = 0;
      for (int i = 0; i < 150; ++i) {
        stepper.step(bobs, 0.02);
        integrator.step(w, 0.02);
        off = std::max(off, (w.state.pose[0].centre - bobs.position.col(4)).norm());
        farthest = std::max(farthest, (w.state.pose[0].centre - place).norm());
      }
      EXPECT_GT(farthest, 2) << mass;
      EXPECT_LT(off, 1e-6) << "mass " << mass << ", stiffness " << stiffness;
    }
}

/// A body thrown up from where it hangs on a line that goes slack; what holds it again is the line alone.
struct Thrown {
  double mass, speed = 5, stiffness = 1e4;  // N/m of the whole line
  int segments = 1;
  double line_mass = 1e-3;  // of the body's

  dynamics::Model model() const {
    Description d;
    d.nodes.assign(static_cast<std::size_t>(segments) + 1, Node{});
    Segment s = Segment::rod(10.0 / segments, line_mass * mass / segments);
    s.axial_stiffness = stiffness * 10;
    s.tension_only = true;
    d.segments.assign(static_cast<std::size_t>(segments), s);
    d.held = {{.node = 0}, {.node = segments}};
    d.gravity = gravity;
    FastenedLine line = hung(d);
    line.rho_infinity = 0;
    RigidBody body({.name = "bob",
                    .mass = mass,
                    .inertia = Eigen::Matrix3d::Identity(),
                    .rest_position = {Vector3d(0, 0, -10)},
                    .free = {false, false, true, false, false, false}});
    return dynamics::Model({body}, {}, weight_and_line({body}, {std::move(line)}));
  }
};

// (D132) However coarse the step is against the snap, and however light the line, nothing comes back with more energy
// than it went with: that of the start is never exceeded.
TEST(FastenedLine, ThatGoesSlackGainsNoEnergyInASnap) {
  for (const double mass : {0.5, 10.0, 1000.0})
    for (const int segments : {1, 6})
      for (const double h : {0.05, 0.01, 0.002}) {
        const dynamics::Model model = Thrown{.mass = mass, .segments = segments}.model();
        dynamics::State start = dynamics::rest_state(model.bodies());
        start.velocity[2] = 5;
        Workspace w(model, start);
        GeneralizedAlpha integrator(model, {.rho_infinity = 0});
        dynamics::start_with_lines(integrator, w);
        const auto energy = [&] {
          return model.kinetic_energy(w.state) + mass * gravity * (w.state.pose[0].centre.z() + 10) +
                 model.forces()[1]->energy(w.instant(w.state, 1)).stored;
        };
        const double at_start = energy();
        double most = at_start, highest = 0;
        for (int i = 0; i < std::lround(6 / h); ++i) {
          integrator.step(w, h);
          most = std::max(most, energy());
          highest = std::max(highest, w.state.pose[0].centre.z() + 10);
        }
        const double thrown = mass * 12.5;
        EXPECT_LE(most - at_start, 2e-2 * thrown) << mass << " kg, " << segments << " segments, steps of " << h
                                                  << " s: a line of a thousandth of the mass, which falls in folds";
        EXPECT_NEAR(highest, 12.5 / gravity, 0.05);
      }
}

// A bob of mass m that comes down at v on a spring k: mg + √((mg)² + k m v²), to the (ωh)² that ρ∞ = 0 takes.
TEST(FastenedLine, ThatGoesSlackSnapsAsASpringDoes) {
  for (const double mass : {0.5, 10.0, 1000.0}) {
    const Thrown thrown{.mass = mass, .line_mass = 1e-6};
    const dynamics::Model model = thrown.model();
    dynamics::State start = dynamics::rest_state(model.bodies());
    start.velocity[2] = 5;
    const double omega = std::sqrt(thrown.stiffness / mass), weight = mass * gravity;
    // Where it begins, the line is taut by nothing: it comes back to there at the speed that it had.
    const double peak = weight + std::sqrt(weight * weight + thrown.stiffness * mass * 25);
    for (const double fine : {0.1, 0.05}) {
      Workspace w(model, start);
      GeneralizedAlpha integrator(model, {.rho_infinity = 0});
      dynamics::start_with_lines(integrator, w);
      double most = 0;
      const double h = fine / omega;
      for (int i = 0; i < std::lround((1.2 + 4 / omega) / h); ++i) {
        integrator.step(w, h);
        most = std::max(most, -thrown.stiffness * (w.state.pose[0].centre.z() + 10));
      }
      EXPECT_NEAR(most, peak, 1.2 * fine * fine * peak) << mass << " kg, ωh = " << fine;
    }
  }
}

/// Two bodies that turn, joined by a line with drag and added mass in a current, and one of them to the ground.
FastenedLineKind between_bodies() {
  Description d = springs(5, 2e4);
  for (Segment& s : d.segments) {
    s.diameter = 0.1;
    s.cd = 1.2;
    s.cd_tangential = 0.05;
    s.ca = 1;
  }
  d.water = {std::make_shared<hydro::waves::HarmonicField>(std::vector<hydro::waves::Harmonic>{}, hydro::Water{},
                                                           hydro::waves::HarmonicField::Options{}),
             Wet::all, true};
  Description stiff = d;
  for (Segment& s : stiff.segments) s.bending_stiffness = 40;
  return FastenedLineKind({{.name = "between",
                            .run = stiff,
                            .still = stiff,
                            .places = Places::Zero(3, 6),
                            .ends = {{0, {0, {0.5, 0.1, -0.2}}}, {5, {1, {-0.4, 0.2, 0.1}}}}},
                           hung(d, {0.3, 0.2, -0.1})});
}

/// Bodies of force_law_models.hpp where the lines are wet, a tenth of a second after they moved off.
dynamics::State later(std::uint64_t seed) {
  auto state = random_state(two_bodies(), seed, 0.2);
  for (auto& pose : state.pose) pose.centre.z() -= 3;
  state.time = 0.1;
  return state;
}

TEST(FastenedLine, PullsAlikeHoweverOftenItIsAsked) {
  const auto kind = between_bodies();
  auto start = dynamics::rest_state(two_bodies());
  for (auto& pose : start.pose) pose.centre.z() -= 3;
  const auto memory = kind.make_memory(start);
  laws::expect_pure(kind, later(1), later(2), memory.get());
  EXPECT_GT(laws::load(kind, later(1), memory.get()).norm(), 100);
}

TEST(FastenedLine, HasTheDerivativesOfItsStep) {
  const auto kind = between_bodies();
  auto start = dynamics::rest_state(two_bodies());
  for (auto& pose : start.pose) pose.centre.z() -= 3;
  const auto memory = kind.make_memory(start);
  memory->accept([&] {  // so that it moves already
    auto s = later(3);
    s.time = 0.05;
    return s;
  }());
  for (const std::uint64_t seed : {4, 5}) laws::expect_true_jacobians(kind, later(seed), memory.get());
}

/// A bridle: two legs from one body to a knot that floats, and a line from there to another body.
FastenedLineKind bridle_on_bodies() {
  const auto ends_free = [](int n, double length) {
    Description d = springs(n, 2e4);
    for (Segment& s : d.segments) s.length = length / n;
    d.held.clear();
    return d;
  };
  Description d = ends_free(2, 3);
  const int second = append(d, ends_free(3, 3)), third = append(d, ends_free(2, 5));
  d.held = {{.node = 0}, {.node = second}, {.node = third + 2}};
  d.ties = {{2, second + 3, third}};
  d.nodes[2].bob = {.diameter = 0.3, .cd = 0.6, .ca = 0.5, .wet = Wet::all, .buoyancy = true};
  d.water.field = std::make_shared<hydro::waves::HarmonicField>(std::vector<hydro::waves::Harmonic>{}, hydro::Water{},
                                                                hydro::waves::HarmonicField::Options{});
  return FastenedLineKind(
      {{.name = "bridle",
        .run = d,
        .still = d,
        .places = Places::Zero(3, std::ssize(d.nodes)),
        .ends = {{0, {0, {0.5, 0.4, -0.2}}}, {second, {0, {0.5, -0.4, -0.2}}}, {third + 2, {1, {-0.4, 0.2, 0.1}}}}}});
}

TEST(FastenedLine, OfABridleHasTheDerivativesOfItsStep) {
  const auto kind = bridle_on_bodies();
  auto start = dynamics::rest_state(two_bodies());
  for (auto& pose : start.pose) pose.centre.z() -= 3;
  const auto memory = kind.make_memory(start);
  for (const std::uint64_t seed : {4, 5}) laws::expect_true_jacobians(kind, later(seed), memory.get());
}

// A knot of nothing in the line of a body makes no difference to the body.
TEST(FastenedLine, IsTheSameInTwo) {
  const Vector3d place(3, 1, -2.5);
  std::vector<double> heights;
  for (const bool cut : {false, true}) {
    FastenedLine l = hung(springs(4, 1e4));
    if (cut) {
      l.run = l.still = cut_at(l.run, 2);
      l.places = Places::Zero(3, 6);
      l.ends[0].node = 5;
    }
    const std::vector<RigidBody> bodies{bob(5, place, true)};
    const dynamics::Model model(bodies, {}, weight_and_line(bodies, {l}));
    Workspace w(model, dynamics::rest_state(bodies));
    GeneralizedAlpha integrator(model, {});
    dynamics::start_with_lines(integrator, w);
    for (int i = 0; i < 100; ++i) integrator.step(w, 0.02);
    heights.push_back(w.state.pose[0].centre.z());
  }
  EXPECT_LT(heights[0], -3) << "it swings";
  EXPECT_NEAR(heights[1], heights[0], 1e-7);  // Newton's 1e-9 of a step, over 100 of them
}

// A body within the length of its line, which hangs in a loop there, falls into it: mean tension over EA longer than 5
// m.
TEST(FastenedLine, HangsItsBodyThatBeganWithinItsLength) {
  constexpr double stiffness = 1e5, mass = 50, length = 5 * (1 + (mass + 5) * gravity / stiffness);
  for (const Vector3d& place : {Vector3d(0, 0, -4), Vector3d(1, 0, -3), Vector3d(0, 0, -4.99)}) {
    const std::vector<RigidBody> bodies{bob(mass, place)};
    const dynamics::Model model(bodies, {}, weight_and_line(bodies, {hung(springs(4, stiffness))}));
    const dynamics::State rest = dynamics::equilibrium(model, dynamics::rest_state(bodies));
    // 1e-9 of the weight is left over, on 100 N/m of the pendulum.
    EXPECT_LT((rest.pose[0].centre - Vector3d(0, 0, -length)).norm(), 1e-7) << place.transpose();
  }
}

// A loop whose ends are above one another turns about them without resistance: its stiffness is no rounding over
// rounding, which was 1e13 times T/l and more.
TEST(FastenedLine, HasNoStiffnessOfRoundingWhereALoopTurns) {
  const Line line(springs(10, 1e5));
  const auto rest = equilibrium(line, hanging_shape(line, ends_at(line, Vector3d(0, 0, -4))));
  const Response pulls = pulls_at_rest(line, rest, {line.nodes() - 1});
  EXPECT_LT(pulls.by_place.norm(), 1e9 * rest.tension.maxCoeff() / 0.5);  // the resistance is a 1e9th of it
}

/// A chain of 170 m from 3 m below the surface to an anchor 57 m deeper and 96 m to one side, 17 m longer than what
/// hangs straight down and lies straight.
FastenedLine slack_chain(int side) {
  constexpr int n = 40;
  Description d;
  d.nodes.assign(n + 1, {});
  Segment s = Segment::rod(170.0 / n, 80 * 170.0 / n);
  s.axial_stiffness = 300e6;
  s.diameter = 0.1;
  d.segments.assign(n, s);
  d.held = {{.node = 0}, {.node = n}};
  d.gravity = gravity;
  d.bed = {{.z = -60, .stiffness = 1e6, .damping = 1e5}};
  Places places = Places::Zero(3, n + 1);
  places.col(n) = Vector3d(100 * side, 0, -60);
  return {.name = "chain", .run = d, .still = d, .places = places, .ends = {{0, {0, {4.0 * side, 0, -3}}}}};
}

// Between two slack chains nothing holds a body that 2 kN pull, until one of them lifts off its bed: it is found there,
// and where nothing pulls it stays, which is no rest that topples.
TEST(FastenedLine, HoldsItsBodyFarOffWhereItIsNoLongerSlack) {
  const std::vector<RigidBody> bodies{RigidBody({.name = "buoy",
                                                 .mass = 1e5,
                                                 .inertia = 1e6 * Eigen::Matrix3d::Identity(),
                                                 .free = {true, false, false, false, false, false}})};
  for (const double pull : {0.0, 2000.0}) {
    std::vector<std::unique_ptr<const dynamics::ForceKind>> forces;
    forces.push_back(std::make_unique<FastenedLineKind>(std::vector<FastenedLine>{slack_chain(1), slack_chain(-1)}));
    forces.push_back(std::make_unique<dynamics::ConstantLoadKind>(
        std::vector<dynamics::ConstantLoad>{{{0, Vector3d::Zero()}, Vector3d(pull, 0, 0), Vector3d::Zero()}}));
    const dynamics::Model model(bodies, {}, std::move(forces));
    const dynamics::State rest = dynamics::equilibrium(model, dynamics::rest_state(bodies));
    const double x = rest.pose[0].centre.x();
    const dynamics::LineTension law = dynamics::catenary(
        {.length = 170, .weight = 80 * gravity, .axial_stiffness = 300e6, .on_bed = true}, 96 + x, 57);
    if (pull == 0)
      EXPECT_EQ(x, 0);
    else  // straight segments of 4 m touch the bed somewhere in one: a tenth of one in x at the stiffness there
      EXPECT_NEAR(law.horizontal, pull, 0.4 * law.stiffness(0, 0));
    const dynamics::frequency::SmallMotions about(model, rest);
    EXPECT_TRUE(dynamics::frequency::toppling_motions(about).empty()) << pull;
  }
}

// The static stiffness of a mooring is that of its catenary, by 20 catenary segments.
TEST(FastenedLine, AtRestHasTheStiffnessOfTheCatenary) {
  Description d;
  const int n = 20;
  Segment s = Segment::rod(59.0 / n, 8 * 59.0 / n);
  s.axial_stiffness = 30e6;
  s.catenary = true;
  s.diameter = 0.036;
  d.nodes.assign(n + 1, Node{});
  d.segments.assign(n, s);
  d.held = {{.node = 0}, {.node = n}};
  d.gravity = gravity;
  d.bed = {{.z = -14, .stiffness = 3e6, .damping = 0}};
  FastenedLine l = hung(d);
  l.places.col(0) = Vector3d(56, 0, -14);
  const std::vector<RigidBody> bodies{bob(9088, {0, 0, -1.1})};
  const FastenedLineKind kind({l});
  const auto rest = dynamics::rest_state(bodies);
  const auto exact = dynamics::catenary({59, 8 * gravity, 30e6, true}, 56, 12.9);
  const Eigen::VectorXd load = laws::load(kind, rest, nullptr);
  EXPECT_NEAR(load[0], exact.horizontal, 2e-3 * exact.horizontal);
  EXPECT_NEAR(load[2], -exact.vertical, 2e-3 * exact.vertical);
  const Eigen::MatrixXd K = -laws::jacobian(kind, rest, nullptr, 1, 0);
  EXPECT_NEAR(K(0, 0), exact.stiffness(0, 0), 1e-2 * exact.stiffness(0, 0));
  EXPECT_NEAR(K(2, 2), exact.stiffness(1, 1), 1e-2 * exact.stiffness(1, 1));
  EXPECT_NEAR(K(0, 2), -exact.stiffness(0, 1), 1e-2 * exact.stiffness(0, 1));
}

// Rest first, and rest it stays: what equilibrium() finds for body and line is an equilibrium of the run too.
TEST(FastenedLine, HangsStillWhereEquilibriumPutsIt) {
  const std::vector<RigidBody> bodies{bob(5, {0.5, 0.2, -4.5}, true)};
  const dynamics::Model model(bodies, {}, weight_and_line(bodies, {hung(springs(4, 1e5), {0, 0, 0.2})}));
  Workspace w(model, dynamics::equilibrium(model, dynamics::rest_state(bodies)));
  // 5 m stretch by (half of the own 10 kg and all of the 5 kg) over EA, and the body hangs 0.2 m below its eye.
  const double bottom = -5 * (1 + gravity * (10.0 / 2 + 5) / 1e5) - 0.2;
  EXPECT_NEAR(w.state.pose[0].centre.z(), bottom, 1e-9);
  GeneralizedAlpha integrator(model, {});
  dynamics::start_with_lines(integrator, w);
  for (int i = 0; i < 50; ++i) integrator.step(w, 0.02);
  EXPECT_NEAR(w.state.pose[0].centre.z(), bottom, 1e-8);
  EXPECT_LT(w.state.velocity.norm(), 1e-7);
}

// A mass on a spring with a third of the spring's mass: sqrt(k/(M + m/3)), next term (m/M)²/45.
TEST(FastenedLine, SwingsAtTheFrequencyOfAMassOnAHeavySpring) {
  Description d = springs(8, 2e4);
  for (Node& node : d.nodes) node.forces.clear();
  for (Segment& s : d.segments) s.axial_damping = 0;
  const double M = 100, k = 2e4 / 5, omega = std::sqrt(k / (M + 10.0 / 3)), bottom = -5 - (M + 5) * gravity / k;
  const std::vector<RigidBody> bodies{bob(M, {0, 0, bottom})};
  const dynamics::Model model(bodies, {}, weight_and_line(bodies, {hung(d)}));
  auto state = dynamics::rest_state(bodies);
  state.pose[0].centre.z() += 0.01;
  Workspace w(model, state);
  GeneralizedAlpha integrator(model, {.rho_infinity = 0.98});
  dynamics::start_with_lines(integrator, w);
  const int steps = 2000;
  const double h = 10 * 2 * M_PI / omega / steps;  // ten periods
  for (int i = 0; i < steps; ++i) integrator.step(w, h);
  // After ten periods the phase tells: a share of 1e-4 in the frequency is 63 µm of velocity over ω.
  EXPECT_NEAR(w.state.pose[0].centre.z() - bottom, 0.01, 1e-4);
  EXPECT_NEAR(w.state.velocity[2] / omega, 0, 2e-4);
}

// Energy of body and line add up to the error of the step: a fourth for half the step.
TEST(FastenedLine, ClosesTheLedgerOfTheBodiesToTheOrderOfTheStep) {
  double residual[2], turnover = 0;
  for (int k = 0; k < 2; ++k) {
    const std::vector<RigidBody> bodies{bob(5, {3, 1, -2.5}, true)};
    const dynamics::Model model(bodies, {}, weight_and_line(bodies, {hung(springs(3, 2e3), {0, 0, 0.2})}));
    Workspace w(model, dynamics::rest_state(bodies));
    GeneralizedAlpha integrator(model, {.rho_infinity = 0.99});
    dynamics::start_with_lines(integrator, w);
    dynamics::EnergyLedger ledger(model, w);
    for (int i = 0; i < 400 << k; ++i) {
      integrator.step(w, 5e-3 / (1 << k));
      ledger.note(w);
    }
    residual[k] = std::abs(ledger.residual());
    turnover = ledger.turnover();
  }
  EXPECT_LT(residual[1], 1e-2 * turnover);
  EXPECT_LT(residual[1], 0.4 * residual[0]);
}

}  // namespace
}  // namespace driven_test
