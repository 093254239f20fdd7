// What each integrator promises: its order, what it keeps, where it gives up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dynamics/force/contact.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/integrate/energy_momentum.hpp"
#include "dynamics/integrate/euler.hpp"
#include "dynamics/integrate/explicit_pair.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "hydro/base/error.hpp"
#include "support/double_pendulum.hpp"

namespace integrators_test {
namespace {

using namespace dynamics;
using support::double_pendulum;
constexpr double infinite = std::numeric_limits<double>::infinity();

State after(Integrator& integrator, const Model& model, State start, double h, double duration) {
  Workspace w(model, std::move(start));
  integrator.start(w);
  for (int i = 0; i < std::lround(duration / h); ++i) integrator.step(w, h);
  return w.state;
}

double distance(const State& a, const State& b) {
  double d = (a.velocity - b.velocity).norm();
  for (std::size_t i = 0; i < a.pose.size(); ++i) d += (a.pose[i].centre - b.pose[i].centre).norm();
  return d;
}

class Orders : public testing::Test {
 protected:
  static constexpr double duration = 1.6;  // both rods have swung through
  Model model = double_pendulum(0.4);
  State reference() const {
    ExplicitPair exact(model, {.tolerance = 1e-13});
    return after(exact, model, rest_state(model.bodies()), 0.01, duration);
  }
  template <class Method, class... Settings>
  double order(double h, const Settings&... settings) const {
    const State exact = reference();
    const auto error = [&](double step) {
      Method method(model, settings...);
      return distance(after(method, model, rest_state(model.bodies()), step, duration), exact);
    };
    return std::log2(error(h) / error(h / 2));
  }
};

// Halving a step that is short against the motion: the order is read to a tenth where the next term is below some
// percent.
TEST_F(Orders, AreThoseOfTheMethods) {
  EXPECT_NEAR(order<GeneralizedAlpha>(4e-3, GeneralizedAlpha::Settings{0.8}), 2, 0.1);
  EXPECT_NEAR(order<EnergyMomentum>(4e-3), 2, 0.1);
  EXPECT_NEAR(order<ImplicitEuler>(1e-3), 1, 0.1);
  EXPECT_NEAR(order<SemiImplicitEuler>(1e-3), 1, 0.1);
  EXPECT_NEAR(order<ExplicitPair>(0.01, ExplicitPair::Settings{infinite}), 5, 0.5);
}

TEST_F(Orders, OfThePairThatChoosesItsStepsGiveTheErrorAskedFor) {
  const State exact = reference();
  double last = infinite;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    ExplicitPair pair(model, {.tolerance = tolerance});
    const double error = distance(after(pair, model, rest_state(model.bodies()), 0.1, duration), exact);
    EXPECT_LT(error, 100 * tolerance) << "some ten steps, velocities of some 10 m/s";
    EXPECT_LT(error, 0.2 * last);
    last = error;
  }
}

TEST_F(Orders, OfStepsCutToATolerance) {
  const State exact = reference();
  const auto error_of = [&](Integrator&& method, double tolerance) {
    method.cut_steps(tolerance);
    return distance(after(method, model, rest_state(model.bodies()), 0.1, duration), exact);
  };
  double last_momentum = infinite;
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    const double momentum = error_of(EnergyMomentum(model), tolerance);
    // Rates are wrong by the tolerance of some 10 m/s, for 1.6 s, and the chain grows errors some ten times.
    EXPECT_LT(momentum, 200 * tolerance);
    EXPECT_LT(momentum, 0.3 * last_momentum);
    last_momentum = momentum;
  }
}

TEST_F(Orders, CutStepsAreRefusedWhereTheyWouldLoseTheOrder) {
  EXPECT_THROW(GeneralizedAlpha(model, {0.8}).cut_steps(1e-4), hydro::InputError);
  EXPECT_THROW(ExplicitPair(model, {}).cut_steps(1e-4), hydro::InputError);
  EXPECT_THROW(EnergyMomentum(model).cut_steps(0), hydro::InputError);
}

/// A mass on a spring along x, pulled out by a metre.
struct Sprung {
  Model model;
  State start;
  Sprung(double mass, double stiffness, double damping = 0)
      : model(made(mass, stiffness, damping)), start(rest_state(model.bodies())) {
    start.pose[0].centre.x() = 1;
  }
  static Model made(double mass, double stiffness, double damping) {
    const RigidBody body({.name = "mass", .mass = mass, .inertia = Eigen::Matrix3d::Identity()});
    Matrix6 K = Matrix6::Zero(), D = Matrix6::Zero();
    K(0, 0) = stiffness;
    D(0, 0) = damping;
    std::vector<std::unique_ptr<const ForceKind>> forces;
    forces.push_back(
        std::make_unique<RestoringKind>("mooring", std::vector<RigidBody>{body}, std::vector<Restoring>{{0, K, D}}));
    return {{body}, {}, std::move(forces)};
  }
};

// Steps that change each time, without joints: an auxiliary acceleration that stays where the last step put it costs an
// order.
TEST(GeneralizedAlphaStep, KeepsItsOrderWhileStepsChange) {
  const Sprung sprung(2, 50);
  const auto error = [&](double h) {
    GeneralizedAlpha method(sprung.model, {0.2});
    Workspace w(sprung.model, sprung.start);
    method.start(w);
    for (int i = 0; i < std::lround(1.6 / (4 * h)); ++i) method.step(w, 3 * h), method.step(w, h);
    return std::hypot(w.state.pose[0].centre.x() - std::cos(5 * 1.6),
                      (w.state.velocity[0] + 5 * std::sin(5 * 1.6)) / 5);
  };
  EXPECT_NEAR(std::log2(error(4e-3) / error(2e-3)), 2, 0.1);
}

TEST(GeneralizedAlphaStep, CutToAToleranceGivesTheErrorAskedFor) {
  const Sprung sprung(2, 50);
  double last = infinite;
  for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
    GeneralizedAlpha method(sprung.model, {0.8});
    method.cut_steps(tolerance);
    const State end = after(method, sprung.model, sprung.start, 0.1, 1.6);
    const double error = std::abs(end.pose[0].centre.x() - std::cos(5 * 1.6));
    // Speeds, of 5 m/s and what 25 m/s² add in 0.1 s, are wrong by the tolerance for 1.6 s, and places as much again.
    EXPECT_LT(error, 2 * 1.6 * 7.5 * tolerance);
    EXPECT_LT(error, 0.3 * last);
    last = error;
  }
}

TEST(GeneralizedAlphaStep, CutStepsAreShortWhileMotionIsFast) {
  const Sprung creeping(2, 50, 40);  // e^(−18.7 t), then e^(−1.3 t)
  GeneralizedAlpha method(creeping.model, {0.8});
  method.cut_steps(1e-5);
  Workspace w(creeping.model, creeping.start);
  method.start(w);
  const int first = method.step(w, 0.2).parts;
  int last = 0;
  for (int i = 0; i < 20; ++i) last = method.step(w, 0.2).parts;
  EXPECT_GT(first, 5 * last);
}

TEST_F(Orders, OfGeneralizedAlphaWithJointsIsOneWhileStepsChange) {
  const State exact = reference();
  const auto error = [&](double h) {
    GeneralizedAlpha method(model, {0.2});
    Workspace w(model, rest_state(model.bodies()));
    method.start(w);
    for (int i = 0; i < std::lround(duration / (4 * h)); ++i) method.step(w, 3 * h), method.step(w, h);
    return distance(w.state, exact);
  };
  EXPECT_NEAR(std::log2(error(2e-3) / error(1e-3)), 1, 0.1);
}

// Nothing is added or taken at any step; Newton's tolerance, 1e-9 of each step's motion, leaves 1e-10 after a thousand.
TEST(EnergyMomentumStep, KeepsTheEnergyOfADoublePendulumAtLargeSteps) {
  const Model model = double_pendulum(0.4);
  Workspace w(model, rest_state(model.bodies()));
  EnergyMomentum integrator(model);
  integrator.start(w);
  double worst = 0, turnover = 0;
  for (int i = 0; i < 1000; ++i) {
    integrator.step(w, 0.03);
    const double kinetic = model.kinetic_energy(w.state);
    worst = std::max(worst, std::abs(kinetic + support::height_energy(w.state)));
    turnover = std::max(turnover, kinetic);
  }
  EXPECT_GT(turnover, 30) << "it has swung";
  EXPECT_LT(worst, 1e-9 * turnover);
  EXPECT_LT(model.joints().values(w.state).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(EnergyMomentumStep, KeepsEnergyAndMomentumOfATumblingBody) {
  RigidBody body({.name = "top", .mass = 3, .inertia = Eigen::Vector3d(1, 2, 2.7).asDiagonal()});
  const Model model({body}, {}, {});
  State start = rest_state(model.bodies());
  start.velocity << 0.3, -0.2, 0.5, 0.01, 3, 0.02;  // about the middle axis: it turns over and over
  Workspace w(model, start);
  EnergyMomentum integrator(model);
  integrator.start(w);
  const auto momentum = [&](const State& s) {
    const Eigen::Matrix3d R = s.pose[0].attitude.toRotationMatrix();
    return Eigen::Vector3d(R * body.inertia() * R.transpose() * s.velocity.tail<3>());
  };
  const Eigen::Vector3d L = momentum(start);
  const double E = model.kinetic_energy(start);
  for (int i = 0; i < 500; ++i) integrator.step(w, 0.1);
  // What Newton leaves of 1e-9 in 500 steps, with random signs at most 2e-8.
  EXPECT_LT((momentum(w.state) - L).norm(), 2e-8 * L.norm());
  EXPECT_NEAR(model.kinetic_energy(w.state), E, 2e-8 * E);
}

TEST(EnergyMomentumStep, KeepsTheEnergyOfALinearSpring) {
  const Sprung sprung(2, 50);
  Workspace w(sprung.model, sprung.start);
  EnergyMomentum integrator(sprung.model);
  integrator.start(w);
  for (int i = 0; i < 1000; ++i) integrator.step(w, 0.3);  // ωh = 1.5
  const double x = w.state.pose[0].centre.x();
  EXPECT_NEAR(sprung.model.kinetic_energy(w.state) + 25 * x * x, 25, 1e-9 * 25);
}

// Far too stiff for a step of 0.1 s: it says so and leaves the last good state.
TEST(ExplicitPairStep, GivesUpWithAReasonWhereSomethingIsStiff) {
  const Sprung sprung(1, 1e20);
  Workspace w(sprung.model, sprung.start);
  ExplicitPair integrator(sprung.model, {});
  integrator.start(w);
  EXPECT_THAT([&] { integrator.step(w, 0.1); },
              testing::ThrowsMessage<hydro::NumericsError>(testing::HasSubstr("too stiff")));
  EXPECT_EQ(w.state.time, 0);
}

TEST(ExplicitPairStep, RefusesContacts) {
  RigidBody body({.name = "ball", .mass = 1, .inertia = Eigen::Matrix3d::Identity()});
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<ContactKind>(
      std::vector<Contact>{{"floor", 0, {}, {Ball{{0, 0, 0}, 0.1}, HalfSpace{{0, 0, -1}, {0, 0, 1}}}, 0, 0}}));
  const Model model({body}, {}, std::move(forces));
  EXPECT_THROW(ExplicitPair(model, {}), hydro::InputError);
  EXPECT_THROW(EnergyMomentum{model}, hydro::InputError);
}

}  // namespace
}  // namespace integrators_test
