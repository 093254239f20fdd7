// Linear hydrostatics of bodies that turn: what still water cannot tell apart gives the same load.
#include "dynamics/force/hydrostatics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

#include "laws/force_kind_laws.hpp"

namespace hydrostatics_force_test {
namespace {

using namespace dynamics;
using Eigen::AngleAxisd, Eigen::Matrix3d, Eigen::Vector3d;

constexpr double depth_of_g = 0.6;  // below still water, m

std::vector<RigidBody> barge() {
  return {RigidBody({.name = "b",
                     .mass = 80e3,
                     .inertia = Vector3d(2e5, 8e5, 8e5).asDiagonal(),
                     .centre_of_gravity = {Vector3d(0, 0, -depth_of_g)}})};
}

Hydrostatics element() {
  Hydrostatics out{.body = 0};
  out.stiffness << 4e5, 0, -3e4, 0, 2.6e5, 1e4, -3e4, 1e4, 2e6;
  return out;
}

Vector6 load(const Hydrostatics& e, double yaw, const Vector3d& lean, double rise) {
  const auto bodies = barge();
  State state = rest_state(bodies);
  const double angle = lean.norm();
  state.pose[0].attitude = AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(angle, lean / angle);
  state.pose[0].centre.z() += rise;
  return laws::load(HydrostaticsKind(bodies, {e}), state, nullptr);
}

// Seen along the body all is as it was; and still water turns nobody about the vertical.
TEST(Hydrostatics, AreTheSameWhateverTheHeading) {
  Hydrostatics e = element();
  e.moment = {3e4, -2e4};
  const Vector3d lean(0.2, -0.1, 0);
  const Vector6 ahead = load(e, 0, lean, -0.3);
  for (const double yaw : {0.6, 1.571, -2.9}) {
    const Vector6 turned = load(e, yaw, lean, -0.3);
    const Matrix3d R = AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
    EXPECT_LT((turned.head<3>() - R * ahead.head<3>()).norm(), 1e-9 * ahead.norm());
    EXPECT_LT((turned.tail<3>() - R * ahead.tail<3>()).norm(), 1e-9 * ahead.norm());
    EXPECT_NEAR(turned(5), 0, 1e-9 * ahead.norm());
  }
}

// To first order −C (rise, roll, pitch), second order of 1e-4 rad left.
TEST(Hydrostatics, AreThoseOfTheMatrixForSmallMotions) {
  constexpr double small = 1e-4;
  const Hydrostatics e = element();
  const Vector6 found = load(e, 0, small * Vector3d(0.8, -0.6, 0), 0.5 * small);
  const Vector3d expected = -e.stiffness * small * Vector3d(0.5, 0.8, -0.6);
  EXPECT_LT((found.segment<3>(2) - expected).norm(), small * expected.norm());
}

// Both ways of it, and their slopes, meet; and both are θ/sin θ.
TEST(TiltScale, IsTheAngleOverItsSineWithItsSlopes) {
  for (const double angle : {1e-9, 1e-3, 0.3, 0.45103, 0.4512, 1.0, 2.5}) {
    const double c = std::cos(angle), h = 1e-5;
    const TiltScale K = tilt_scale(c);
    EXPECT_NEAR(K.value, angle / std::sin(angle), 1e-9 * K.value) << angle;  // of cos θ, which rounds
    if (c + h >= 1) continue;
    // Central differences over 1e-5 leave 1e-10 of the slopes' own slopes, and rounding 1e-11.
    EXPECT_NEAR(K.slope, (tilt_scale(c + h).value - tilt_scale(c - h).value) / (2 * h), 1e-7 * std::abs(K.slope));
    EXPECT_NEAR(K.curvature, (tilt_scale(c + h).slope - tilt_scale(c - h).slope) / (2 * h), 1e-7 * K.curvature);
  }
}

}  // namespace
}  // namespace hydrostatics_force_test
