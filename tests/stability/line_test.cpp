/// Hard cases of lines: each must finish, keep what it must keep, and say so where it cannot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/stepper.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/kinematics/sea.hpp"
#include "hydro/waves/spectra/spectra.hpp"
#include "hydro/waves/synthesis/summed_field.hpp"
#include "support/line_models.hpp"

namespace line_test {
namespace {

using namespace support;
using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;

double worst_length(const Line& line, const State& s) {
  double worst = 0;
  for (int j = 0; j < line.segments(); ++j)
    if (line.segment(j).is_inextensible())
      worst = std::max(worst, std::abs((s.position.col(j + 1) - s.position.col(j)).norm() - line.segment(j).length));
  return worst;
}

struct Outcome {
  StepReport report;
  double liveliest = 0;  ///< largest kinetic energy, J
};

Outcome run(Stepper& stepper, State& s, double duration, double h) {
  Outcome out;
  for (int i = 0; i < static_cast<int>(std::lround(duration / h)); ++i) {
    const StepReport r = stepper.step(s, h);
    out.report.newton_iterations += r.newton_iterations;
    out.report.halvings += r.halvings;
    out.liveliest = std::max(out.liveliest, stepper.energies().kinetic);
  }
  return out;
}

// Over the top and through the bottom, where polar angles have their poles, in one vertical plane and just beside it.
TEST(HardLines, VerticalPendulumSwingsThroughBothPoles) {
  for (const double aside : {0.0, 1e-9, 1e-3}) {
    const Line line(pendulums(1));
    State s = in_plane(line, {pi / 2});
    s.velocity(0, 1) = 7;  // √(4gL) = 6.26 reaches the top
    s.velocity(1, 1) = aside;
    Stepper stepper(line, {});
    stepper.start(s);
    bool over = false, under = false;
    for (int i = 0; i < 5000; ++i) {
      stepper.step(s, 0.01);
      over = over || s.position(2, 1) > 0.99;
      under = under || (over && s.position(2, 1) < -0.99);
    }
    EXPECT_TRUE(over && under);
    EXPECT_NEAR(stepper.energies().residual(), 0, 1e-10 * 24.5);
    EXPECT_LT(worst_length(line, s), 1e-14);
  }
}

// A thousand links let go level: the end runs down and cracks. Energy is kept through it.
TEST(HardLines, ThousandLinkWhip) {
  const Line line(pendulums(1000, 1e-3, 1e-3));
  State s = in_plane(line, std::vector<double>(1000, 0.0));
  Stepper stepper(line, {});
  stepper.start(s);
  const Outcome out = run(stepper, s, 0.6, 0.005);
  EXPECT_GT(out.liveliest, 1);
  EXPECT_LT(std::abs(stepper.energies().residual()), 1e-9 * out.liveliest);
  EXPECT_LT(worst_length(line, s), 1e-12);
}

TEST(HardLines, FromVerySoftToVeryStiffInOneStep) {
  for (const Scheme scheme : {Scheme::energy_momentum, Scheme::generalised_alpha})
    for (const double stiffness : {1e3, 1e6, 1e9, 1e12}) {
      Description d = loop(18);
      for (Segment& s : d.segments) s.axial_stiffness = stiffness;
      const Line line(d);
      State s = hanging_shape(line, ends_at(line, {2.5, 0, 0}));
      for (int i = 1; i < 18; ++i) s.velocity(1, i) = 2 * std::sin(pi * i / 18);
      Stepper stepper(line, {.scheme = scheme});
      stepper.start(s);
      const Outcome out = run(stepper, s, 10, 0.03);
      EXPECT_TRUE(s.position.allFinite()) << stiffness;
      // Energy–momentum keeps it; rounding of a strain times EA is 1e-16 · 1e12 N · 17 m each step.
      if (scheme == Scheme::energy_momentum)
        EXPECT_LT(std::abs(stepper.energies().residual()), 1e-9 * out.liveliest + 1e-15 * stiffness) << stiffness;
      else
        EXPECT_LT(stepper.energies().total(), stepper.energies().at_start + 1e-2 * out.liveliest) << stiffness;
    }
}

TEST(HardLines, MasslessNodeBetweenBobs) {
  Description d = pendulums(4);
  d.nodes[2].mass = 0;
  const Line line(d);
  State s = in_plane(line, {0.8, 0.8, 0.8, 0.8});
  Stepper stepper(line, {});
  stepper.start(s);
  const Outcome out = run(stepper, s, 20, 0.01);
  EXPECT_LT(std::abs(stepper.energies().residual()), 1e-8 * out.liveliest);
  EXPECT_LT(worst_length(line, s), 1e-12);
}

// A clump on a slack cable falls, the cable snaps taut and throws it back, over and over.
TEST(HardLines, SlackToTautSnap) {
  for (const double damping : {0.0, 2e3}) {
    Description d;
    d.nodes.assign(11, Node{.mass = 0.1});
    d.nodes.back().mass = 50;
    d.segments.assign(10, {.length = 1, .axial_stiffness = 1e6, .axial_damping = damping, .tension_only = true});
    d.held = {{.node = 0}};
    const Line line(d);
    State s{.position = Places::Zero(3, 11), .velocity = Places::Zero(3, 11), .tension = Eigen::VectorXd::Zero(10)};
    for (int i = 1; i <= 10; ++i) s.position.col(i) = Vector3d(0.2 * i, 0.01 * (i % 2), -0.1 * i);
    Stepper stepper(line, {});
    stepper.start(s);
    const Outcome out = run(stepper, s, 20, 0.005);
    const Energies& e = stepper.energies();
    EXPECT_GT(out.liveliest, 1000);
    EXPECT_LT(std::abs(e.residual()), 1e-7 * out.liveliest) << damping;
    EXPECT_GE(e.lost_axial, 0);
    EXPECT_GE(s.tension.minCoeff(), -1e-6);  // Newton's tolerance of snaps of 1e5 N
  }
}

// Once in 25 years in the North Sea on a rope of 5 cm, at the source's step.
TEST(HardLines, StormOnAThinDropper) {
  namespace hw = hydro::waves;
  const hydro::Water water{.density = 1000, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(30)};
  const auto spectrum = hw::jonswap(8.2, hw::PeakPeriod{11.7}, 3.3);
  const auto sea =
      hw::Sea::irregular(spectrum, {.bins = hw::EqualEnergy{100}, .omega_min = 0.3, .omega_max = 3, .seed = 7},
                         {.mean = hydro::Angle::from_degrees(90)}, water);
  Description d = loop(18);
  for (Segment& s : d.segments) {
    s.diameter = 0.05;
    s.cd = 2;
    s.ca = 1;
  }
  d.water = {
      .field = std::make_shared<hw::SummedField>(hw::linear_field(sea, {.stretching = hw::Stretching::vertical})),
      .wet = Wet::all};
  for (const Wet wet : {Wet::all, Wet::below_surface}) {
    d.water.wet = wet;
    const Line line(d);
    State s = hanging_shape(line, ends_at(line, {2.5, 0, 0}));
    Stepper stepper(line, {});
    stepper.start(s);
    run(stepper, s, 60, 0.03);
    EXPECT_LT(std::abs(stepper.energies().residual()), 1e-6 * stepper.energies().lost_drag) << static_cast<int>(wet);
    EXPECT_LT(worst_length(line, s), 1e-11);
  }
}

TEST(HardLines, StepTenTimesTooLargeHalvesItselfOrSaysWhy) {
  for (const Scheme scheme : {Scheme::energy_momentum, Scheme::generalised_alpha, Scheme::gamma}) {
    const Line line(dropper());
    State s = in_plane(line, dropper_angles);
    Stepper stepper(line, {.scheme = scheme});
    stepper.start(s);
    try {
      run(stepper, s, 10, 0.1);
      EXPECT_LT(worst_length(line, s), 1e-11) << name_of(scheme);
    } catch (const hydro::NumericsError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr("cannot go on from t =")) << name_of(scheme);
    }
    EXPECT_TRUE(s.position.allFinite()) << name_of(scheme);
  }
}

TEST(HardLines, StraightTautLineBetweenItsEndsHasNoMechanismAndStillMoves) {
  Description d = loop(10);
  const Line line(d);
  State s = ends_at(line, {17, 0, 0});
  for (int i = 0; i <= 10; ++i) s.position.col(i) = Vector3d(1.7 * i, 0, 0);
  Stepper stepper(line, {});
  try {
    stepper.start(s);
    run(stepper, s, 0.1, 0.01);
  } catch (const hydro::NumericsError&) {
    // Tension without bound: a line without sag carries no load.
  }
  EXPECT_TRUE(s.position.allFinite());
  EXPECT_LT(worst_length(line, s), 1e-9);
}

}  // namespace
}  // namespace line_test
