#include "dynamics/line/stepper.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/node_damping.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "support/line_models.hpp"
#include "support/plain_pendulums.hpp"

namespace stepper_test {
namespace {

using namespace support;
using Eigen::Vector3d;
using testing::HasSubstr;
using testing::ThrowsMessage;
constexpr double g = 9.81, pi = std::numbers::pi;

int steps(double duration, double h) { return static_cast<int>(std::lround(duration / h)); }

/// Runs and returns what all steps took.
StepReport run(Stepper& stepper, State& s, double duration, double h) {
  StepReport all;
  for (int i = 0; i < steps(duration, h); ++i) {
    const StepReport r = stepper.step(s, h);
    all.newton_iterations += r.newton_iterations;
    all.halvings += r.halvings;
  }
  return all;
}

TEST(EnergyMomentum, KeepsTheEnergyOfTheDropperOverAThousandSeconds) {
  const Line line(dropper());
  State s = in_plane(line, dropper_angles);
  Stepper stepper(line, {});
  stepper.start(s);
  double liveliest = 0, worst = 0;
  for (int i = 0; i < 100000; ++i) {
    stepper.step(s, 0.01);
    liveliest = std::max(liveliest, stepper.energies().kinetic);
    worst = std::max(worst, std::abs(stepper.energies().residual()));
  }
  EXPECT_LT(worst, 1e-10 * liveliest);  // asked; what is left is rounding of 1e5 steps
  EXPECT_LT(worst_length(line, s), 1e-14);
}

TEST(EnergyMomentum, KeepsAngularMomentumAboutTheVertical) {
  const Line line(pendulums(3, 0.7, 0.4));
  State s = in_plane(line, {0.3, -0.4, 1.2});
  s.velocity.row(1) << 0, 1, -0.5, 2;
  const auto momentum = [&] {
    double sum = 0;
    for (int i = 1; i <= 3; ++i) sum += 0.4 * s.position.col(i).cross(s.velocity.col(i)).z();
    return sum;
  };
  Stepper stepper(line, {});
  stepper.start(s);
  const double before = momentum();
  run(stepper, s, 50, 0.02);
  EXPECT_NEAR(momentum(), before, 1e-11);
}

TEST(EnergyMomentum, MovesAConeOnACircle) {
  const Line line(pendulums(1));
  const double theta = pi / 8, rate = std::sqrt(g / std::cos(theta));
  State s = in_plane(line, {pi / 2 - theta});
  s.velocity(1, 1) = rate * std::sin(theta);
  Stepper stepper(line, {});
  stepper.start(s);
  EXPECT_NEAR(s.tension[0], g / std::cos(theta), 1e-11);
  for (int i = 0; i < 1000; ++i) {
    stepper.step(s, 0.01);
    ASSERT_NEAR(std::hypot(s.position(0, 1), s.position(1, 1)), std::sin(theta), 1e-12);
    ASSERT_NEAR(s.tension[0], g / std::cos(theta), 1e-9);
  }
  // The midpoint rule turns by 2 atan(ωh/2) a step: (ωh)²/12 slow.
  const double turned = 1000 * 2 * std::atan(rate * 0.01 / 2);
  EXPECT_NEAR(std::remainder(std::atan2(s.position(1, 1), s.position(0, 1)) - turned, 2 * pi), 0, 1e-9);
}

/// Largest difference of the bobs' places from the plain reference after 1.5 s of a swing that does not turn over.
double error_of(const Stepper::Settings& settings, double h) {
  const Line line(pendulums(3, 0.6, 0.5));
  const std::vector<double> angles{1.2, 1.0, 0.7};
  State s = in_plane(line, angles);
  Stepper stepper(line, settings);
  stepper.start(s);
  run(stepper, s, 1.5, h);
  const PlainPendulums plain{.length = Eigen::Vector3d::Constant(0.6), .mass = Eigen::Vector3d::Constant(0.5)};
  Eigen::VectorXd q(3), v = Eigen::VectorXd::Zero(3);
  for (int i = 0; i < 3; ++i) q[i] = pi / 2 - angles[static_cast<std::size_t>(i)];
  for (int i = 0; i < 1500; ++i) plain.step(q, v, 1e-3);
  double x = 0, z = 0, worst = 0;
  for (int i = 0; i < 3; ++i) {
    x += 0.6 * std::sin(q[i]);
    z -= 0.6 * std::cos(q[i]);
    worst = std::max(worst, std::hypot(s.position(0, i + 1) - x, s.position(2, i + 1) - z));
  }
  return worst;
}

TEST(LineSchemes, HaveTheirOrderAgainstAnglesAndRungeKutta) {
  struct Expected {
    Stepper::Settings settings;
    double ratio;
  };
  const std::vector<Expected> all{{{.scheme = Scheme::energy_momentum}, 4},
                                  {{.scheme = Scheme::generalised_alpha, .rho_infinity = 0.8}, 4},
                                  {{.scheme = Scheme::generalised_alpha, .rho_infinity = 0}, 4},
                                  {{.scheme = Scheme::gamma, .gamma = 0.5}, 4},
                                  {{.scheme = Scheme::gamma, .gamma = 1}, 2},
                                  {{.scheme = Scheme::semi_implicit_euler}, 2},
                                  {{.scheme = Scheme::explicit_euler}, 2}};
  for (const Expected& e : all) {
    const double h = e.ratio == 4 ? 2e-3 : 5e-4;
    const double coarse = error_of(e.settings, h), fine = error_of(e.settings, h / 2);
    EXPECT_NEAR(coarse / fine, e.ratio, 0.15 * e.ratio) << name_of(e.settings.scheme) << ' ' << e.settings.gamma;
    EXPECT_LT(fine, e.ratio == 4 ? 1e-4 : 1e-2) << name_of(e.settings.scheme);
  }
}

// A uniform rod about its end: T = 2π √(2L/3g); the midpoint rule is (ωh)²/12 slow.
TEST(RigidLink, SwingsAsACompoundPendulum) {
  Description d;
  d.nodes.assign(2, Node{});
  d.segments = {Segment::rod(1.5, 2)};
  d.held = {{.node = 0}};
  const Line line(d);
  constexpr double small = 1e-4, h = 1e-3;
  State s = in_plane(line, {pi / 2 - small});
  Stepper stepper(line, {});
  stepper.start(s);
  const double omega = std::sqrt(1.5 * g / 1.5);
  run(stepper, s, 10, h);
  EXPECT_NEAR(s.position(0, 1) / (1.5 * small), std::cos(omega * 10),
              omega * 10 * omega * omega * h * h / 12 * 1.1 + 1e-7);
}

// A heavy centre off the middle: I_pivot = I + m c²L², ω² = m g cL/I_pivot.
TEST(RigidLink, MayHaveItsCentreAnywhere) {
  Description d;
  d.nodes.assign(2, Node{});
  d.segments = {{.length = 0.8, .mass = 3, .centre = 0.7, .inertia = 0.05}};
  d.held = {{.node = 0}};
  const Line line(d);
  constexpr double small = 1e-4, h = 1e-3, arm = 0.56;
  State s = in_plane(line, {pi / 2 - small});
  Stepper stepper(line, {});
  stepper.start(s);
  const double omega = std::sqrt(3 * g * arm / (0.05 + 3 * arm * arm));
  run(stepper, s, 10, h);
  EXPECT_NEAR(s.position(0, 1) / (0.8 * small), std::cos(omega * 10),
              omega * 10 * omega * omega * h * h / 12 * 1.1 + 1e-7);
}

TEST(ElasticSegment, BouncesAsASpring) {
  for (const bool tension_only : {false, true}) {
    Description d = pendulums(1, 2, 3);
    d.segments[0].axial_stiffness = 500;
    d.segments[0].tension_only = tension_only;
    const Line line(d);
    State s = in_plane(line, {pi / 2});  // unstretched: it falls by 2 m g/k
    Stepper stepper(line, {});
    stepper.start(s);
    run(stepper, s, 3, 1e-3);
    const double k = 500 / 2.0, omega = std::sqrt(k / 3), sag = 3 * g / k;
    const double late = 3 * omega * omega * omega * 1e-6 / 12;  // phase of the midpoint rule
    EXPECT_NEAR(s.position(2, 1), -2 - sag * (1 - std::cos(omega * 3)), sag * late);
    EXPECT_NEAR(stepper.energies().residual(), 0, 1e-11);
  }
}

TEST(ElasticSegment, WithADamperLosesWhatTheLedgerSays) {
  Description d = pendulums(2, 1, 3);
  for (Segment& s : d.segments) {
    s.axial_stiffness = 2000;
    s.axial_damping = 40;
    s.tension_only = true;
  }
  const Line line(d);
  for (const Scheme scheme : {Scheme::energy_momentum, Scheme::generalised_alpha}) {
    State s = in_plane(line, {-0.9, -0.5});  // thrown up: it goes slack and snaps taut
    Stepper stepper(line, {.scheme = scheme});
    stepper.start(s);
    run(stepper, s, 5, 1e-3);
    const Energies& e = stepper.energies();
    EXPECT_GT(e.lost_axial, 0.1 * 3 * g);
    // Energy–momentum to rounding; generalised-α to the order of its step, 2e-3 of what moves.
    EXPECT_NEAR(e.residual(), 0, (scheme == Scheme::energy_momentum ? 1e-10 : 2e-2) * 3 * g);
  }
}

TEST(InextensibleSegments, KeepTheirLengthsUnderEveryScheme) {
  for (const Scheme scheme :
       {Scheme::energy_momentum, Scheme::generalised_alpha, Scheme::gamma, Scheme::semi_implicit_euler}) {
    const Line line(dropper());
    State s = in_plane(line, dropper_angles);
    Stepper stepper(line, {.scheme = scheme});
    stepper.start(s);
    run(stepper, s, 3, 0.005);
    EXPECT_LT(worst_length(line, s), 1e-12) << name_of(scheme);
  }
}

/// Shakes along x from rest.
class Shaking final : public Path {
 public:
  Place at(double t) const override {
    return {{amplitude * std::sin(omega * t), 0, 0},
            {amplitude * omega * std::cos(omega * t), 0, 0},
            {-amplitude * omega * omega * std::sin(omega * t), 0, 0}};
  }
  double amplitude = 1e-4, omega = 2;
};

// Pendulum whose pivot has a prescribed motion, small: x = A sin ωt/(1 − (ω/ω₀)²) once it starts with that velocity.
TEST(HeldNodes, MoveAPendulumAlong) {
  Description d = pendulums(1, 1, 2);
  const auto shaking = std::make_shared<Shaking>();
  d.held = {{.node = 0, .path = shaking}};
  const Line line(d);
  for (const Scheme scheme : {Scheme::energy_momentum, Scheme::generalised_alpha}) {
    State s = in_plane(line, {pi / 2});
    const double gain = 1 / (1 - 4 / g);
    s.velocity(0, 1) = shaking->amplitude * 2 * gain;
    Stepper stepper(line, {.scheme = scheme});
    stepper.start(s);
    run(stepper, s, 10, 1e-3);
    EXPECT_NEAR(s.position(0, 1) / shaking->amplitude, gain * std::sin(2 * 10.0), 1e-4);
    EXPECT_NEAR(stepper.energies().residual(), 0, 1e-11);
    EXPECT_NE(stepper.energies().held, 0);
  }
}

/// A line in waves on a bed with all that acts, one end with prescribed motion.
struct Everything {
  Description d;
  State start;

  explicit Everything(Wet wet) {
    namespace hw = hydro::waves;
    const hydro::Water water{.density = 1025, .gravity = g, .depth = hydro::WaterDepth::from_metres(20)};
    const auto sea = hw::Sea::regular(hydro::WaveAmplitude::from_metres(1.5), hydro::AngularFrequency::from_period_s(7),
                                      hydro::Angle::from_degrees(40), water);
    constexpr int n = 20;
    d.nodes.assign(n + 1,
                   Node{.mass = 1, .forces = {std::make_shared<NodeDamping>(NodeDamping::Coefficients{0.5, 0.2})}});
    Segment s = Segment::rod(2, 40);
    s.axial_stiffness = 1e6;
    s.axial_damping = 1e4;
    s.tension_only = true;
    s.diameter = 0.1;
    s.cd = 1.2;
    s.cd_tangential = 0.05;
    s.ca = 1;
    d.segments.assign(n, s);
    auto path = std::make_shared<Shaking>();
    path->amplitude = 0.5;
    d.held = {{.node = 0, .path = path}, {.node = n}};
    d.bed = {{.z = -20, .stiffness = 1e5, .damping = 1e4}};
    d.water = {
        .field = std::make_shared<hw::HarmonicField>(hw::linear_field(sea, {.stretching = hw::Stretching::vertical})),
        .wet = wet,
        .buoyancy = true};
    start = ends_at(Line(d), {25, 0, -20});
    start = hanging_shape(Line(d), start);
  }
};

TEST(LineLedger, ClosesWithEverythingThatActsByEnergyMomentum) {
  for (const Wet wet : {Wet::all, Wet::below_surface}) {
    const Everything all(wet);
    const Line line(all.d);
    State s = all.start;
    Stepper stepper(line, {});
    stepper.start(s);
    const StepReport report = run(stepper, s, 10, 0.02);
    const Energies& e = stepper.energies();
    EXPECT_LT(std::abs(e.residual()), 1e-9 * e.dissipated()) << static_cast<int>(wet);
    for (const double lost : {e.lost_drag, e.lost_axial, e.lost_bed, e.lost_damping}) EXPECT_GT(lost, 0);
    // Newton with all derivatives but the flow's own change from place to place; snaps cost more.
    EXPECT_LT(report.newton_iterations, 8 * 500);
  }
}

TEST(LineLedger, ResidualOfGeneralisedAlphaFallsWithTheStep) {
  double residual[2];
  for (int k = 0; k < 2; ++k) {
    const Line line(pendulums(2, 1, 1));
    State s = in_plane(line, {1.0, 1.1});
    Stepper stepper(line, {.scheme = Scheme::generalised_alpha, .rho_infinity = 0.9});
    stepper.start(s);
    run(stepper, s, 4, 0.01 / (1 << k));
    residual[k] = std::abs(stepper.energies().residual());
  }
  EXPECT_GT(residual[0] / residual[1], 6);  // its damping is of third order
}

TEST(Newton, TakesAsManyIterationsForLongLinesAsForShortOnes) {
  int iterations[2];
  for (int k = 0; k < 2; ++k) {
    const int n = k == 0 ? 10 : 1000;
    const Line line(loop(n));
    State s = hanging_shape(line, ends_at(line, {2.5, 0, 0}));
    for (int i = 1; i < n; ++i) s.velocity(1, i) = 0.5 * std::sin(pi * i / n);
    Stepper stepper(line, {});
    stepper.start(s);
    iterations[k] = run(stepper, s, 1, 0.02).newton_iterations;
  }
  EXPECT_LE(iterations[1], 2 * iterations[0]);
}

// What a looser tolerance leaves of a step is less than it says, also where the last correction is foreseen to suffice.
TEST(Newton, LeavesLessOfAStepThanItsTolerance) {
  Description d = pendulums(6, 1, 1);
  for (Segment& s : d.segments) s.axial_stiffness = 1e4;
  const Line line(d);
  for (const double tolerance : {1e-4, 1e-6, 1e-9}) {
    State s = in_plane(line, {0.2, 0.5, 0.3, 0.8, 1.0, 0.4}), exact = s;
    const State before = s;
    Stepper stepper(line, {.scheme = Scheme::generalised_alpha, .rho_infinity = 0.5, .tolerance = tolerance});
    Stepper reference(line, {.scheme = Scheme::generalised_alpha, .rho_infinity = 0.5, .tolerance = 1e-14});
    stepper.start(s);
    reference.start(exact);
    stepper.step(s, 0.05);
    reference.step(exact, 0.05);
    const double moved = (exact.position - before.position).cwiseAbs().maxCoeff();
    EXPECT_LE((s.position - exact.position).cwiseAbs().maxCoeff(), tolerance * moved) << tolerance;
    EXPECT_LE((s.tension - exact.tension).cwiseAbs().maxCoeff(), tolerance * exact.tension.cwiseAbs().maxCoeff());
  }
}

TEST(Stepper, SaysWhenAndWhereItCannotGoOn) {
  const Line line(pendulums(1));
  State s = in_plane(line, {0.2});
  s.velocity(1, 1) = 3;
  Stepper stepper(line, {.scheme = Scheme::explicit_euler});
  stepper.start(s);
  EXPECT_THAT([&] { run(stepper, s, 200, 0.05); },
              ThrowsMessage<hydro::NumericsError>(AllOf(HasSubstr("cannot go on from t ="), HasSubstr("lengths"))));
  EXPECT_TRUE(s.position.allFinite());
}

}  // namespace
}  // namespace stepper_test
