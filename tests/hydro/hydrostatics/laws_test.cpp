// Laws of buoyancy that hold for any hull in any pose.
#include <gtest/gtest.h>

#include "hulls.hpp"

namespace hydro::hydrostatics::laws_test {
namespace {

using Eigen::Vector3d;

TEST(HydrostaticLaws, BuoyancyIsMinusTheGradientOfItsEnergyAtAnyPose) {
  const Hull hull = odd_hull();
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Pose pose = some_pose(random);
    const Vector3d p(1, -2, 0.5);
    const Vector6 load = buoyancy(immersion(hull, pose), water, p);
    for (int i = 0; i < 6; ++i) {
      constexpr double h = 1e-4;
      const auto energy = [&](double by) {
        return buoyancy_energy(immersion(hull, moved(pose, p, by * Vector6::Unit(i))), water);
      };
      // Central differences leave h²/6 of the third derivative, ρ g S ℓ³ with arms ℓ of up to 10 m.
      EXPECT_NEAR(load[i], -(energy(h) - energy(-h)) / (2 * h), 1e-6 * load.norm())
          << "mode " << i << " trial " << trial;
    }
  }
}

TEST(HydrostaticLaws, WorkAlongALoopOfPosesIsZero) {
  const Hull hull = odd_hull();
  const Vector3d p(0.5, 0.3, -0.2);
  // Heave, heel and trim go round, out of phase; midpoints of 4000 steps, so the error is (2π/4000)² of the work.
  constexpr int steps = 4000;
  const auto pose = [](double s) {
    return Pose{attitude_of(Angle::from_radians(0.4 * std::sin(s)), Angle::from_radians(0.2 * std::cos(2 * s))),
                Vector3d(0, 0, 0.6 * std::cos(s))};
  };
  double work = 0, absolute = 0;
  for (int i = 0; i < steps; ++i) {
    const double s0 = 2 * std::numbers::pi * i / steps, s1 = 2 * std::numbers::pi * (i + 1) / steps;
    const Pose a = pose(s0), b = pose(s1), mid = pose((s0 + s1) / 2);
    const Vector6 load = buoyancy(immersion(hull, mid), water, mid * p);
    const Eigen::AngleAxisd turn(b.attitude * a.attitude.transpose());
    const double step = load.head<3>().dot(b * p - a * p) + load.tail<3>().dot(turn.angle() * turn.axis());
    work += step;
    absolute += std::abs(step);
  }
  EXPECT_GT(absolute, 1e5);
  EXPECT_NEAR(work, 0, 1e-6 * absolute);
}

TEST(HydrostaticLaws, TheStiffnessIsMinusTheDerivativeOfTheLoadAtAnyPose) {  // (H9)
  const Hull hull = odd_hull();
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Pose pose = some_pose(random);
    const Vector3d p(1, -2, 0.5);
    const Matrix6 K = buoyancy_stiffness(immersion(hull, pose), water, p);
    for (int j = 0; j < 6; ++j) {
      constexpr double h = 1e-4;
      const auto load = [&](double by) {
        const Vector6 motion = by * Vector6::Unit(j);
        return buoyancy(immersion(hull, moved(pose, p, motion)), water, p + motion.head<3>());
      };
      const Vector6 column = -(load(h) - load(-h)) / (2 * h);
      // The load has kinks in its second derivative where a vertex meets the surface: error h, not h².
      EXPECT_LT((column - K.col(j)).norm(), 1e-4 * K.norm()) << "mode " << j << " trial " << trial;
    }
  }
}

TEST(HydrostaticLaws, TheStiffnessIsSymmetricButForTheMomentThatIsTurned) {  // (H9)
  const Hull hull = odd_hull();
  std::mt19937 random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Immersion im = immersion(hull, some_pose(random));
    const Vector3d p(1, -2, 0.5);
    const Matrix6 K = buoyancy_stiffness(im, water, p);
    const Vector3d M = buoyancy(im, water, p).tail<3>();
    Matrix6 expected = Matrix6::Zero();
    expected.bottomRightCorner<3, 3>() << 0, -M.z(), M.y(), M.z(), 0, -M.x(), -M.y(), M.x(), 0;
    EXPECT_LT((K - K.transpose() - expected).norm(), 1e-12 * K.norm());  // round-off
  }
}

TEST(HydrostaticLaws, VolumeAndMovedCentreDoNotChangeWhenTheSubmergedHullTurns) {
  const Hull hull = odd_hull();
  const Immersion upright = immersion(hull, {.attitude = Eigen::Matrix3d::Identity(), .position = {0, 0, -30}});
  const Vector3d centre = *upright.centre_of_buoyancy - Vector3d(0, 0, -30);
  EXPECT_NEAR(upright.volume, hull.volume(), 1e-12 * hull.volume());
  EXPECT_NEAR(upright.wetted_area, hull.area(), 1e-12 * hull.area());
  std::mt19937 random(4);
  for (int trial = 0; trial < 20; ++trial) {
    Pose pose = some_pose(random);
    pose.attitude = pose.attitude * pose.attitude * pose.attitude * pose.attitude;  // any way up
    pose.position.z() -= 30;
    const Immersion im = immersion(hull, pose);
    EXPECT_NEAR(im.volume, upright.volume, 1e-12 * upright.volume);
    EXPECT_LT((*im.centre_of_buoyancy - pose * centre).norm(), 1e-11);
    EXPECT_FALSE(im.waterplane.has_value());
    EXPECT_EQ(buoyancy_stiffness(im, water, *im.centre_of_buoyancy).topLeftCorner(3, 3).norm(), 0);
  }
}

TEST(HydrostaticLaws, WhatIsUnderAndWhatIsAboveTheWaterMakeTheWholeHull) {
  const Hull hull = odd_hull();
  std::mt19937 random(5);
  Eigen::Matrix3d upside_down = Eigen::Vector3d(1, -1, -1).asDiagonal();
  for (int trial = 0; trial < 20; ++trial) {
    const Pose pose = some_pose(random);
    const Pose other{upside_down * pose.attitude, upside_down * pose.position};
    const Immersion a = immersion(hull, pose), b = immersion(hull, other);
    EXPECT_NEAR(a.volume + b.volume, hull.volume(), 1e-12 * hull.volume());
    EXPECT_NEAR(a.wetted_area + b.wetted_area, hull.area(), 1e-12 * hull.area());
    EXPECT_NEAR(a.waterplane->area, b.waterplane->area, 1e-11 * a.waterplane->area);
  }
}

TEST(HydrostaticLaws, WhereTheHullStandsAndLooksDoesNotMatter) {
  const Hull hull = odd_hull();
  const Pose pose{attitude_of(Angle::from_degrees(12), Angle::from_degrees(-7)), {0, 0, 0.2}};
  const Eigen::Matrix3d yaw = Eigen::AngleAxisd(2.1, Vector3d::UnitZ()).toRotationMatrix();
  const Vector3d away(3e5, -2e5, 0);
  const Immersion here = immersion(hull, pose),
                  there = immersion(hull, {yaw * pose.attitude, yaw * pose.position + away});
  EXPECT_NEAR(here.volume, there.volume, 1e-10 * here.volume);  // coordinates of 3e5 m carry 6e-11 m
  EXPECT_LT((yaw * *here.centre_of_buoyancy + away - *there.centre_of_buoyancy).norm(), 1e-9);
  const Eigen::Matrix2d Q = yaw.topLeftCorner<2, 2>();
  EXPECT_LT((Q * here.waterplane->second_moment * Q.transpose() - there.waterplane->second_moment).norm(),
            1e-9 * there.waterplane->second_moment.norm());
}

TEST(HydrostaticLaws, FinerTrianglesOfTheSameHullChangeNothing) {
  // Each triangle of a box cut in four: other cuts at the surface, the same hull.
  TriangleMesh fine = box_mesh({-2, -1.5, -1.1}, {3, 2, 0.8});
  for (int round = 0; round < 2; ++round) {
    TriangleMesh next{.source = "fine box", .vertices = {}, .triangles = {}};
    for (const auto& t : fine.triangles) {
      const auto v = [&](int i) { return fine.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(i)])]; };
      const Vector3d a = v(0), b = v(1), c = v(2), ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
      for (const auto& [p, q, r] :
           {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}}) {
        const int first = static_cast<int>(next.vertices.size());
        next.vertices.insert(next.vertices.end(), {p, q, r});
        next.triangles.push_back({first, first + 1, first + 2});
      }
    }
    fine = welded(std::move(next), 1e-9);
  }
  const Hull coarse(box_mesh({-2, -1.5, -1.1}, {3, 2, 0.8})), cut(fine);
  std::mt19937 random(6);
  for (int trial = 0; trial < 20; ++trial) {
    const Pose pose = some_pose(random);
    const Immersion a = immersion(coarse, pose), b = immersion(cut, pose);
    EXPECT_NEAR(a.volume, b.volume, 1e-12 * coarse.volume());
    EXPECT_NEAR(a.wetted_area, b.wetted_area, 1e-12 * coarse.area());
    EXPECT_LT((buoyancy_stiffness(a, water, {1, 2, 3}) - buoyancy_stiffness(b, water, {1, 2, 3})).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace hydro::hydrostatics::laws_test
