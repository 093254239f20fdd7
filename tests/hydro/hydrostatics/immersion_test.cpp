// Closed forms: boxes, cylinders and spheres; hulls that touch the surface, are dry or drowned.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "hulls.hpp"
#include "support/source_dir.hpp"

namespace hydro::hydrostatics::immersion_test {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Pose sunk(double by) { return {.attitude = Eigen::Matrix3d::Identity(), .position = {0, 0, -by}}; }

TEST(Immersion, OfABoxIsThatOfTheTextbook) {
  const Immersion im = immersion(box(10, 4, 3, 1.2), {});
  EXPECT_NEAR(im.volume, 48, 1e-12);
  EXPECT_LT((*im.centre_of_buoyancy - Vector3d(0, 0, -0.6)).norm(), 1e-13);
  EXPECT_NEAR(im.wetted_area, 40 + 2 * 14 * 1.2, 1e-12);
  ASSERT_TRUE(im.waterplane.has_value());
  EXPECT_NEAR(im.waterplane->area, 40, 1e-12);
  EXPECT_NEAR(im.waterplane->second_moment(1, 1), 10 * 4 * 4 * 4 / 12.0, 1e-11);
  EXPECT_NEAR(im.waterplane->second_moment(0, 0), 4 * 1000 / 12.0, 1e-10);
  EXPECT_NEAR(im.waterplane->second_moment(0, 1), 0, 1e-11);
}

TEST(Immersion, GivesTheRestoringMatrixOfABoxAboutAnyPoint) {
  const Hull hull(box_mesh({1, -3, -1.2}, {11, 1, 2}));  // centre of the waterplane at (6, -1)
  const Immersion im = immersion(hull, {});
  const Vector3d G(6, -1, 0.4), P(2, 1, -0.5);
  const Matrix6 C = buoyancy_stiffness(im, water, P) + gravity_stiffness(rho_g * 48, G, P);
  EXPECT_NEAR(C(2, 2), rho_g * 40, 1e-7);
  EXPECT_NEAR(C(2, 3), rho_g * 40 * -2, 1e-7);
  EXPECT_NEAR(C(2, 4), -rho_g * 40 * 4, 1e-7);
  EXPECT_NEAR(C(3, 3), rho_g * (640 / 12.0 + 40 * 4 + 48 * (-0.6 - 0.4)), 1e-6);
  EXPECT_NEAR(C(4, 4), rho_g * (4000 / 12.0 + 40 * 16 + 48 * (-0.6 - 0.4)), 1e-6);
  EXPECT_NEAR(C(3, 4), -rho_g * 40 * 4 * -2, 1e-6);
  // In balance: G is above B, so nothing is left in the column of yaw and C is symmetric.
  EXPECT_LT((C - C.transpose()).norm(), 1e-6);
}

TEST(Immersion, OfAHalfSunkSphereHasNoMomentAboutItsMiddleHoweverItTurns) {
  // Twelve thousand triangles: flat ones lack 1.5e-4 of the radius (H3).
  const Hull hull(sphere_mesh({0, 0, 0}, 5, 5));
  const Pose turned{attitude_of(Angle::from_degrees(33), Angle::from_degrees(-71)), Vector3d::Zero()};
  const Immersion im = immersion(hull, turned);
  const double V = 2 * std::numbers::pi * 125 / 3, S = std::numbers::pi * 25;
  const double short_by = 1 - hull.volume() / (2 * V);
  EXPECT_LT(short_by, 2e-3);
  EXPECT_NEAR(im.volume, V, 2 * short_by * V);
  EXPECT_NEAR(im.centre_of_buoyancy->z(), -3 * 5 / 8.0, 5 * short_by);
  const Matrix6 K = buoyancy_stiffness(im, water, Vector3d::Zero());
  EXPECT_NEAR(K(2, 2), rho_g * S, 2 * short_by * rho_g * S);
  EXPECT_NEAR(K(3, 3), 0, 4 * short_by * rho_g * V * 5);  // I = V·BM, BM = 3R/8
  const Vector6 load = buoyancy(im, water, Vector3d::Zero());
  EXPECT_LT(load.tail<3>().norm(), short_by * load[2] * 5);
}

TEST(Immersion, OfASphereAtAnyDraughtIsTheCapOfTheTextbook) {
  constexpr double R = 2;
  const Hull hull(sphere_mesh({0, 0, 0}, R, 5));
  const double short_by = 1 - hull.volume() / (4 * std::numbers::pi * R * R * R / 3);
  for (const double d : {0.5, 1.0, 2.0, 3.0, 3.7}) {  // depth of the lowest point
    const double V = std::numbers::pi * d * d * (3 * R - d) / 3;
    const Immersion im = immersion(hull, sunk(d - R));
    EXPECT_NEAR(im.volume, V, 8 * short_by * R * R * R) << d;
    EXPECT_NEAR(im.waterplane->area, std::numbers::pi * d * (2 * R - d), 20 * short_by * R * R) << d;
  }
}

TEST(Immersion, OfACylinderAgreesWithItsPolygonToRoundOffAndWithTheCircleToItsChords) {  // (H3)
  constexpr double a = 3, d = 2;
  for (const int n : {6, 24, 96}) {
    const Immersion im = immersion(Hull(cylinder_mesh({1, -2}, a, -d, 1, n)), {});
    const double alpha = 2 * std::numbers::pi / n, S = std::numbers::pi * a * a * std::sin(alpha) / alpha;
    EXPECT_NEAR(im.waterplane->area, S, 1e-12 * S);
    EXPECT_NEAR(im.volume, S * d, 1e-12 * S * d);
    EXPECT_LT((im.waterplane->centre - Eigen::Vector2d(1, -2)).norm(), 1e-12);
    const double polygon = S * a * a * (2 + std::cos(alpha)) / 12;
    EXPECT_NEAR(im.waterplane->second_moment(0, 0), polygon, 1e-11 * polygon);
    EXPECT_NEAR(S, std::numbers::pi * a * a, 1.01 * alpha * alpha / 6 * std::numbers::pi * a * a);
  }
}

TEST(Immersion, OfATouchingHullIsNothingAndOfADrownedOneEverything) {
  const Hull hull = box(10, 4, 3, 1.2);
  const Immersion dry = immersion(hull, sunk(-5)), touching = immersion(hull, sunk(-1.2)),
                  awash = immersion(hull, sunk(1.8)), drowned = immersion(hull, sunk(9));
  for (const Immersion& im : {dry, touching}) {
    EXPECT_EQ(im.volume, 0);
    EXPECT_FALSE(im.centre_of_buoyancy.has_value());
    EXPECT_FALSE(im.waterplane.has_value());
    EXPECT_EQ(im.wetted_area, 0);
    EXPECT_EQ(buoyancy(im, water, {1, 2, 3}).norm(), 0);
    EXPECT_EQ(buoyancy_stiffness(im, water, {1, 2, 3}).norm(), 0);
  }
  EXPECT_EQ(dry.area_in_surface, 0);
  EXPECT_NEAR(touching.area_in_surface, 40, 1e-12);
  // The deck in the surface is dry: derivatives are those of rising, where the waterplane is the deck.
  EXPECT_NEAR(awash.volume, 120, 1e-11);
  EXPECT_NEAR(awash.area_in_surface, 40, 1e-12);
  EXPECT_NEAR(awash.waterplane->area, 40, 1e-12);
  EXPECT_NEAR(awash.wetted_area, hull.area() - 40, 1e-11);
  EXPECT_NEAR(drowned.volume, 120, 1e-11);
  EXPECT_FALSE(drowned.waterplane.has_value());
}

TEST(Immersion, TakesVerticesAndEdgesThatLieInTheSurface) {
  // An octahedron with four of its six vertices, and four of its edges, at z = 0.
  const Immersion octahedron = immersion(Hull(sphere_mesh({0, 0, 0}, 1, 0)), {});
  EXPECT_NEAR(octahedron.volume, 2 / 3.0, 1e-14);
  EXPECT_NEAR(octahedron.waterplane->area, 2, 1e-14);
  EXPECT_NEAR(octahedron.wetted_area, 2 * std::sqrt(3), 1e-14);
  // On one vertex, from below and from above.
  EXPECT_EQ(immersion(Hull(sphere_mesh({0, 0, 1}, 1, 0)), {}).volume, 0);
  const Immersion hanging = immersion(Hull(sphere_mesh({0, 0, -1}, 1, 0)), {});
  EXPECT_NEAR(hanging.volume, 4 / 3.0, 1e-14);
  EXPECT_FALSE(hanging.waterplane.has_value());
  // On the edge of a box that is heeled by 45°.
  const Hull cube(box_mesh({-1, -1, -1}, {1, 1, 1}));
  const Pose diamond{attitude_of(Angle::from_degrees(45), Angle::from_degrees(0)), Vector3d::Zero()};
  EXPECT_NEAR(immersion(cube, diamond).volume, 4, 1e-13);
  EXPECT_NEAR(immersion(cube, diamond).waterplane->area, 4 * std::sqrt(2), 1e-12);
  EXPECT_NEAR(immersion(cube, {diamond.attitude, {0, 0, std::sqrt(2.0)}}).volume, 0, 1e-14);
}

TEST(Immersion, IsContinuousThroughADeckThatGoesUnder) {
  const Hull hull = box(10, 4, 3, 1.2);
  // 40 m² of deck; within 1e-12 of the diagonal the deck counts as being at z = 0, which moves it by e once more.
  for (const double e : {1e-3, 1e-6, 1e-9, 1e-11, 1e-13})
    EXPECT_NEAR(immersion(hull, sunk(1.8 - e)).volume, immersion(hull, sunk(1.8 + e)).volume, 81 * e + 1e-12) << e;
}

TEST(Immersion, KeepsTheWaterplaneOfADeckARoundingErrorUnderTheSurface) {
  const Hull hull = box(10, 4, 3, 1.2);
  const double near = in_surface * hull.diagonal();
  for (const double depth : {-0.5 * near, 0.0, 1e-9, 0.5 * near}) {
    const Immersion im = immersion(hull, sunk(1.8 + depth));
    EXPECT_NEAR(im.waterplane.value().area, 40, 1e-12) << depth;
    EXPECT_NEAR(im.area_in_surface, 40, 1e-12) << depth;
    EXPECT_NEAR(im.volume, 120 - 40 * std::max(0.0, -depth), 1e-10) << depth;  // snapping at 1e-12 of the diagonal
  }
  const Immersion drowned = immersion(hull, sunk(1.8 + 2 * near));
  EXPECT_FALSE(drowned.waterplane.has_value());
  EXPECT_EQ(drowned.area_in_surface, 0);
}

TEST(Immersion, AgreesWithThePanelCodeBehindTheExampleData) {
  // hemisphere_r5.hst: Capytaine's matrix for a hemisphere of 5 m, G at z = -2 m, ρ 1000, g 9.81, by its own panels.
  const Hull hull(sphere_mesh({0, 0, 0}, 5, 5));
  const Immersion im = immersion(hull, {});
  const Vector3d O = Vector3d::Zero();
  const Matrix6 C = buoyancy_stiffness(im, water, O) + gravity_stiffness(rho_g * im.volume, {0, 0, -2}, O);
  std::ifstream file(froude_test::source_dir() / "examples/data/hemisphere_r5.hst");
  ASSERT_TRUE(file.good());
  int i = 0, j = 0, seen = 0;
  for (double value = 0; file >> i >> j >> value;) {
    // Both meshes are short of the sphere by less than 1 % (theirs is the coarser); the moments are of size ρgVR/2.
    const double scale = i <= 3 ? rho_g * std::numbers::pi * 25 : rho_g * 262 * 2.5;
    EXPECT_NEAR(rho_g * value, C(i - 1, j - 1), 0.02 * scale) << i << " " << j;
    ++seen;
  }
  EXPECT_GE(seen, 3);
}

TEST(Immersion, RefusesWaterThatComesInThroughAnOpening) {
  TriangleMesh open = box_mesh({-1, -1, -1}, {1, 1, 0.5});
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);  // its deck
  const Hull hull(open);
  EXPECT_FALSE(hull.closed());
  EXPECT_NEAR(hull.volume(), 6, 1e-14);
  EXPECT_NEAR(immersion(hull, {}).volume, 4, 1e-14);
  EXPECT_NEAR(immersion(hull, {}).waterplane->area, 4, 1e-14);
  EXPECT_NEAR(freeboard_of_openings(hull, {}), 0.5, 1e-15);
  EXPECT_NO_THROW(immersion(hull, sunk(0.5)));
  EXPECT_THAT([&] { immersion(hull, sunk(0.75)); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("water comes in"), HasSubstr("0.25 m under water"))));
}

TEST(Immersion, RefusesAPoseThatIsNone) {
  const Hull hull = box(1, 1, 1, 0.5);
  EXPECT_THAT([&] { immersion(hull, sunk(std::nan(""))); }, ThrowsMessage<InputError>(HasSubstr("finite")));
  EXPECT_THAT(
      [&] {
        immersion(hull, {2 * Eigen::Matrix3d::Identity(), Vector3d::Zero()});
      },
      ThrowsMessage<InputError>(HasSubstr("rotation")));
}

}  // namespace
}  // namespace hydro::hydrostatics::immersion_test
