#include "dynamics/integrate/sundials_bdf.hpp"

#include <gtest/gtest.h>

#include "dynamics/force/contact.hpp"
#include "dynamics/integrate/explicit_pair.hpp"
#include "hydro/base/error.hpp"
#include "support/double_pendulum.hpp"

namespace sundials_bdf_test {
namespace {

using namespace dynamics;

State after(Integrator& integrator, const Model& model) {
  Workspace w(model, rest_state(model.bodies()));
  integrator.start(w);
  for (int i = 0; i < 10; ++i) integrator.step(w, 0.1);
  return w.state;
}

double apart(const State& a, const State& b) {
  double most = (a.velocity - b.velocity).cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < a.pose.size(); ++i) most = std::max(most, (a.pose[i].centre - b.pose[i].centre).norm());
  return most;
}

// Two methods of different authors, by difference and by quadrature, meet as both are asked for more.
TEST(SundialsBdf, MeetsTheExplicitPair) {
  const Model model = support::double_pendulum(0.4);
  ExplicitPair pair(model, {1e-13});
  const State exact = after(pair, model);
  double last = 1;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    SundialsBdf bdf(model, {tolerance});
    const double error = apart(after(bdf, model), exact);
    EXPECT_LT(error, 5000 * tolerance) << "some hundreds of inner steps, in a motion that parts from its neighbours";
    EXPECT_LT(error, 0.2 * last);
    last = error;
  }
}

TEST(SundialsBdf, RefusesContactsAndNoTolerance) {
  RigidBody body({.name = "ball", .mass = 1, .inertia = Eigen::Matrix3d::Identity()});
  std::vector<std::unique_ptr<const ForceKind>> forces;
  forces.push_back(std::make_unique<ContactKind>(
      std::vector<Contact>{{"floor", 0, {}, {Ball{{0, 0, 0}, 0.1}, HalfSpace{{0, 0, -1}, {0, 0, 1}}}, 0, 0}}));
  const Model model({body}, {}, std::move(forces)), free({body}, {}, {});
  EXPECT_THROW(SundialsBdf(model, {}), hydro::InputError);
  EXPECT_THROW(SundialsBdf(free, {0}), hydro::InputError);
  EXPECT_THROW(SundialsBdf(free, {}).cut_steps(1e-4), hydro::InputError);
}

}  // namespace
}  // namespace sundials_bdf_test
