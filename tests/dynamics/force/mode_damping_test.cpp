// Linear and quadratic damping of single modes at a body's origin. (D136)
#include "dynamics/force/mode_damping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "laws/force_kind_laws.hpp"
#include "support/force_law_models.hpp"

namespace mode_damping_test {
namespace {

using dynamics::ModeDamping;
using dynamics::ModeDampingKind;
using dynamics::Vector6;
using Eigen::Vector3d;

const std::vector<dynamics::RigidBody> bodies = support::two_bodies();

ModeDamping element() {
  ModeDamping out{.body = 0, .origin = {0.3, -0.2, 1.1}};
  out.linear << 3, 0, 5, 7, 0, 2;
  out.quadratic << 0, 4, 6, 1, 8, 0;
  return out;
}

TEST(ForceLaws, HoldForDampingOfModes) {
  ModeDamping other = element();
  other.body = 1;
  laws::expect_force_laws(ModeDampingKind({element(), other}), bodies);
}

// A body that heaves at v and pitches at w, whose origin is at r from its centre: u = v + w × r, and the force of heave
// turns the body about its centre.
TEST(ModeDamping, IsLinearAndQuadraticInTheVelocityOfTheOrigin) {
  dynamics::State s = dynamics::rest_state(bodies);
  const double v = 0.7, w = -0.4;
  s.velocity[2] = v;
  s.velocity[4] = w;
  const double x = 0.3, z = 1.1, heave = v - w * x, surge = w * z;  // w × r of w along y
  const Eigen::VectorXd F = laws::load(ModeDampingKind({element()}), s, nullptr);
  const Vector3d force(-3 * surge, 0, -(5 + 6 * std::abs(heave)) * heave);
  EXPECT_LT((F.head<3>() - force).norm(), 1e-12);
  const Vector3d moment = Vector3d(0, -8 * std::abs(w) * w, 0) + Vector3d(x, -0.2, z).cross(force);
  EXPECT_LT((F.segment<3>(3) - moment).norm(), 1e-12);
}

}  // namespace
}  // namespace mode_damping_test
