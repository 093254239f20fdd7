// Factors of Newton's matrix that outlive their step (D98): the same motion as with new ones at every correction, at
// fewer factorisations; wrong ones cost time and change nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/force/connector.hpp"
#include "dynamics/force/gravity.hpp"
#include "dynamics/force/restoring.hpp"
#include "dynamics/integrate/energy_momentum.hpp"
#include "dynamics/integrate/euler.hpp"
#include "dynamics/integrate/generalized_alpha.hpp"
#include "hydro/base/error.hpp"

namespace kept_factors_test {
namespace {

using namespace dynamics;

RigidBody body(int i) {
  return RigidBody({.name = "m" + std::to_string(i),
                    .mass = 2 + 0.1 * i,
                    .inertia = Eigen::Vector3d(1, 2, 2.5).asDiagonal(),
                    .rest_position = {Eigen::Vector3d(3.0 * i, 0, 0)}});
}

enum class Joined { by_springs, by_hinges };

/// A row of floating bodies joined end to end, that move by whole radians.
Model row(int count, Joined how) {
  std::vector<RigidBody> bodies;
  for (int i = 0; i < count; ++i) bodies.push_back(body(i));
  std::vector<Restoring> floating;
  for (int i = 0; i < count; ++i) floating.push_back({i, 20 * Matrix6::Identity(), Matrix6::Identity()});
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<RestoringKind>("hydrostatics", bodies, floating));
  std::vector<AxialConnector> springs;
  std::vector<Joint> hinges;
  for (int i = 0; i + 1 < count; ++i) {
    const Eigen::Vector3d end(1.5, 0.2, 0.1);
    springs.push_back(
        {{{i, end}, PointOnBody{i + 1, {-1.2, 0.2, 0.1}}}, {.stiffness = 300, .damping = 5, .cubic = 50}, 0.3});
    hinges.push_back({.name = "h",
                      .kind = JointKind::hinge,
                      .first = i,
                      .second = i + 1,
                      .place = {3.0 * i + 1.5, 0, 0},
                      .axis = {0, 1, 0}});
  }
  if (how == Joined::by_hinges) return Model(bodies, {}, std::move(forces), hinges);
  forces.push_back(std::make_unique<AxialConnectorKind>(springs));
  return Model(bodies, {}, std::move(forces));
}

/// Heave and pitch that differ from body to body; hinged ones are turned over as one.
State thrown(const Model& model, Joined how) {
  State start = rest_state(model.bodies());
  for (std::size_t i = 0; i < start.pose.size(); ++i) {
    const auto at = 6 * static_cast<Eigen::Index>(i);
    if (how == Joined::by_hinges) {
      start.velocity[at + 2] = 0.4;
      continue;
    }
    start.pose[i].centre.z() = 0.3 * std::cos(2.0 * static_cast<double>(i));
    start.velocity[at + 4] = std::sin(1.0 + static_cast<double>(i));
  }
  return start;
}

struct Outcome {
  State state;
  int iterations = 0, kept = 0;  ///< kept: steps that began with factors of their own length
};

enum class Factors { as_they_are, new_each_step, of_a_heavier_model };

template <class Method>
Outcome run(const Model& model, const State& start, int steps, Factors factors,
            double tolerance = NewtonIntegrator::least_residual_tolerance) {
  constexpr double h = 0.02;
  Workspace w(model, start);
  Method method = [&] {
    if constexpr (std::is_same_v<Method, GeneralizedAlpha>)
      return Method(model, {.rho_infinity = 0.8, .residual_tolerance = tolerance});
    else
      return Method(model);
  }();
  method.start(w);
  Outcome out;
  for (int i = 0; i < steps; ++i) {
    if (factors == Factors::new_each_step) w.solver.of_step = 0;
    if (factors == Factors::of_a_heavier_model) {
      model.tangent(w.state, 3, 0, 0, w, w.matrix);
      const auto G = model.joints().gradients(w.state);
      EXPECT_TRUE(w.solver.factorise(w.matrix, G, G, Eigen::VectorXd::Zero(model.joints().count())));
      w.solver.of_step = h;
    }
    out.kept += w.solver.of_step == h ? 1 : 0;
    out.iterations += method.step(w, h).newton_iterations;
  }
  out.state = w.state;
  return out;
}

double apart(const State& a, const State& b) {
  double most = (a.velocity - b.velocity).cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < a.pose.size(); ++i) {
    most = std::max(most, (a.pose[i].centre - b.pose[i].centre).cwiseAbs().maxCoeff());
    most = std::max(most, (a.pose[i].attitude.coeffs() - b.pose[i].attitude.coeffs()).cwiseAbs().maxCoeff());
  }
  return most;
}

template <class Method>
void expect_the_same_motion(Joined how) {
  constexpr int steps = 200;
  for (const int count : {1, 4, 30}) {  // dense and sparse factors
    SCOPED_TRACE(count);
    const Model model = row(count, how);
    const State start = thrown(model, how);
    const Outcome fresh = run<Method>(model, start, steps, Factors::new_each_step),
                  kept = run<Method>(model, start, steps, Factors::as_they_are),
                  wrong = run<Method>(model, start, steps, Factors::of_a_heavier_model);
    // Each step leaves 1e-12 of accelerations and of speeds over the step, 1 m/s / 0.02 s: 1e-12 m/s, two hundred
    // times, and what the motion makes of it.
    EXPECT_LT(apart(kept.state, fresh.state), 1e-9);
    EXPECT_LT(apart(wrong.state, fresh.state), 1e-9);
    EXPECT_EQ(fresh.kept, 0);
    EXPECT_GT(kept.kept, steps / 2) << "motions of a radian a second change the matrix by percents a step";
    EXPECT_GT(apart(start, fresh.state), 0.1);
  }
}

TEST(KeptFactors, LeaveTheMotionOfSprungBodiesAsItIs) {
  expect_the_same_motion<GeneralizedAlpha>(Joined::by_springs);
  expect_the_same_motion<EnergyMomentum>(Joined::by_springs);
  expect_the_same_motion<ImplicitEuler>(Joined::by_springs);
}

TEST(KeptFactors, LeaveTheMotionOfHingedBodiesAsItIs) {
  expect_the_same_motion<GeneralizedAlpha>(Joined::by_hinges);
  expect_the_same_motion<EnergyMomentum>(Joined::by_hinges);
}

TEST(KeptFactors, AreThoseOfStepsOfTheirLength) {
  const Model model = row(2, Joined::by_springs);
  Workspace w(model, thrown(model, Joined::by_springs));
  GeneralizedAlpha method(model, {.rho_infinity = 0.8});
  method.start(w);
  EXPECT_EQ(w.solver.of_step, 0) << "those of the masses, for the first accelerations";
  method.step(w, 0.02);
  EXPECT_EQ(w.solver.of_step, 0.02);
  method.step(w, 0.01);
  EXPECT_EQ(w.solver.of_step, 0.01);
}

TEST(NewtonTolerance, IsTheShareOfAPushThatEachStepMayLeave) {
  constexpr int steps = 200;
  constexpr double tolerance = 1e-9;
  for (const Joined how : {Joined::by_springs, Joined::by_hinges}) {
    const Model model = row(4, how);
    const State start = thrown(model, how);
    const Outcome exact = run<GeneralizedAlpha>(model, start, steps, Factors::as_they_are),
                  left = run<GeneralizedAlpha>(model, start, steps, Factors::as_they_are, tolerance);
    // 1e-9 of the speed in each step, 1 m/s and 1 rad/s here, two hundred times the same way, and what the motion makes
    // of it: the room that KeptFactors has at 1e-12.
    EXPECT_LT(apart(left.state, exact.state), 1e3 * tolerance);
    EXPECT_GT(apart(left.state, exact.state), 0) << "corrections are left out";
    EXPECT_LT(left.iterations, exact.iterations - steps / 2) << "one in two steps at least saves one";
  }
}

TEST(NewtonTolerance, IsNeitherRoundingNorAMotionOfItsOwn) {
  const Model model = row(1, Joined::by_springs);
  for (const double wrong : {1e-13, 1e-5})
    EXPECT_THROW(GeneralizedAlpha(model, {.residual_tolerance = wrong}), hydro::InputError) << wrong;
}

}  // namespace
}  // namespace kept_factors_test
