// A force by the velocity of a point, and the drag of a wind as its law. (D135)
#include "dynamics/force/wind.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dynamics/force/point_force.hpp"
#include "hydro/base/error.hpp"
#include "laws/force_kind_laws.hpp"
#include "support/force_law_models.hpp"

namespace wind_test {
namespace {

using dynamics::AtPoint;
using dynamics::PointForceKind;
using dynamics::WindDrag;
using Eigen::Vector3d;

const std::vector<dynamics::RigidBody> bodies = support::two_bodies();

PointForceKind<WindDrag> wind(std::vector<AtPoint<WindDrag>> elements) {
  return {std::move(elements), {"wind", "drag"}};
}

TEST(ForceLaws, HoldForWind) {
  laws::expect_force_laws(
      wind({{{0, {1, -2, 3}}, {{12, 5, 0}, 4}, "wind1"}, {{1, {0, 0, 4}}, {{-3, 0, 1}, 2}, "wind2"}}), bodies);
}

TEST(Wind, PushesABodyAtRestAndTurnsItAboutItsCentre) {
  const Eigen::VectorXd F =
      laws::load(wind({{{0, {0, 0, 2}}, {{6, 8, 0}, 0.5}, "w"}}), dynamics::rest_state(bodies), nullptr);
  const Vector3d force = 0.5 * 10 * Vector3d(6, 8, 0);
  EXPECT_LT((F.head<3>() - force).norm(), 1e-12);
  EXPECT_LT((F.segment<3>(3) - Vector3d(0, 0, 2).cross(force)).norm(), 1e-12);
}

TEST(Wind, DoesNothingToWhatGoesWithIt) {
  dynamics::State s = dynamics::rest_state(bodies);
  s.velocity.head<3>() = Vector3d(6, 8, 0);
  const auto kind = wind({{{0, {0, 0, 2}}, {{6, 8, 0}, 0.5}, "w"}});
  EXPECT_EQ(laws::load(kind, s, nullptr).norm(), 0);
  EXPECT_EQ(laws::jacobian(kind, s, nullptr, 1, 1).norm(), 0);
}

TEST(Wind, GrowsWithHeightAsAPower) {
  EXPECT_DOUBLE_EQ(dynamics::wind_at(10, 12, 10, 0.12), 12);
  EXPECT_DOUBLE_EQ(dynamics::wind_at(40, 12, 10, 0.5), 24);
  EXPECT_DOUBLE_EQ(dynamics::wind_at(3, 12, 10, 0), 12);
  EXPECT_THAT([] { dynamics::wind_at(-2, 12, 10, 0); },
              testing::ThrowsMessage<hydro::InputError>(testing::HasSubstr("2 m below still water")));
}

}  // namespace
}  // namespace wind_test
