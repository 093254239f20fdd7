#include "dynamics/force/drag.hpp"

#include <gtest/gtest.h>

#include "laws/force_kind_laws.hpp"

namespace drag_test {
namespace {

using namespace dynamics;

// A vertical cylinder towed sideways: F = ½ ρ C_D D L U², against the motion, at mid-draught.
TEST(Drag, IsTheTextbookForceOnATowedCylinder) {
  const auto bodies = support::two_bodies();
  const auto pieces = drag_pieces(bodies, 0, Eigen::Vector3d(0, 0, -2), Eigen::Vector3d(0, 0, 1), 0.5, 1.2, 1000);
  const DragKind kind(pieces, std::nullopt);
  State s = rest_state(bodies);
  s.velocity[0] = 3;
  const Eigen::VectorXd F = laws::load(kind, s, nullptr);
  const double expected = 0.5 * 1000 * 1.2 * 0.5 * 2 * 9;  // 2 m of it are wet
  EXPECT_NEAR(F[0], -expected, 1e-12 * expected);
  EXPECT_NEAR(F[4], expected * 1.3, 1e-10 * expected);  // acts 1.3 m below the centre of gravity, which is 0.3 m up
}

TEST(Drag, TakesNoForceAlongTheAxis) {
  const auto bodies = support::two_bodies();
  const DragKind kind(drag_pieces(bodies, 0, Eigen::Vector3d(0, 0, -2), Eigen::Vector3d(0, 0, -1), 0.5, 1.2, 1000),
                      std::nullopt);
  State s = rest_state(bodies);
  s.velocity[2] = 3;
  EXPECT_EQ(laws::load(kind, s, nullptr).norm(), 0);
}

TEST(Drag, OfAMemberAboveTheWaterIsNothing) {
  EXPECT_TRUE(
      drag_pieces(support::two_bodies(), 0, Eigen::Vector3d(0, 0, 0.1), Eigen::Vector3d(0, 0, 1), 0.5, 1.2, 1000)
          .empty());
}

// Rotating about mid-length, ∫ ½ρC_D D |ωs| ωs · s ds over ±L/2 = ρ C_D D ω² L⁴/64: the quadrature's own error shows
// here.
TEST(Drag, OfARotatingMemberIsTheIntegralToAFewPerCent) {
  const auto bodies = support::two_bodies();
  const Eigen::Vector3d centre = bodies[0].properties().centre_of_gravity.xyz;
  const double L = 2;
  const DragKind kind(drag_pieces(bodies, 0, centre + Eigen::Vector3d(0, 0, -3 - L / 2),
                                  centre + Eigen::Vector3d(0, 0, -3 + L / 2), 0.5, 1, 1000),
                      std::nullopt);
  State s = rest_state(bodies);
  s.velocity[4] = 0.8;      // pitch rate
  s.velocity[0] = 3 * 0.8;  // so that the member turns about its own middle
  const Eigen::VectorXd F = laws::load(kind, s, nullptr);
  const double moment_about_middle = F[4] + 3 * F[0];
  const double exact = -1000 * 1 * 0.5 * 0.8 * 0.8 * L * L * L * L / 64;
  EXPECT_NEAR(moment_about_middle, exact,
              0.04 * std::abs(exact));  // |s|s² is not smooth at the middle: three points give 0.516 where 0.5 is exact
}

}  // namespace
}  // namespace drag_test
