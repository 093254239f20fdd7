// Meshes of simple hulls: they enclose the volume they promise, open where they reach the water.
#include "hydro/hydrostatics/shape_meshes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hydro::hydrostatics {
namespace {

using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(ShapeMeshes, HaveTheVolumeOfTheRoundBody) {
  // Rounding: the radius is enlarged for it.
  EXPECT_NEAR(Hull(hemisphere_mesh(2, 5, 12)).volume(), 2 * pi / 3 * 8, 1e-9);
  EXPECT_NEAR(Hull(cylinder_mesh(2, 0.7, 3, 4, 9, {5, -3})).volume(), pi * 4 * 0.7, 1e-9);
  const double a = polygon_radius(16);  // a cone frustum, closed at both ends
  const Hull frustum(revolved({{0, 1}, {a, 1}, {2 * a, -2}, {0, -2}}, 16));
  EXPECT_TRUE(frustum.closed());
  EXPECT_NEAR(frustum.volume(), pi * 3 / 3 * (1 + 2 + 4), 1e-9);
}

TEST(ShapeMeshes, ABoxHasALidUnlessItEndsAtTheWater) {
  const Hull open(box_mesh({0, 0, -1}, {2, 3, 0}, {4, 3, 2})), closed(box_mesh({0, 0, -1}, {2, 3, 0.5}, {4, 3, 2}));
  EXPECT_FALSE(open.closed());
  EXPECT_NEAR(open.volume(), 6, 1e-12);
  EXPECT_TRUE(closed.closed());
  EXPECT_NEAR(closed.volume(), 9, 1e-12);
  EXPECT_EQ(open.triangles().size(), 2U * (4 * 3 + 2 * (4 + 3) * 2));
}

TEST(ShapeMeshes, CosineMakesPanelsSmallAtBothEnds) {
  // Of four parts the first is (1 − cos 45°)/2 of the length.
  const TriangleMesh mesh = box_mesh({0, 0, -1}, {1, 1, 0}, {4, 1, 1});
  double least = 1;
  for (const auto& v : mesh.vertices)
    if (v.x() > 1e-9) least = std::min(least, v.x());
  EXPECT_NEAR(least, (1 - std::sqrt(0.5)) / 2, 1e-12);
}

TEST(ShapeMeshes, WhatEnclosesNothingIsRefused) {
  EXPECT_THAT([] { hemisphere_mesh(-1, 4, 8); }, ThrowsMessage<InputError>(HasSubstr("-1 m")));
  EXPECT_THAT([] { cylinder_mesh(1, 1, 0, 2, 8); }, ThrowsMessage<InputError>(HasSubstr("a row of panels")));
  EXPECT_THAT([] { cylinder_mesh(1, 0, 2, 2, 8); }, ThrowsMessage<InputError>(HasSubstr("draught")));
  EXPECT_THAT([] { hemisphere_mesh(1, 4, 2); }, ThrowsMessage<InputError>(HasSubstr("three panels around")));
  EXPECT_THAT([] { revolved({{1, 0}}, 8); }, ThrowsMessage<InputError>(HasSubstr("two points")));
  EXPECT_THAT([] { revolved({{1, 0}, {-1, -1}}, 8); }, ThrowsMessage<InputError>(HasSubstr("(-1, -1) m")));
  EXPECT_THAT([] { box_mesh({0, 0, 0}, {1, 1, 0}, {1, 1, 1}); }, ThrowsMessage<InputError>(HasSubstr("positive")));
}

}  // namespace
}  // namespace hydro::hydrostatics
