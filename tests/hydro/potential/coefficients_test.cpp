#include "hydro/potential/coefficients.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <limits>

#include "hydro/base/error.hpp"
#include "smooth_body.hpp"

namespace coefficients_test {
namespace {

using Eigen::Vector3d;
using hydro::InputError;
using hydro::potential::Coefficients;
using hydro::potential::Matrix6;
using hydro::potential::rigid_shift;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(RigidShift, GivesTheVelocityOfARotatingBodyElsewhere) {
  // (P4): v(P + r) = v(P) + ω × r
  const Vector3d r(1, 2, 3), v(4, 5, 6), spin(0.7, -0.8, 0.9);
  Eigen::Matrix<double, 6, 1> at_P;
  at_P << v, spin;
  Eigen::Matrix<double, 6, 1> expected;
  expected << v + spin.cross(r), spin;
  EXPECT_LT((rigid_shift(r) * at_P - expected).norm(), 1e-14);  // a few roundings of numbers near 10
}

TEST(RigidShift, MovesLoadsByItsTransposeAndKeepsTheirPower) {
  const Vector3d r(-2, 0.5, 4);
  Eigen::Matrix<double, 6, 1> force_at_Pr, v_at_P;
  force_at_Pr << 1, -2, 3, 10, 20, -30;
  v_at_P << 0.1, 0.2, 0.3, -0.4, 0.5, 0.6;
  const auto T = rigid_shift(r);
  const Eigen::Matrix<double, 6, 1> force_at_P = T.transpose() * force_at_Pr;
  const Vector3d F = force_at_Pr.head<3>(), M = force_at_Pr.tail<3>();
  EXPECT_LT((force_at_P.tail<3>() - (M + r.cross(F))).norm(), 1e-13);
  EXPECT_NEAR(force_at_P.dot(v_at_P), force_at_Pr.dot(T * v_at_P), 1e-13);
}

TEST(RigidShift, IsAGroup) {
  const Vector3d a(1, -2, 3), b(0.5, 7, -1);
  EXPECT_LT((rigid_shift(a) * rigid_shift(b) - rigid_shift(a + b)).norm(), 1e-15);
  EXPECT_LT((rigid_shift(a) * rigid_shift(-a) - Matrix6::Identity()).norm(), 1e-15);
}

TEST(RigidShift, TurnsTheMassOfAPointIntoItsInertia) {
  // m at P + r, seen from P: the textbook matrix of a point mass
  const double m = 3;
  const Vector3d r(1, 2, 3);
  Matrix6 M = Matrix6::Zero();
  M.topLeftCorner<3, 3>().setIdentity();
  M *= m;
  const auto T = rigid_shift(r);
  const Matrix6 at_P = T.transpose() * M * T;
  EXPECT_DOUBLE_EQ(at_P(3, 3), m * (4 + 9));
  EXPECT_DOUBLE_EQ(at_P(3, 4), -m * 1 * 2);
  EXPECT_DOUBLE_EQ(at_P(0, 4), m * 3) << "surge of the mass by pitch about P is z";
  EXPECT_DOUBLE_EQ(at_P(1, 3), -m * 3) << "sway by roll is −z";
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Coefficients sound() {
  auto c = froude_test::SmoothBody{}.coefficients({}, {0.5, 1.0}, {0.0, 0.5});
  c.source = "data.x";
  return c;
}

template <class Spoil>
void expect_refused(Spoil spoil, const char* rule) {
  Coefficients c = sound();
  spoil(c);
  EXPECT_THAT([&] { c.validate(); }, ThrowsMessage<InputError>(::testing::AllOf(HasSubstr("data.x"), HasSubstr(rule))));
}

TEST(Coefficients, AreAcceptedWhenSound) { EXPECT_NO_THROW(sound().validate()); }

TEST(Coefficients, AreRefusedWithTheSourceAndTheRule) {
  expect_refused([](Coefficients& c) { c.body.clear(); }, "no body");
  expect_refused([](Coefficients& c) { c.omega[1] = c.omega[0]; }, "frequencies must increase");
  expect_refused([](Coefficients& c) { c.omega[0] = 0; }, "finite and positive");
  expect_refused([](Coefficients& c) { c.heading[1] = -1; }, "headings must increase");
  expect_refused([](Coefficients& c) { c.A.pop_back(); }, "1 matrices A");
  expect_refused([](Coefficients& c) { c.A[1].resize(5, 6); }, "(5, 6)");
  expect_refused([](Coefficients& c) { c.B[0](2, 1) = not_a_number; }, "B at 0.5 rad/s is not finite at (3, 2)");
  expect_refused(
      [](Coefficients& c) {
        c.X[1](4, 0) = {0, not_a_number};
      },
      "X at heading 0.5 rad is not finite at (5, 1)");
  expect_refused([](Coefficients& c) { c.X.pop_back(); }, "2 headings");
  expect_refused([](Coefficients& c) { (*c.A_inf)(0, 0) = not_a_number; }, "infinite frequency");
  expect_refused([](Coefficients& c) { (*c.C)(0, 0) = not_a_number; }, "C is not finite");
  expect_refused([](Coefficients& c) { c.water.density = 0; }, "density must be positive");
  expect_refused([](Coefficients& c) { c.body[0].reference_point = Vector3d(0, not_a_number, 0); }, "reference point");
  expect_refused([](Coefficients& c) { c.body[0].displaced_volume = -1; }, "displaced volume");
}

}  // namespace
}  // namespace coefficients_test
