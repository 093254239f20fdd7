// Joints with prescribed motion: the motion is what was asked for, and the load is what it takes.
#include "dynamics/joint/prescribed_motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/force/gravity.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/integrate/explicit_pair.hpp"
#include "dynamics/model/assemble.hpp"
#include "hydro/base/error.hpp"
#include "support/motion.hpp"

namespace prescribed_motion_test {
namespace {

using namespace dynamics;
using support::Motion;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double mass = 3, amplitude = 0.2, omega = 2;

RigidBody body(const Eigen::Vector3d& at) {
  return RigidBody(
      {.name = "a", .mass = mass, .inertia = Eigen::Vector3d(1, 2, 2.5).asDiagonal(), .rest_position = {at}});
}
Joint prescribed(JointKind kind, PrescribedMotion motion) {
  return {.name = "crank",
          .kind = kind,
          .first = 0,
          .second = {},
          .place = {0, 0, 0},
          .axis = Eigen::Vector3d::UnitY(),
          .prescribed = std::move(motion)};
}
Model model_of(const Eigen::Vector3d& at, Joint joint, std::unique_ptr<const ForceKind> other = nullptr) {
  std::vector<std::unique_ptr<const ForceKind>> forces;
  if (other) forces.push_back(std::move(other));
  return Model({body(at)}, {}, std::move(forces), {std::move(joint)});
}
/// Where the prescribed motion has the body at t = 0, with its speed.
State begun(const Model& model) {
  State start = rest_state(model.bodies());
  close_joints(model, {false}, start);
  close_joint_velocities(model, {false}, start);
  return start;
}

TEST(PrescribedMotion, HasRatesThatAreItsDerivatives) {
  std::vector<double> times, values;
  for (int i = 0; i <= 20; ++i) times.push_back(0.3 * i), values.push_back(std::sin(0.4 * i * i));
  for (const PrescribedMotion& motion :
       {prescribed_harmonic(0.7, 1.3, 2.5), prescribed_through(times, values), reversed(prescribed_harmonic(1, 2, 0))})
    for (const double t : {0.1, 1.31, 2.45, 4.7}) {  // knots, where a spline's third derivative jumps, left out
      const double h = 1e-5;                         // central differences: h² and 1e-16/h, 1e-10
      EXPECT_NEAR(motion(t).rate, (motion(t + h).coordinate - motion(t - h).coordinate) / (2 * h), 1e-8) << t;
      EXPECT_NEAR(motion(t).acceleration, (motion(t + h).rate - motion(t - h).rate) / (2 * h), 1e-7) << t;
    }
}

// A hinge 0.8 m from the mass, in a vertical plane: moment about it (I + m l²) θ¨ + m g l sin θ, at any angle.
TEST(PrescribedMotion, OfAHingeTakesTheMomentOfNewtonsLaw) {
  const double l = 0.8, swing = 2.5, inertia = 2 + mass * l * l;
  const auto bodies = std::vector{body({0, 0, -l})};
  const Model model = model_of({0, 0, -l}, prescribed(JointKind::hinge, prescribed_harmonic(swing, omega, 1)),
                               std::make_unique<GravityKind>(bodies, 9.81));
  double errors[2];
  for (const int k : {0, 1}) {
    Motion run(model, begun(model));
    const double h = 0.01 / (k + 1);
    run.go(h, 170 * (k + 1));
    const double t = run.workspace.state.time, angle = -swing * std::sin(omega * t);  // the ground is the second
    EXPECT_NEAR(model.joints().coordinate(0, run.workspace.state), -angle, 1e-10) << "a constraint, closed to rounding";
    const double moment = model.joints().load_on(0, End::first, run.workspace.state, run.workspace.multipliers)[4];
    const double wanted = -inertia * omega * omega * angle + mass * 9.81 * l * std::sin(angle);
    errors[k] = std::abs(moment - wanted) / std::abs(wanted);
  }
  EXPECT_LT(errors[0], 5e-3) << "(5 rad/s · h)²";
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.6) << "second order of the step";
}

TEST(PrescribedMotion, WorksWhatTheBodyGains) {
  const auto bodies = std::vector{body({0, 0, 0})};
  Matrix6 K = Matrix6::Zero();
  K(1, 1) = 40;
  const Model model = model_of({0, 0, 0}, prescribed(JointKind::slider, prescribed_harmonic(amplitude, omega, 3)),
                               std::make_unique<RestoringKind>("mooring", bodies, std::vector<Restoring>{{0, K}}));
  Motion run(model, begun(model));
  run.go(0.005, 800);
  const auto& entry = run.ledger.entries().back();
  EXPECT_EQ(entry.effect, "joint.prescribed");
  const double y = run.workspace.state.pose[0].centre.y(), v = run.workspace.state.velocity[1];
  EXPECT_NEAR(entry.supplied, 0.5 * mass * v * v + 20 * y * y, 1e-4) << "trapezium rule, h² of 1 J";
  EXPECT_LT(std::abs(run.ledger.residual()), 1e-4);
}

TEST(PrescribedMotion, IsFollowedByTheExplicitPairToo) {
  const Model model = model_of({0, 0, 0}, prescribed(JointKind::slider, prescribed_harmonic(amplitude, omega, 0)));
  Workspace w(model, begun(model));
  EXPECT_NEAR(std::abs(w.state.velocity[1]), amplitude * omega, 1e-14) << "a sine without ramp begins with its speed";
  ExplicitPair pair(model, {.tolerance = 1e-8});
  pair.start(w);
  for (int i = 0; i < 50; ++i) pair.step(w, 0.05);
  EXPECT_NEAR(std::abs(w.state.pose[0].centre.y()), std::abs(amplitude * std::sin(omega * 2.5)), 1e-14);
  EXPECT_NEAR(std::abs(w.state.velocity[1]), std::abs(amplitude * omega * std::cos(omega * 2.5)), 1e-13);
}

TEST(PrescribedMotion, IsForSlidersAndHinges) {
  EXPECT_THAT(
      [] {
        model_of({0, 0, 0}, prescribed(JointKind::ball, prescribed_harmonic(1, 1, 0)));
      },
      ThrowsMessage<hydro::InputError>(HasSubstr("neither slider nor hinge")));
  EXPECT_THROW(prescribed_harmonic(1, 0, 0), hydro::InputError);
}

TEST(PrescribedMotion, ThatBeginsElsewhereIsAnErrorUnlessTheBodyIsThere) {
  const Model model = model_of({0, 0, 0}, prescribed(JointKind::slider, prescribed_through({0, 5}, {0.3, 0.4})));
  EXPECT_THAT([&] { Motion(model, rest_state(model.bodies())); },
              ThrowsMessage<hydro::InputError>(HasSubstr("does not fit where the run starts")));
}

}  // namespace
}  // namespace prescribed_motion_test
