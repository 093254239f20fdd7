// Cylinders and spheres without a mesh: against meshes, closed forms, and the laws of still water.
#include "hydro/hydrostatics/shapes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hulls.hpp"
#include "hydro/base/random.hpp"

namespace hydro::hydrostatics::shapes_test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using testing::HasSubstr;
using testing::ThrowsMessage;

const CircularCylinder buoy{{0.3, -0.2, -2.5}, {0.3, -0.2, 1.5}, 1.2};
const Sphere ball{{0.3, -0.2, -0.4}, 1.2};

/// Heeled by any angle and moved by up to about a metre.
Pose random_pose(std::uint64_t seed) {
  const RandomStream random(seed, 3);
  const Vector3d turn(random.normal(0), random.normal(1), random.normal(2));
  return {Eigen::AngleAxisd(2 * turn.norm(), turn.normalized()).toRotationMatrix(),
          {random.normal(3), random.normal(4), random.normal(5)}};
}

template <class Shape>
void expect_laws(const Shape& shape, const Pose& pose) {
  // Central differences of e = 1e-5 m: error e² of the third derivative, and 1e-16/e of round-off.
  constexpr double e = 1e-5;
  const Vector3d p(0.5, 0.7, -0.3);
  const Vector6 load = buoyancy(immersion(shape, pose), water, p);
  const Matrix6 K = buoyancy_stiffness(immersion(shape, pose), water, p);
  const double scale = rho_g * 20;  // about the weight of the water that the shape holds
  for (int i = 0; i < 6; ++i) {
    const Vector6 step = e * Vector6::Unit(i);
    const auto ahead = immersion(shape, moved(pose, p, step)), behind = immersion(shape, moved(pose, p, -step));
    EXPECT_NEAR(load[i], -(buoyancy_energy(ahead, water) - buoyancy_energy(behind, water)) / (2 * e), 1e-7 * scale);
    const Vector6 column =
        -(buoyancy(ahead, water, p + step.head<3>()) - buoyancy(behind, water, p - step.head<3>())) / (2 * e);
    EXPECT_LT((K.col(i) - column).norm(), 1e-6 * scale) << "motion " << i;
  }
}

TEST(Shapes, FollowTheLawsOfStillWaterAtAnyPose) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    expect_laws(buoy, random_pose(seed));
    expect_laws(ball, random_pose(seed));
  }
}

void expect_near_mesh(const Immersion& exact, const Immersion& mesh, double tolerance) {
  EXPECT_NEAR(exact.volume, mesh.volume, tolerance);
  EXPECT_NEAR(exact.wetted_area, mesh.wetted_area, 3 * tolerance);
  ASSERT_EQ(exact.centre_of_buoyancy.has_value(), mesh.centre_of_buoyancy.has_value());
  if (exact.centre_of_buoyancy) {
    EXPECT_LT((*exact.centre_of_buoyancy - *mesh.centre_of_buoyancy).norm(), tolerance);
  }
  ASSERT_EQ(exact.waterplane.has_value(), mesh.waterplane.has_value());
  if (!exact.waterplane) return;
  EXPECT_NEAR(exact.waterplane->area, mesh.waterplane->area, 3 * tolerance);
  EXPECT_LT((exact.waterplane->centre - mesh.waterplane->centre).norm(), 3 * tolerance);
  EXPECT_LT((exact.waterplane->second_moment - mesh.waterplane->second_moment).norm(), 10 * tolerance);
}

TEST(Shapes, AreWhatFineMeshesComeNearTo) {
  const Hull cylinder(cylinder_mesh({0.3, -0.2}, 1.2, -2.5, 1.5, 720)), sphere(sphere_mesh(ball.centre, 1.2, 5));
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const Pose pose = random_pose(seed);
    // 720 walls lack α²/6 = 1.3e-5 of the volume of 18 m³ (H3), a sphere of 8192 triangles 1.5e-3 of 7 m³.
    expect_near_mesh(immersion(buoy, pose), immersion(cylinder, pose), 3e-4);
    expect_near_mesh(immersion(ball, pose), immersion(sphere, pose), 1.5e-2);
  }
}

TEST(Shapes, OfACylinderCutThroughItsWallAreTheTextbookSegment) {
  // Heeled by θ and sunk by s along the vertical: V/(πa²) is the wet length of the axis, the buoyancy of Orszaghova et
  // al. (3): ΔV = S_B (L (1 − cos θ) − r cos θ)/cos θ, here with its anchor at −L and slid by r.
  const double a = 4, T = 8, L = 30, theta = 0.35, r = -0.6;
  const CircularCylinder c{{0, 0, -T}, {0, 0, 6}, a};
  const Eigen::Matrix3d R = Eigen::AngleAxisd(theta, Vector3d::UnitY()).toRotationMatrix();
  const Pose pose{R, R * Vector3d(0, 0, L + r) - Vector3d(0, 0, L)};
  const Immersion im = immersion(c, pose);
  const double dV = pi * a * a * (L * (1 - std::cos(theta)) - r * std::cos(theta)) / std::cos(theta);
  EXPECT_NEAR(im.volume, pi * a * a * T + dV, 1e-12 * im.volume);
  // The waterplane is an ellipse of half axes a and a/cos θ about the point where the axis meets the water.
  ASSERT_TRUE(im.waterplane);
  EXPECT_NEAR(im.waterplane->area, pi * a * a / std::cos(theta), 1e-12 * im.volume);
  EXPECT_NEAR(im.waterplane->centre.x(), L * std::tan(theta), 1e-12 * L);
  EXPECT_NEAR(im.waterplane->second_moment(0, 0), pi / 4 * std::pow(a, 4) / std::pow(std::cos(theta), 3), 1e-10);
  EXPECT_NEAR(im.waterplane->second_moment(1, 1), pi / 4 * std::pow(a, 4) / std::cos(theta), 1e-10);
}

TEST(Shapes, OfASphereAreItsCap) {
  // Orszaghova et al. (3) for a sphere half under water at rest: ΔV = S_B x − π x³/3, sunk by x.
  for (const double x : {-0.5, 0.3, 1.1}) {
    const Immersion im = immersion(Sphere{{0, 0, 0}, 1.2}, {.position = {0, 0, -x}});
    EXPECT_NEAR(im.volume, 2 * pi / 3 * 1.728 + pi * 1.44 * x - pi * x * x * x / 3, 1e-13);
  }
}

TEST(Shapes, AreContinuousThroughLevelAndUpright) {
  // A turn of 1e-9 may not show by more than 1e-8: the integrals must not lose digits where the axis is level, or
  // upright.
  for (const double angle : {0.0, pi / 2, pi}) {
    const auto at = [&](double off) {
      return immersion(buoy, {.attitude = Eigen::AngleAxisd(angle + off, Vector3d::UnitY()).toRotationMatrix(),
                              .position = {0, 0, angle == pi ? -1.0 : 0.4}});
    };
    const Immersion here = at(0);
    for (const double off : {1e-15, 1e-12, 1e-9}) {
      SCOPED_TRACE(testing::Message() << angle << " off by " << off);
      expect_near_mesh(at(off), here, 2e-8);
      expect_near_mesh(at(-off), here, 2e-8);
    }
  }
}

TEST(Shapes, AreAllOrNothingWhollyUnderOrAboveTheWater) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Pose pose = random_pose(seed);
    pose.position.z() = -10;
    EXPECT_NEAR(immersion(buoy, pose).volume, pi * 1.44 * 4, 1e-12);
    EXPECT_NEAR(immersion(buoy, pose).wetted_area, pi * 2.4 * 4 + 2 * pi * 1.44, 1e-11);
    EXPECT_LT((*immersion(buoy, pose).centre_of_buoyancy - pose * Vector3d(0.3, -0.2, -0.5)).norm(), 1e-12);
    EXPECT_NEAR(immersion(ball, pose).volume, 4 * pi / 3 * 1.728, 1e-12);
    EXPECT_FALSE(immersion(buoy, pose).waterplane);
    pose.position.z() = 10;
    EXPECT_EQ(immersion(buoy, pose).volume, 0);
    EXPECT_FALSE(immersion(ball, pose).centre_of_buoyancy);
  }
}

TEST(Shapes, RefuseWhatIsNone) {
  EXPECT_THAT([] { check(CircularCylinder{{0, 0, 0}, {0, 0, 0}, 1}); }, ThrowsMessage<InputError>(HasSubstr("apart")));
  EXPECT_THAT(
      [] {
        check(CircularCylinder{{0, 0, 0}, {0, 0, 1}, -1});
      },
      ThrowsMessage<InputError>(HasSubstr("positive, got -1 m")));
  EXPECT_THAT([] { check(Sphere{{0, 0, 0}, 0}); }, ThrowsMessage<InputError>(HasSubstr("positive")));
}

}  // namespace
}  // namespace hydro::hydrostatics::shapes_test
