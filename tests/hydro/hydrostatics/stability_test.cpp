// Floating, metacentres and righting arms against the closed forms of naval architecture.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hulls.hpp"
#include "hydro/hydrostatics/stability.hpp"

namespace hydro::hydrostatics::stability_test {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::vector<double> heels(double last_degrees, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(last_degrees * degree * i / (count - 1));
  return out;
}

TEST(Floating, BalancesAnyVolumeAtAnyAttitude) {
  const Hull hull = odd_hull();
  std::mt19937 random(7);
  for (const double part : {1e-4, 0.1, 0.5, 0.9, 0.9999}) {
    const Pose pose = floating_at(hull, some_pose(random).attitude, part * hull.volume());
    EXPECT_NEAR(immersion(hull, pose).volume, part * hull.volume(), 1e-12 * hull.volume()) << part;
  }
}

TEST(Floating, LeavesAHullThatIsJustAwashWhereItIs) {
  EXPECT_NEAR(floating_at(box(4, 2, 2, 1), Eigen::Matrix3d::Identity(), 16).position.z(), -1, 1e-14);
  TriangleMesh open = box_mesh({-2, -1, -1}, {2, 1, 0});
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);
  EXPECT_NEAR(floating_at(Hull(open), Eigen::Matrix3d::Identity(), 8).position.z(), 0, 1e-14);
}

TEST(Floating, RefusesAHullThatSinksOrFloods) {
  const Hull hull = box(4, 2, 2, 1);
  EXPECT_THAT([&] { floating_at(hull, Eigen::Matrix3d::Identity(), 17); },
              ThrowsMessage<InputError>(HasSubstr("wholly under water at 16 m³")));
  EXPECT_THAT([&] { equilibrium(hull, {-1, {0, 0, 0}}, water); }, ThrowsMessage<InputError>(HasSubstr("mass")));
  TriangleMesh open = box_mesh({-1, -1, -1}, {1, 1, 0.5});
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);
  EXPECT_THAT([&] { floating_at(Hull(open), attitude_of(Angle::from_degrees(20), Angle::from_degrees(0)), 5.5); },
              ThrowsMessage<InputError>(HasSubstr("by its openings")));
}

TEST(Metacentre, OfABoxIsKBPlusBMMinusKG) {  // (H11)
  const Immersion im = immersion(box(10, 4, 3, 1.2), {});
  const double KB = 0.6, KG = 1.5;
  const Metacentre m = metacentre(im, {0, 0, KG - 1.2});
  EXPECT_NEAR(m.bm_transverse, 16 / (12 * 1.2), 1e-13);
  EXPECT_NEAR(m.gm_transverse, KB + 16 / (12 * 1.2) - KG, 1e-13);
  EXPECT_NEAR(m.gm_longitudinal, KB + 100 / (12 * 1.2) - KG, 1e-12);
  EXPECT_NEAR(m.gm_least, m.gm_transverse, 1e-13);
}

TEST(Metacentre, OfACylinderIsAQuarterOfItsRadiusSquaredOverItsDraught) {
  const Immersion im = immersion(Hull(cylinder_mesh({0, 0}, 3, -2, 4, 720)), {});
  const Metacentre m = metacentre(im, {0, 0, 0});
  EXPECT_NEAR(m.bm_transverse, 9 / 8.0, 3e-5);  // chords: α²/4 of it
  EXPECT_NEAR(m.gm_longitudinal, 9 / 8.0 - 1, 3e-5);
}

TEST(RightingArms, OfABoxFollowTheWallSidedFormulaUntilTheDeckOrTheBilgeMeetsTheSurface) {  // (H14)
  const double B = 4, T = 1.2, depth = 3, KG = 1.7;
  const Hull hull = box(10, B, depth, T);
  const double BM = B * B / (12 * T), GM = T / 2 + BM - KG;
  const double last = std::atan(2 * std::min(T, depth - T) / B) / degree;
  for (const auto& p : righting_arms(hull, {1000 * 48, {0, 0, KG - T}}, water, heels(last, 13)).arms) {
    const double t = std::tan(p.heel);
    EXPECT_NEAR(p.gz, std::sin(p.heel) * (GM + BM * t * t / 2), 1e-12) << p.heel / degree;
  }
}

TEST(RightingArms, OfABoxOnItsSideAndUpsideDownAreThoseOfTheTurnedBox) {
  const Hull hull = box(10, 4, 3, 1.2);
  const MassPoint body{48000, {0, 0.1, 0.5}};  // 0.1 m to port
  const auto arms = righting_arms(hull, body, water, {0, 90 * degree, 180 * degree}).arms;
  EXPECT_NEAR(arms[0].gz, 0.1, 1e-12);  // B at y = 0, G to port: turns port down, away from positive heel
  // On its side B is in the middle of its depth, at mesh z = 0.3; G is 0.2 m above that in mesh z, now to starboard.
  EXPECT_NEAR(arms[1].gz, -(0.5 - 0.3), 1e-12);
  EXPECT_NEAR(arms[2].gz, -0.1, 1e-12);
}

TEST(RightingArms, AddUpToTheEnergyOfTheHeeledHull) {  // (H13)
  const Hull hull = odd_hull();
  const MassPoint body{1000 * 0.45 * hull.volume(), {0.8, 0.2, -0.1}};
  for (const Trim trim : {Trim::fixed, Trim::free}) {
    constexpr int n = 241;
    const auto arms = righting_arms(hull, body, water, heels(40, n), trim, Angle::from_degrees(4)).arms;
    double area = 0;
    for (std::size_t i = 1; i < n; ++i)
      area += (arms[i].heel - arms[i - 1].heel) / 2 *
              (arms[i].gz * std::cos(arms[i].trim) + arms[i - 1].gz * std::cos(arms[i - 1].trim));
    // Trapezia of (1/6)°: 1e-6 of arms of 1 m with curvature of 1 m/rad².
    EXPECT_NEAR(arms.back().energy, area, 2e-6) << static_cast<int>(trim);
    EXPECT_GT(std::abs(area), 1e-2);
  }
}

TEST(RightingArms, WithFreeTrimHaveNoPitchingMoment) {
  const Hull hull = odd_hull();
  const MassPoint body{1000 * 0.45 * hull.volume(), {0.8, 0.2, -0.1}};
  for (const auto& p : righting_arms(hull, body, water, heels(30, 7), Trim::free).arms) {
    const Vector6 load = buoyancy(immersion(hull, p.pose), water, p.pose * body.centre);
    EXPECT_NEAR(load[2], body.mass * 9.81, 1e-9 * load[2]);
    EXPECT_LT(std::abs(load[4]), 1e-9 * load[2] * hull.diagonal());
  }
}

TEST(RightingArms, EndWhereWaterComesIn) {
  TriangleMesh open = box_mesh({-5, -2, -1.2}, {5, 2, 0.5});
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);
  const RightingCurve curve = righting_arms(Hull(open), {48000, {0, 0, 0}}, water, heels(40, 41));
  const double edge = std::atan(0.5 / 2) / degree;  // 14.04°
  EXPECT_EQ(curve.arms.size(), 1 + static_cast<std::size_t>(edge));
  EXPECT_THAT(curve.ended, HasSubstr("at 15°"));
}

TEST(Equilibrium, OfABoxWithItsWeightOffCentreIsTheWallSidedAngle) {  // (H12), (H14)
  const double B = 4, T = 1.2, KG = 1.1, offset = 0.05;
  const Hull hull = box(10, B, 3, T);
  const Equilibrium e = equilibrium(hull, {48000, {0, -offset, KG - T}}, water);
  ASSERT_TRUE(e.converged) << e.why;
  EXPECT_TRUE(e.stable);
  const double BM = B * B / (12 * T), GM = T / 2 + BM - KG, t = std::tan(e.heel);
  EXPECT_GT(e.heel, 0);                                  // weight to starboard: starboard goes down
  EXPECT_NEAR(t * (GM + BM * t * t / 2), offset, 1e-8);  // GZ sin form divided by cos φ
  EXPECT_NEAR(e.trim, 0, 1e-9);
}

TEST(Equilibrium, OfAnUnstableBoxIsItsAngleOfLoll) {  // (H14)
  const double B = 4, T = 1.2, KG = 1.85;
  const Hull hull = box(10, B, 3, T);
  const MassPoint body{48000, {0, 0, KG - T}};
  const double BM = B * B / (12 * T), GM = T / 2 + BM - KG;
  ASSERT_LT(GM, 0);
  const Equilibrium upright = equilibrium(hull, body, water);
  EXPECT_TRUE(upright.converged);
  EXPECT_FALSE(upright.stable);
  EXPECT_NEAR(upright.heel, 0, 1e-12);
  const Equilibrium loll = equilibrium(hull, body, water, attitude_of(Angle::from_degrees(-1), Angle::from_degrees(0)));
  ASSERT_TRUE(loll.converged) << loll.why;
  EXPECT_TRUE(loll.stable);
  EXPECT_NEAR(loll.heel, -std::atan(std::sqrt(-2 * GM / BM)), 1e-8);
}

TEST(Equilibrium, IsFoundFromAnywhereAndIsOne) {
  const Hull hull = odd_hull();
  const MassPoint body{1000 * 0.4 * hull.volume(), {0.3, 0.3, -0.8}};
  for (const double heel : {-40.0, 0.0, 25.0})
    for (const double trim : {-30.0, 10.0}) {
      const Equilibrium e =
          equilibrium(hull, body, water, attitude_of(Angle::from_degrees(heel), Angle::from_degrees(trim)));
      ASSERT_TRUE(e.converged) << e.why;
      EXPECT_TRUE(e.stable);
      EXPECT_LE(e.iterations, 15);
      const Vector3d G = e.pose * body.centre;
      const Vector6 load = buoyancy(immersion(hull, e.pose), water, G);
      EXPECT_NEAR(load[2], body.mass * 9.81, 1e-9 * load[2]);
      EXPECT_LT(load.tail<3>().norm(), 1e-9 * load[2] * hull.diagonal());
    }
}

TEST(Equilibrium, OfAHullInNeutralBalanceIsNotCalledStable) {
  const double KG = 0.6 + 16 / (12 * 1.2);  // GM = 0
  const Equilibrium e = equilibrium(box(10, 4, 3, 1.2), {48000, {0, 0, KG - 1.2}}, water);
  EXPECT_TRUE(e.converged);
  EXPECT_FALSE(e.stable);
}

}  // namespace
}  // namespace hydro::hydrostatics::stability_test
