#include "dynamics/force/morison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/force/gravity.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "dynamics/integrate/ledger.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/synthesis/tabulated_field.hpp"
#include "laws/force_kind_laws.hpp"
#include "support/counted_waves.hpp"
#include "support/small_seas.hpp"

namespace morison_test {
namespace {

using namespace dynamics;
using hydro::waves::Stretching;
using std::numbers::pi;

const auto bodies = support::two_bodies();

/// Ends are global, at rest.
MorisonMember member(int body, const Eigen::Vector3d& from, const Eigen::Vector3d& to, Immersion immersion,
                     double cd = 0, double ca = 0, double cd_tangential = 0, int pieces = 12) {
  const Eigen::Vector3d c = bodies[static_cast<std::size_t>(body)].rest_centre();
  return {{body, from - c, to - c, 0.4, pieces, immersion}, cd, ca, cd_tangential};
}

TEST(ForceLaws, HoldForMorisonMembersOfEveryImmersion) {
  using enum Immersion;
  const Eigen::Vector3d deep(-1, 0.3, -3), high(1, -0.2, 0.8), low(1, -0.2, -1.4);
  const auto current = hydro::waves::Current::profile({-20, 0}, {{0.1, 0}, {0.5, 0.2}});
  for (const auto& water : {support::still_water(), support::still_water(current),
                            support::steep_wave(Stretching::wheeler), support::steep_wave(Stretching::none, current)}) {
    SCOPED_TRACE(water->elevation(0, 0, 0));
    laws::expect_force_laws(MorisonKind({member(0, deep, low, whole, 1.1, 0.9, 0.02)}, water), bodies);
    laws::expect_force_laws(MorisonKind({member(1, deep, high, still_water, 1.1, 0.9, 0.02)}, water), bodies);
    laws::expect_force_laws(MorisonKind({member(0, deep, high, surface, 1.1, 0.9, 0.02),
                                         member(1, {3, 1, 0.1}, {5, 1, -0.1}, surface, 0.7, 1, 0)},
                                        water),
                            bodies);
  }
}

// What was asked where the step looked first stands while places are tried near it.
TEST(ForceLaws, HoldForMorisonMembersWhoseWaterIsForeseen) {
  const Eigen::Vector3d deep(-1, 0.3, -3), high(1, -0.2, 0.8), low(1, -0.2, -1.4);
  for (const auto& water : {support::still_water(), support::steep_wave(Stretching::wheeler)}) {
    SCOPED_TRACE(water->elevation(0, 0, 0));
    laws::expect_force_laws(MorisonKind({member(0, deep, low, Immersion::whole, 1.1, 0.9, 0.02),
                                         member(1, deep, high, Immersion::surface, 1.1, 0.9, 0.02)},
                                        water, 1e-3),
                            bodies);
  }
}

/// A pile 2 to 6 m below the surface of waves of 4 s and 0.6 m, k = 0.25 rad/m, and its load with what it foresees.
struct Foreseeing {
  static constexpr double tolerance = 1e-3;
  std::shared_ptr<const support::CountedWaves> waves =
      std::make_shared<support::CountedWaves>(support::regular_harmonic(0.6, 4));
  MorisonKind kind{{member(0, {0, 0, -6}, {0, 0, -2}, Immersion::whole, 1, 1)}, waves, tolerance};
  std::unique_ptr<Memory> memory = kind.make_memory(rest_state(bodies));
  State at(double surge) const {
    State s = rest_state(bodies);
    s.time = 0.7;
    s.pose[0].centre.x() += surge;
    return s;
  }
  Eigen::VectorXd load(const State& s) { return laws::load(kind, s, memory.get()); }
};

TEST(ForeseenFlow, IsAskedOnceAnInstantWhileBodiesAreNearTheFirstPlace) {
  Foreseeing pile;
  const Eigen::VectorXd first = pile.load(pile.at(0));
  EXPECT_EQ(first, laws::load(pile.kind, pile.at(0), nullptr));
  pile.waves->asked = 0;
  // ∇u is k u at most: 2 mm change u by 5e-4 of itself, less than the tolerance.
  const State near = pile.at(2e-3);
  EXPECT_EQ(pile.load(near), first);
  EXPECT_EQ(laws::jacobian(pile.kind, near, pile.memory.get(), 1, 0).topLeftCorner(3, 3).norm(), 0);
  pile.kind.energy({near, pile.memory.get()});
  EXPECT_EQ(pile.waves->asked, 0);
  const Eigen::VectorXd exact = laws::load(pile.kind, near, nullptr);
  EXPECT_NE(first, exact);
  // Inertia changes as the water does, drag as its square.
  EXPECT_LT((first - exact).head<3>().norm(), 2 * pile.tolerance * exact.head<3>().norm());
}

TEST(ForeseenFlow, IsAskedAnewWhereBodiesHaveComeTooFarAndAtEachInstant) {
  Foreseeing pile;
  pile.load(pile.at(0));
  const State far = pile.at(0.02);  // 5e-3 of u
  EXPECT_EQ(pile.load(far), laws::load(pile.kind, far, nullptr));
  State later = far;
  later.time += 1e-3;
  EXPECT_EQ(pile.load(later), laws::load(pile.kind, later, nullptr));
}

// A vertical pile held in small waves: ∫ ρA(1 + C_A) u̇ dz = ρA(1 + C_A) a ω²/k · (sinh kh − sinh k(h−d))/sinh kh.
TEST(Morison, InertiaOfAHeldPileIsItsIntegralOverTheDepth) {
  const double a = 1e-4, omega = 2 * pi / 4, d = 6;
  const double k = hydro::waves::wavenumber(omega, support::fresh_water);
  const MorisonKind kind({member(0, {0, 0, -d}, {0, 0, 0}, Immersion::whole, 0, 1.0, 0, 60)},
                         support::steep_wave(Stretching::vertical, hydro::waves::Current::none(), a));
  State s = rest_state(bodies);
  double most = 0;
  for (int i = 0; i < 40; ++i) {
    s.time = 0.1 * i;
    most = std::max(most, laws::load(kind, s, nullptr).head<2>().norm());
  }
  const double h = 20, depth_integral = (std::sinh(k * h) - std::sinh(k * (h - d))) / std::sinh(k * h) / k;
  const double exact = 1000 * pi / 4 * 0.16 * 2 * a * omega * omega * depth_integral;
  // 40 samples of a period miss the largest by at most 1 − cos(π/40) = 3e-3; the pieces by (kΔ)⁴/4320 = 1e-10.
  EXPECT_NEAR(most, exact, 3.1e-3 * exact);
}

TEST(Morison, DragOfATowedPileIsTheTextbookForceAcrossAndAlong) {
  const MorisonKind kind({member(0, {0, 0, -2}, {0, 0, 1}, Immersion::surface, 1.2, 0, 0.03)}, support::still_water());
  State s = rest_state(bodies);
  s.velocity[0] = 3;
  s.velocity[2] = -2;
  const Eigen::VectorXd F = laws::load(kind, s, nullptr);
  EXPECT_NEAR(F[0], -0.5 * 1000 * 1.2 * 0.4 * 2 * 9, 1e-3);  // the section that is half wet is a millionth of D high
  EXPECT_NEAR(F[2], 0.5 * 1000 * 0.03 * pi * 0.4 * 2 * 4, 1e-4);
}

TEST(Morison, AddedMassIsOnTheLeftAcrossTheAxisAndAsFarAsTheMemberIsWet) {
  const auto mass = [&](double z) {
    std::vector<std::unique_ptr<const ForceKind>> forces;
    forces.push_back(std::make_unique<MorisonKind>(
        std::vector{member(0, {0, -1, z}, {0, 1, z}, Immersion::surface, 0, 0.8)}, support::still_water()));
    const Model model(bodies, {}, std::move(forces));
    BlockMatrix M(model.pattern());
    model.add_mass(rest_state(bodies), 1, M);
    return Eigen::MatrixXd(M.dense() - model.dry_mass_at_rest());
  };
  const double whole = 0.8 * 1000 * pi / 4 * 0.16 * 2;
  EXPECT_NEAR(mass(-5)(0, 0), whole, 1e-9 * whole);
  EXPECT_NEAR(mass(-5)(2, 2), whole, 1e-9 * whole);
  EXPECT_NEAR(mass(-5)(1, 1), 0, 1e-9 * whole);  // along the axis there is none
  EXPECT_NEAR(mass(0)(0, 0), whole / 2, 1e-9 * whole);
  EXPECT_NEAR(mass(0.1)(0, 0), whole / 4, 1e-9 * whole);
  EXPECT_EQ(mass(1).norm(), 0);
}

// ρA C_A ∫ |across|² of a rod: across itself m, about an end across itself mL²/3, about its own axis none, however the
// body is turned.
TEST(Morison, AddedMassOfARodIsThatOfTheTextbookWhereverItTurns) {
  const Eigen::Vector3d c = bodies[0].rest_centre();
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<MorisonKind>(
      std::vector{member(0, c, c + Eigen::Vector3d(0, 0, -2), Immersion::whole, 0, 0.8, 0, 1)},
      support::still_water()));
  const Model model(bodies, {}, std::move(forces));
  State s = rest_state(bodies);
  s.pose[0].attitude = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -0.5).normalized());
  const Eigen::Matrix3d R = s.pose[0].attitude.toRotationMatrix();
  const double mass = 0.8 * 1000 * pi / 4 * 0.16 * 2;
  const auto energy = [&](const Eigen::Vector3d& v, const Eigen::Vector3d& omega) {
    s.velocity.setZero();
    s.velocity.head<6>() << R * v, R * omega;
    const Eigen::MatrixXd dry = model.dry_mass(s);
    return model.kinetic_energy(s) - 0.5 * s.velocity.dot(dry * s.velocity);
  };
  EXPECT_NEAR(energy({1, 0, 0}, {0, 0, 0}), 0.5 * mass, 1e-9 * mass);
  EXPECT_NEAR(energy({0, 0, 1}, {0, 0, 0}), 0, 1e-9 * mass);
  EXPECT_NEAR(energy({0, 0, 0}, {0, 1, 0}), 0.5 * mass * 4 / 3, 1e-9 * mass);
  EXPECT_NEAR(energy({0, 0, 0}, {0, 0, 1}), 0, 1e-9 * mass);
  EXPECT_NEAR(energy({1, 0, 0}, {0, 1, 0}), 0.5 * mass * (1 - 2 + 4.0 / 3), 1e-9 * mass);  // (v − 2 m/s s)² along it
}

/// Body "a" in fresh water with one member, alone.
struct Alone {
  Model model;
  Workspace workspace;
  GeneralizedAlpha integrator;

  static std::vector<std::unique_ptr<const ForceKind>> forces(MorisonMember m, const RigidBody& body, double gravity) {
    std::vector<std::unique_ptr<const ForceKind>> out;
    out.push_back(std::make_unique<MorisonKind>(std::vector{std::move(m)}, support::still_water()));
    if (gravity > 0) out.push_back(std::make_unique<GravityKind>(std::vector{body}, gravity));
    return out;
  }
  Alone(const RigidBody& body, MorisonMember m, double gravity, State start)
      : model({body}, {}, forces(std::move(m), body, gravity)),
        workspace(model, std::move(start)),
        integrator(model, {.rho_infinity = 1}) {
    integrator.start(workspace);
  }
};

// Under water, without drag: (m + ρA C_A L) a = m g.
TEST(Morison, ABodyFallsAsMuchSlowerAsTheWaterItCarriesIsHeavy) {
  Alone alone(bodies[0], member(0, {0, -1, -5}, {0, 1, -5}, Immersion::whole, 0, 1), 9.81, rest_state({bodies[0]}));
  const double water = 1000 * pi / 4 * 0.16 * 2;
  EXPECT_NEAR(alone.workspace.acceleration[2], -900 * 9.81 / (900 + water),
              0.1);  // the member is not quite at the centre
  for (int i = 0; i < 100; ++i) alone.integrator.step(alone.workspace, 0.01);
  EXPECT_TRUE(alone.workspace.state.velocity.allFinite());
}

// Turning about a fixed direction across all flow, in still water, inertia loads neither give nor take energy: the body
// spins about y with a member along y and another arm, so that P does not turn with it.
TEST(Morison, InertiaOfAMemberAcrossTheMotionKeepsTheKineticEnergy) {
  State start = rest_state({bodies[0]});
  start.velocity << 1.0, 0, 0.5, 0, 2.0, 0;
  const RigidBody body({.name = "a",
                        .mass = 900,
                        .inertia = Eigen::Vector3d(400, 500, 600).asDiagonal(),
                        .centre_of_gravity = {Eigen::Vector3d(0.1, -0.2, 0.3)},
                        .free = {true, false, true, false, true, false}});
  Alone alone(body, member(0, {0.5, -1, -9}, {0.5, 1, -9}, Immersion::whole, 0, 1), 0, start);
  const double before = alone.model.kinetic_energy(alone.workspace.state);
  EnergyLedger ledger(alone.model, alone.workspace);
  for (int i = 0; i < 400; ++i) {
    alone.integrator.step(alone.workspace, 0.002);
    ledger.note(alone.workspace);
  }
  const double after = alone.model.kinetic_energy(alone.workspace.state);
  EXPECT_NEAR(after, before, 1e-4 * before);  // second order in the step: (2 rad/s · 2 ms)² over 400 steps
  EXPECT_LT(std::abs(ledger.residual()), 1e-4 * before);
}

// The plain sum of the waves is the reference. A table to 1e-6 of each wave, what an accuracy of 1e-2 asks for, leaves
// so much of the motion, a few times over as waves of one sign add up: 1e-5 of it.
TEST(Morison, ABodyMovesByATableOfTheWavesAsByTheirSum) {
  std::vector<hydro::waves::GivenWave> waves;
  for (int j = 0; j < 30; ++j)
    waves.push_back({hydro::AngularFrequency::from_rad_per_s(0.8 + 0.1 * j),
                     hydro::WaveAmplitude::from_metres(0.3 / (1 + j)), 2.4 * j * j, hydro::Angle::from_degrees(20)});
  const auto plain = std::make_shared<hydro::waves::HarmonicField>(
      hydro::waves::linear_field(hydro::waves::Sea::of(waves, support::fresh_water)));
  const auto table = std::make_shared<hydro::waves::TabulatedField>(
      *plain, hydro::waves::FieldBox{0, 21, {-10, -10, -6}, {10, 10, 0.5}},
      hydro::waves::TabulatedField::Options{.tolerance = 1e-6});
  const auto motion = [](std::shared_ptr<const hydro::waves::WaveField> water) {
    std::vector<std::unique_ptr<const ForceKind>> forces;
    forces.push_back(std::make_unique<MorisonKind>(
        std::vector{member(0, {0, 0, -4}, {0, 0, -1}, Immersion::whole, 1, 1)}, std::move(water)));
    const Model model({bodies[0]}, {}, std::move(forces));
    GeneralizedAlpha integrator(model, {});
    Workspace workspace(model, rest_state({bodies[0]}));
    integrator.start(workspace);
    Eigen::VectorXd surge(200);
    for (double& x : surge) {
      integrator.step(workspace, 0.1);
      x = workspace.state.pose[0].centre.x();
    }
    return surge;
  };
  const Eigen::VectorXd exact = motion(plain), tabled = motion(table);
  const double range = exact.maxCoeff() - exact.minCoeff();
  EXPECT_GT(range, 0.05);
  EXPECT_LT((tabled - exact).cwiseAbs().maxCoeff(), 1e-5 * range);
}

TEST(Morison, EnergyAddsUpWhileAMemberFallsIntoTheWater) {
  State start = rest_state({bodies[0]});
  start.velocity << 0, 0, -2, 0, 0.3, 0;
  Alone alone(bodies[0], member(0, {-1, -1, 0.5}, {1, 1, 1.2}, Immersion::surface, 1, 1, 0.02), 9.81, start);
  EnergyLedger ledger(alone.model, alone.workspace);
  for (int i = 0; i < 1000; ++i) {
    alone.integrator.step(alone.workspace, 1e-3);
    ledger.note(alone.workspace);
  }
  EXPECT_LT(alone.workspace.state.pose[0].centre.z(), -1);
  EXPECT_LT(std::abs(ledger.residual()), 1e-4 * ledger.turnover());  // second order in the step, kinks at immersion
}

}  // namespace
}  // namespace morison_test
