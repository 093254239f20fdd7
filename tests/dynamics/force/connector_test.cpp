#include "dynamics/force/connector.hpp"

#include <gtest/gtest.h>

#include "laws/force_kind_laws.hpp"

namespace connector_test {
namespace {

using namespace dynamics;

TEST(AxialConnector, PullsAlongItsLineByStiffnessTimesStretch) {
  const auto bodies = support::two_bodies();
  // Ends at the centres, 4 m apart at rest.
  const AxialConnector c{{{0, {0, 0, 0}}, PointOnBody{1, {0, 0, 0}}}, {250, 10}, 3.5};
  State s = rest_state(bodies);
  s.velocity[6] = 2;  // the second body moves away at 2 m/s
  EXPECT_NEAR(axial_state(c, s).tension, 250 * 0.5 + 10 * 2, 1e-12 * 145);
  const Eigen::VectorXd F = laws::load(AxialConnectorKind({c}), s, nullptr);
  EXPECT_NEAR(F[0], 145, 1e-10);  // a stretched spring pulls the first body towards the second, +x
  EXPECT_NEAR(F[6], -145, 1e-10);
}

TEST(BushingConnector, ResistsEachAxisByItsOwnStiffness) {
  const auto bodies = support::two_bodies();
  const BushingConnector c{
      {{0, {2, 0, 0}}, PointOnBody{1, {-2, 0, 0}}}, {100, 200, 300}, {0, 0, 0}, {0, 0, 50}, {0, 0, 0}, {0, 0, 0}};
  State s = rest_state(bodies);
  s.pose[1].centre += Eigen::Vector3d(0.01, 0.02, 0.03);
  const Eigen::VectorXd F = laws::load(BushingConnectorKind({c}), s, nullptr);
  EXPECT_NEAR(F[0], 1, 1e-10);
  EXPECT_NEAR(F[1], 4, 1e-10);
  EXPECT_NEAR(F[2], 9, 1e-10);
  s = rest_state(bodies);
  const Eigen::Vector3d arm(-2, 0, 0);
  s.pose[1].attitude = rotation_exp(Eigen::Vector3d(0, 0, 0.1));
  s.pose[1].centre -= s.pose[1].attitude * arm - arm;  // turned about the second end, which stays
  EXPECT_NEAR(laws::load(BushingConnectorKind({c}), s, nullptr)[5], 50 * 0.1, 1e-9);
}

// Turning both bodies together strains nothing, however far.
TEST(Connectors, DoNotFeelARigidTurnOfTheWhole) {
  const auto bodies = support::two_bodies();
  const PointOnBody first{0, {1, 0.5, 0.2}}, second{1, {-1, 0.5, -0.1}};
  const Ends ends{first, second};
  const State rest = rest_state(bodies);
  const Eigen::Vector3d offset = place_of(second, rest) - place_of(first, rest);
  const AxialConnectorKind axial({{ends, {3000, 200}, offset.norm()}});
  const Eigen::Vector3d k(1000, 2000, 500), c(30, 10, 60), kr(300, 200, 100), cr(5, 8, 3);
  const BushingConnectorKind bushing({{ends, k, c, kr, cr, offset}});
  State s = rest;
  const Eigen::Quaterniond turn = rotation_exp(Eigen::Vector3d(1.0, -2.0, 0.7));
  const Eigen::Vector3d spin(0.3, 0.2, -0.9);
  for (std::size_t i = 0; i < 2; ++i) {
    s.pose[i].centre = turn * s.pose[i].centre;
    s.pose[i].attitude = turn;
    s.velocity.segment<6>(6 * static_cast<Eigen::Index>(i)) << spin.cross(s.pose[i].centre), spin;
  }
  EXPECT_LT(laws::load(axial, s, nullptr).norm(), 1e-9);  // 3000 N/m times round-off of a few metres
  EXPECT_LT(laws::load(bushing, s, nullptr).norm(), 1e-9);
}

}  // namespace
}  // namespace connector_test
