#include "dynamics/spatial/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rotation_test {
namespace {

using namespace dynamics;
using Eigen::Matrix3d;
using Eigen::Vector3d;

const Vector3d directions[] = {Vector3d(1, 0, 0), Vector3d(0.6, 0, 0.8), Vector3d(-1, 2, 3).normalized()};
const double angles[] = {0, 1e-9, 5e-4, 2e-3, 0.009, 0.011, 0.3, 1.5, 3.0};

TEST(Rotation, LogUndoesExpUpToHalfATurn) {
  for (const auto& n : directions)
    for (const double a : angles)
      EXPECT_LT((rotation_log(rotation_exp(a * n)) - a * n).norm(), 1e-13 + 1e-12 * a)
          << a;  // 1e-12: series cut at s⁴ for s < 1e-3
}

TEST(Rotation, ExpTurnsAboutItsAxisByItsLength) {
  const Matrix3d R = rotation_exp(Vector3d(0, 0, std::numbers::pi / 2)).toRotationMatrix();
  EXPECT_LT((R * Vector3d(1, 0, 0) - Vector3d(0, 1, 0)).norm(), 1e-15);  // x towards y about z: right-handed
}

// (D1): exp((φ + ε dφ)) = exp(ε J dφ) exp(φ) to first order; the derivative by central differences, error ε²/6 +
// 1e-16/ε.
TEST(Rotation, LeftJacobianIsTheDerivativeOfExp) {
  constexpr double e = 1e-5;
  for (const auto& n : directions)
    for (const double a : angles) {
      const Vector3d phi = a * n, d(0.3, -0.5, 0.8);
      const Vector3d turned = rotation_log(rotation_exp(phi + e * d) * rotation_exp(phi - e * d).conjugate()) / (2 * e);
      EXPECT_LT((left_jacobian(phi) * d - turned).norm(), 1e-9) << a;
    }
}

TEST(Rotation, LeftJacobianTimesItsInverseIsOne) {
  for (const auto& n : directions)
    for (const double a : angles)
      EXPECT_LT((left_jacobian(a * n) * left_jacobian_inverse(a * n) - Matrix3d::Identity()).norm(), 1e-9)
          << a;  // cancellation 1e-16/a² just above 1e-3
}

TEST(Rotation, DerivativeOfTheTransposedInverseIsThatOfDifferences) {
  constexpr double e = 1e-5;
  const Vector3d m(2, -1, 0.5);
  for (const auto& n : directions)
    for (const double a : {0.0, 0.005, 0.02, 0.5, 2.0}) {
      const Vector3d phi = a * n, d(0.3, -0.5, 0.8);
      const Vector3d difference =
          (left_jacobian_inverse(phi + e * d).transpose() * m - left_jacobian_inverse(phi - e * d).transpose() * m) /
          (2 * e);
      EXPECT_LT((left_jacobian_inverse_transpose_derivative(phi, m) * d - difference).norm(), 1e-7)
          << a;  // c(a) loses 1e-16/a² near 1e-3, divided by e
    }
}

TEST(Rotation, AnglesOfAnAttitudeGiveItBack) {
  for (const double yaw : {0.0, 1.0, -2.5})
    for (const double roll : {0.0, -0.4, 3.0})
      for (const double pitch :
           {0.0, 1.2, std::numbers::pi / 2, -std::numbers::pi / 2, std::numbers::pi / 2 - 1e-9, 2.9})
        for (const Vector3d& near : {Vector3d(0, 0, 0), Vector3d(roll, pitch, yaw), Vector3d(7, -8, 9)}) {
          const Eigen::Quaterniond q = attitude_of({roll, pitch, yaw});
          const Vector3d found = roll_pitch_yaw(q, near);
          EXPECT_LT(q.angularDistance(attitude_of(found)), 1e-8) << "1e-9 from the pole roll and yaw are one angle";
          const Vector3d given(roll, pitch, yaw);
          EXPECT_LE((found - near).norm(), (given - near).norm() + 1e-7) << "given, or nearer: " << found.transpose();
        }
}

TEST(Rotation, AnglesOfAnAttitudeRunOnThroughQuarterAndWholeTurns) {
  const Vector3d held(0.3, 0, -0.7);
  for (int mode = 0; mode < 3; ++mode) {
    Vector3d last = held;
    for (int i = 1; i <= 1000; ++i) {
      Vector3d now = held;
      now[mode] += 2 * std::numbers::pi * i / 100;  // meets the poles, and every quarter of ten turns
      last = roll_pitch_yaw(attitude_of(now), last);
      ASSERT_LT((last - now).norm(), 1e-9) << mode << " at " << now.transpose();
    }
  }
}

}  // namespace
}  // namespace rotation_test
