// What is seen of bodies from above: cuts with the still water, and plans of what lies under it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/compile/scenes.hpp"
#include "hydro/hydrostatics/shape_meshes.hpp"
#include "view/outlines.hpp"

namespace outlines_test {
namespace {

using namespace froude::view;
using Eigen::Vector2d, Eigen::Vector3d;
using hydro::hydrostatics::box_mesh, hydro::hydrostatics::TriangleMesh;

double length_of(const std::vector<Segment>& all) {
  double out = 0;
  for (const auto& [a, b] : all) out += (b - a).norm();
  return out;
}

/// How far a point is off the sides of |x| = 2, |y| = 3.
double off_the_rectangle(const Vector2d& p) { return std::abs(std::max(std::abs(p.x()) / 2, std::abs(p.y()) / 3) - 1); }

void expect_rectangle(const std::vector<Segment>& all) {
  EXPECT_NEAR(length_of(all), 2 * (4 + 6), 1e-12);
  for (const auto& [a, b] : all) {
    EXPECT_LT(off_the_rectangle(a), 1e-12);
    EXPECT_LT(off_the_rectangle(b), 1e-12);
    EXPECT_LT(off_the_rectangle((a + b) / 2), 1e-12) << "no side goes across";
  }
}

TriangleMesh lowered(TriangleMesh mesh, double by) {
  for (Vector3d& v : mesh.vertices) v.z() -= by;
  return mesh;
}

TEST(Outlines, OfABoxThroughTheSurfaceAreItsSides) {
  expect_rectangle(waterline_of(box_mesh({-2, -3, -1}, {2, 3, 0.7}, {3, 4, 5})));
}

// Panels for waves end at the water; a mesh that is cut there to the digits of its file too.
TEST(Outlines, OfABoxThatEndsAtTheSurfaceAreItsRim) {
  const TriangleMesh open = box_mesh({-2, -3, -1}, {2, 3, 0}, {3, 4, 5});
  expect_rectangle(waterline_of(open));
  expect_rectangle(waterline_of(lowered(open, 1e-7)));
  EXPECT_TRUE(waterline_of(lowered(open, 1e-3)).empty()) << "a millimetre is more than digits";
}

TEST(Outlines, OfAClosedBoxThatFloatsAtItsDeckAreItsSidesOnce) {
  const TriangleMesh closed = lowered(box_mesh({-2, -3, -1}, {2, 3, 0.5}, {2, 2, 3}), 0.5);
  expect_rectangle(waterline_of(closed));
}

TEST(Outlines, OfWhatLiesUnderWaterAreItsPlan) {
  const TriangleMesh sunk = lowered(box_mesh({-2, -3, -1}, {2, 3, 0.5}, {2, 3, 2}), 4);
  EXPECT_TRUE(waterline_of(sunk).empty());
  const auto plan = plan_of(sunk);
  for (const auto& [a, b] : plan)
    EXPECT_LT(std::max(off_the_rectangle(a), off_the_rectangle(b)), 1e-12) << a.transpose() << ", " << b.transpose();
  EXPECT_NEAR(length_of(plan), 2 * (4 + 6), 1e-12);
}

TEST(Outlines, OfCylindersAreCirclesWhereTheSceneHasThem) {
  const auto scene =
      froude_test::parse(froude_test::water +
                         "[[body]]\nname = \"b\"\nposition = \"(10, 20, -1) m\"\nmass = \"1 t\"\nfree = \"heave\"\n"
                         "[body.hydrodynamics]\nexcitation = true\n[body.hydrodynamics.cylinders]\n"
                         "at = \"(1, 2, 1) m\"\ndiameter = \"6 m\"\ndraught = \"5 m\"\n"
                         "frequencies = \"1 rad/s .. 2 rad/s, 2 values\"\n"
                         "[[body]]\nname = \"no_waves\"\nmass = \"1 t\"\nfree = \"heave\"\n[ask]\n"
                         "field = { omega = \"1 rad/s\", bodies = \"held\", x = \"0 m .. 1 m, 2 values\", "
                         "y = \"0 m .. 1 m, 2 values\" }\n");
  const auto outlines = outlines_of(scene);
  ASSERT_EQ(outlines.size(), 1u);
  EXPECT_EQ(outlines[0].body, "b");
  EXPECT_TRUE(outlines[0].submerged.empty());
  for (const auto& [a, b] : outlines[0].pierced) {
    EXPECT_NEAR((a - Vector2d(11, 22)).norm(), 3, 1e-12);
    EXPECT_NEAR(((a + b) / 2 - Vector2d(11, 22)).norm(), 3, 0.0022 * 3);  // 48 sides: 1 − cos(π/48) = 0.0021
  }
  EXPECT_NEAR(length_of(outlines[0].pierced), 2 * M_PI * 3, 0.001 * 2 * M_PI * 3);  // (π/48)²/6 = 0.0007
}

}  // namespace
}  // namespace outlines_test
