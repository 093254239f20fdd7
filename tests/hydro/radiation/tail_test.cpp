#include "hydro/radiation/tail.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "hydro/base/error.hpp"
#include "support/two_pole_body.hpp"

namespace tail_test {
namespace {

using namespace hydro::radiation;

const support::TwoPoleBody body{};
constexpr double A_inf = 7.0;

std::vector<Eigen::MatrixXd> added_mass(const DampingTable& table) {
  std::vector<Eigen::MatrixXd> A;
  for (const double w : table.omega) A.push_back(Eigen::MatrixXd::Constant(1, 1, A_inf + body.A_minus_A_inf(w)));
  return A;
}

/// A(ω) − A∞ and B(ω) as the kernel of a table has them, by sums over 60 s of it.
std::pair<double, double> transform(const DampingTable& table, double omega) {
  double sine = 0, cosine = 0;
  constexpr double h = 0.02;
  for (int i = 0; i < 3000; ++i) {
    const double K = retardation(table, h * i)(0, 0) * (i == 0 ? h / 2 : h);
    sine += K * std::sin(omega * h * i);
    cosine += K * std::cos(omega * h * i);
  }
  return {-sine / omega, cosine};
}

// (R10): cut at 2 rad/s, where a sixth of B at the peak is left, the kernel alone misses part of A(ω); extrapolated, it
// has it back.
TEST(ExtrapolatedDamping, BringsBackTheAddedMassThatACutTableLoses) {
  const auto cut = body.damping_table(2, 40);
  const auto whole = extrapolated(cut, added_mass(cut), Eigen::MatrixXd::Constant(1, 1, A_inf));
  for (const double omega : {0.4, 0.8, 1.3}) {
    const double exact = body.A_minus_A_inf(omega);
    // Of the part lost, (2/π)∫_2^∞ B/(ν²−ω²) dν = 0.03 to 0.05, a tenth remains: corners of a polygon, spacing of the
    // table.
    EXPECT_NEAR(transform(whole.table, omega).first, exact, 5e-3) << omega;
    EXPECT_GT(std::abs(transform(cut, omega).first - exact), 1.5e-2) << omega;
    EXPECT_NEAR(transform(whole.table, omega).second, body.B(omega), 0.01) << omega;
  }
  EXPECT_LT(whole.misfit, 2e-3);
}

// (R10), (R21): causality ties added mass and damping together, both ways.
TEST(KramersKronig, GivesAddedMassFromDampingAndDampingFromAddedMass) {
  const auto table = body.damping_table(20, 500);
  for (const double omega : {0.42, 1.1, 1.14, 2.5}) {
    // Beyond 20 rad/s lie (2/π)∫2a/ν⁴ = 2e-5; pieces of 0.01 rad/s bend by B″h²/12 = 1e-4.
    EXPECT_NEAR(added_mass_above_limit(table, omega)(0, 0), body.A_minus_A_inf(omega), 1e-3) << omega;
    // The first value of A is kept below 0.04 rad/s, and 1/3·20³ is left out beyond 20.
    EXPECT_NEAR(
        damping_from_added_mass(table.omega, added_mass(table), Eigen::MatrixXd::Constant(1, 1, A_inf), omega)(0, 0),
        body.B(omega), 5e-3)
        << omega;
  }
  EXPECT_THROW(damping_from_added_mass(table.omega, added_mass(table), Eigen::MatrixXd::Constant(1, 1, A_inf), 25),
               hydro::InputError);
}

TEST(ExtrapolatedDamping, FindsTheLimitThatDataLack) {
  const auto cut = body.damping_table(4, 80);
  const auto whole = extrapolated(cut, added_mass(cut), std::nullopt);
  EXPECT_NEAR(whole.A_inf(0, 0), A_inf,
              0.01);  // of a range of A of 3: constant and far tail look alike from inside the table
}

TEST(ExtrapolatedDamping, AddsNextToNothingWhereTheDampingHasDiedAway) {
  const auto table = body.damping_table(30, 600);
  const auto whole = extrapolated(table, added_mass(table), Eigen::MatrixXd::Constant(1, 1, A_inf));
  // B(30) = 2a/30² = 7e-4; the true tail goes on from there.
  for (std::size_t i = table.omega.size(); i < whole.table.omega.size(); ++i)
    EXPECT_LT(std::abs(whole.table.B[i](0, 0)), 2e-3);
  EXPECT_NEAR(whole.table.omega.back(), 120, 1e-9);
  EXPECT_EQ(whole.table.B.back()(0, 0), 0);
}

TEST(ExtrapolatedDamping, NoticesThatAddedMassAndDampingDoNotBelongTogether) {
  const auto table = body.damping_table(4, 80);
  auto A = added_mass(table);
  for (auto& a : A) a(0, 0) = 2 * A_inf - a(0, 0);
  EXPECT_GT(extrapolated(table, A, Eigen::MatrixXd::Constant(1, 1, A_inf)).misfit, 0.05);
}

TEST(ExtrapolatedDamping, NeedsAddedMassAtEveryFrequency) {
  const auto table = body.damping_table(4, 80);
  EXPECT_THROW(extrapolated(table, {}, std::nullopt), hydro::InputError);
}

}  // namespace
}  // namespace tail_test
