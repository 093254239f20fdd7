#include "hydro/potential/doctor/check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "smooth_body.hpp"

namespace check_test {
namespace {

using hydro::potential::check;
using hydro::potential::Coefficients;
using hydro::potential::Finding;
using hydro::potential::Severity;
using ::testing::HasSubstr;

/// Two bodies with symmetric A and positive B, about which nothing is to be said. Rotations are 100 times as large.
/// Loads and restoring are left out: those of a formula are no hull's.
Coefficients sound() {
  auto c = froude_test::SmoothBody{.bodies = 2}.coefficients({}, {0.5, 1.0, 2.0}, {});
  c.C.reset();
  Eigen::MatrixXd S = Eigen::MatrixXd::Constant(12, 12, 0.1) + Eigen::MatrixXd::Identity(12, 12);
  const Eigen::VectorXd size = (Eigen::VectorXd(12) << 1, 2, 3, 100, 200, 300, 1, 2, 3, 100, 200, 300).finished();
  S = (size.asDiagonal() * S * size.asDiagonal()).eval();
  for (std::size_t k = 0; k < 3; ++k) {
    c.A[k] = S * (2.0 + double(k));
    c.B[k] = S * (1.0 - 0.25 * double(k));
  }
  c.A_zero = c.A_inf = S;
  return c;
}

Finding found(const Coefficients& c, const std::string& name) {
  for (const Finding& f : check(c))
    if (f.check == name) return f;
  ADD_FAILURE() << "no finding " << name;
  return {};
}

TEST(Check, RecordsANoteOfEachCheckWhereAllIsWell) {
  const auto findings = check(sound());
  ASSERT_EQ(findings.size(), hydro::potential::check_names().size());
  for (const Finding& f : findings) EXPECT_EQ(f.severity, Severity::note) << f.check << ": " << f.message;
}

TEST(Check, MeasuresAsymmetryByTheTwoModesItCouples) {
  // (P11): entries between translation and rotation are as large as sqrt(A_ii A_jj), whatever the units
  auto c = sound();
  const double own = std::sqrt(c.A[2](0, 0) * c.A[2](4, 4));
  c.A[1](0, 4) += 0.015 * own;
  EXPECT_EQ(found(c, "symmetry of A").severity, Severity::note);
  c.A[1](0, 4) += 0.015 * own;
  const Finding f = found(c, "symmetry of A");
  EXPECT_EQ(f.severity, Severity::warning);
  EXPECT_THAT(f.where, HasSubstr("A(1, 5) at 1 rad/s: surge of body 1 and pitch of body 1"));
  EXPECT_THAT(f.message, HasSubstr("0.03"));
  EXPECT_FALSE(f.remedy.empty());
}

TEST(Check, DoesNotDependOnUnits) {
  auto c = sound();
  for (auto* M : {&c.A[0], &c.B[0]}) {  // within a body and between two
    (*M)(1, 4) *= 1.2;
    (*M)(2, 9) *= 1.5;
  }
  c.B[2](8, 8) *= -1;
  const auto before = check(c);
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(12);
  for (const Eigen::Index i : {3, 4, 5, 9, 10, 11}) scale(i) = 1e-3;  // kilometres
  for (auto* list : {&c.A, &c.B})
    for (auto& m : *list) m = (scale.asDiagonal() * m * scale.asDiagonal()).eval();
  for (auto* m : {&*c.A_zero, &*c.A_inf}) *m = (scale.asDiagonal() * *m * scale.asDiagonal()).eval();
  const auto after = check(c);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(before[i].message, after[i].message);
}

TEST(Check, LooksAtTheLimitsToo) {
  auto c = sound();
  (*c.A_inf)(0, 1) *= 3;
  EXPECT_THAT(found(c, "symmetry of A").where, HasSubstr("infinite frequency"));
}

TEST(Check, DoesNotDivideNoiseByItself) {
  auto c = sound();
  for (auto* list : {&c.A, &c.B})
    for (auto& m : *list) {
      for (const Eigen::Index i : {5, 11}) m.row(i) = m.col(i).transpose() *= 0;  // no yaw, as of a body of revolution
      m(0, 5) = 1e-9;
      m(5, 0) = -1e-9;
    }
  for (auto* m : {&*c.A_zero, &*c.A_inf})
    for (const Eigen::Index i : {5, 11}) m->row(i) = m->col(i).transpose() *= 0;
  EXPECT_EQ(found(c, "symmetry of A").severity, Severity::note);
  EXPECT_EQ(found(c, "symmetry of B").severity, Severity::note);
}

TEST(Check, GradesNegativeDampingByItsSize) {
  const auto with = [](double relative) {
    auto c = sound();
    c.B[2](8, 8) = -relative * c.B[0](8, 8);
    return found(c, "sign of B");
  };
  EXPECT_EQ(with(1e-12).severity, Severity::note);
  EXPECT_EQ(with(0.02).severity, Severity::warning);
  const Finding f = with(0.1);
  EXPECT_EQ(f.severity, Severity::error);
  EXPECT_THAT(f.where, HasSubstr("B(9, 9) at 2 rad/s: heave of body 2"));
  EXPECT_THAT(f.message, HasSubstr("negative by 0.1"));
}

TEST(Check, AllowsNegativeDampingWithinTheDatasOwnAsymmetry) {
  auto c = sound();
  const double own = std::sqrt(c.B[0](0, 0) * c.B[0](1, 1));
  c.B[0](0, 1) += 0.008 * own;
  c.B[2](8, 8) = -0.005 * c.B[0](8, 8);
  EXPECT_EQ(found(c, "sign of B").severity, Severity::note);
}

TEST(Check, SeesAnIndefiniteMatrixWithAPositiveDiagonal) {
  auto c = sound();
  c.B[1](0, 1) = c.B[1](1, 0) = 1.5 * std::sqrt(c.B[1](0, 0) * c.B[1](1, 1));
  EXPECT_EQ(found(c, "sign of B").severity, Severity::note);
  const Finding f = found(c, "passivity of B");
  EXPECT_EQ(f.severity, Severity::warning);
  EXPECT_THAT(f.where, HasSubstr("1 rad/s"));
}

TEST(Check, MissesALimitThatIsAbsent) {
  auto c = sound();
  c.A_zero.reset();
  c.A_inf.reset();
  EXPECT_EQ(found(c, "limit at zero").severity, Severity::note);
  EXPECT_THAT(found(c, "limit at zero").message, HasSubstr("absent"));
  EXPECT_EQ(found(c, "limit at infinity").severity, Severity::warning);
}

}  // namespace
}  // namespace check_test
