// Moorings as a matrix: forces act at the point that they are about.
#include "dynamics/force/restoring.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "laws/force_kind_laws.hpp"

namespace restoring_test {
namespace {

using namespace dynamics;
using Eigen::Vector3d;

/// A buoy whose origin is 8 m above its centre of gravity, leaning and gone aside.
struct Buoy {
  std::vector<RigidBody> bodies{
      RigidBody({.name = "buoy", .mass = 6e5, .inertia = Vector3d(1e7, 1e7, 5e6).asDiagonal()})};
  State state = rest_state(bodies);
  Buoy(const Vector3d& lean, const Vector3d& aside) {
    state.pose[0].attitude = rotation_exp(lean);
    state.pose[0].centre += aside;
  }
  Vector3d axis() const { return state.pose[0].attitude * Vector3d::UnitZ(); }
  Vector6 load(const Matrix6& stiffness) const {
    return laws::load(RestoringKind("mooring", bodies, {{.body = 0, .stiffness = stiffness, .point = {0, 0, 8}}}),
                      state, nullptr);
  }
};

// A force through an axis does not turn about it, however the body leans.
TEST(Restoring, OfSpringsAtTheAxisDoesNotTurnABodyAboutIt) {
  Matrix6 C = Matrix6::Zero();
  C(0, 0) = C(1, 1) = 4e4;
  const Buoy buoy({0.2, -0.3, 0}, {1.5, 0.4, -0.2});
  const Vector6 F = buoy.load(C);
  EXPECT_NEAR(F.tail<3>().dot(buoy.axis()), 0, 1e-12 * F.tail<3>().norm());
  EXPECT_GT(F.tail<3>().norm(), 1e5);  // N m: it turns it about others
}

// What a spring at a point does is known without any matrix.
TEST(Restoring, OfSpringsAtAPointIsAForceThere) {
  Matrix6 C = Matrix6::Zero();
  C.diagonal().head<3>() << 4e4, 3e4, 2e4;
  const Buoy buoy({0.2, -0.3, 0.5}, {1.5, 0.4, -0.2});
  const Vector3d arm = 8 * buoy.axis(), moved = Vector3d(1.5, 0.4, -0.2) + arm - Vector3d(0, 0, 8);
  const Vector3d force = -Vector3d(4e4 * moved.x(), 3e4 * moved.y(), 2e4 * moved.z());
  Vector6 expected;
  expected << force, arm.cross(force);
  EXPECT_LT((buoy.load(C) - expected).norm(), 1e-12 * expected.norm());
}

}  // namespace
}  // namespace restoring_test
