#include "hydro/radiation/rational.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/potential/coefficients.hpp"
#include "support/random_passive.hpp"
#include "support/source_dir.hpp"
#include "support/two_pole_body.hpp"

namespace rational_test {
namespace {

using namespace hydro::radiation;
using testing::HasSubstr;
using testing::ThrowsMessage;

const support::TwoPoleBody body{};

/// Largest |K̂(model) + iω(A∞ given − A∞ fitted) − K̂(exact)| relative to √(max B_ii max B_jj), over `omegas`.
double error(const RationalFit& fit, const PoleModel& exact, const Eigen::MatrixXd& A_inf,
             const support::RadiationData& data, const std::vector<double>& omegas) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(exact.modes());
  for (const auto& B : data.damping.B) largest = largest.cwiseMax(B.diagonal());
  const Eigen::VectorXd scale = largest.cwiseSqrt().cwiseInverse();
  double worst = 0;
  for (const double omega : omegas) {
    const Eigen::MatrixXcd off =
        fit.model.transform(omega) - exact.transform(omega) + std::complex<double>(0, omega) * (fit.A_inf - A_inf);
    worst = std::max(worst, (scale.asDiagonal() * off.cwiseAbs() * scale.asDiagonal()).maxCoeff());
  }
  return worst;
}

TEST(RationalFit, FindsTheTwoPolesOfABodyThatHasTwo) {
  const auto table = body.damping_table(8, 80, 2);
  const auto fit =
      hydro::radiation::fit(table, body.added_mass(table, 7), Eigen::MatrixXd(7 * Eigen::MatrixXd::Identity(2, 2)));
  ASSERT_EQ(fit.report.order, 2) << fit.report.why;
  // The loosely followed tail beyond 8 rad/s is not the body's own and pulls by some 1e-6.
  EXPECT_NEAR(fit.model.poles[0].decay, body.decay, 1e-5);
  EXPECT_NEAR(fit.model.poles[0].omega, body.frequency, 1e-5);
  EXPECT_TRUE(fit.report.passive);
  for (const double t : {0.0, 1.0, 3.0, 8.0}) EXPECT_NEAR(fit.model.kernel(t)(0, 0), body.K(t), 1e-4) << t;
}

// Moored bodies feel damping where there is next to none. Five modules that exchange waves, by their damping in surge
// of all together, which has no resonance to hide behind.
TEST(RationalFit, IsNearerWhereSlowMotionsFeelLittleDamping) {
  const auto c = hydro::potential::read(froude_test::source_dir() / "examples/data/modules5.h5");
  hydro::radiation::DampingTable damping{c.omega, {}};
  std::vector<Eigen::MatrixXd> A;
  for (std::size_t k = 0; k < c.omega.size(); ++k) {
    damping.B.push_back((c.B[k] + c.B[k].transpose()) / 2);
    A.push_back((c.A[k] + c.A[k].transpose()) / 2);
  }
  const auto fit = hydro::radiation::fit(damping, A, c.A_inf, {.tolerance = 1e-2});
  EXPECT_LT(fit.report.error, 1e-2);
  Eigen::VectorXd surge = Eigen::VectorXd::Zero(c.modes());
  for (int mode = 0; mode < c.modes(); mode += 6) surge[mode] = 1;
  double largest = 0;
  for (const auto& B : damping.B) largest = std::max(largest, surge.dot(B * surge));
  for (std::size_t k = 0; c.omega[k] < 0.6; ++k) {
    const double off = surge.dot((fit.model.transform(c.omega[k]).real() - damping.B[k]) * surge);
    // A fifth of the tolerance. Were all frequencies alike, it would be nearly all of it at the first.
    EXPECT_LT(std::abs(off), 2e-3 * largest) << c.omega[k] << " rad/s";
  }
}

// (R12): nothing at ω = 0, K(0)/iω far out, symmetric.
TEST(RationalFit, HasTheLimitsOfARadiatingBodyBuiltIn) {
  const auto exact = support::random_passive(3, 4, 5);
  const auto data = support::data_of(exact, 6, 60);
  const auto fit = hydro::radiation::fit(data.damping, data.A, data.A_inf, {.tolerance = 1e-2});
  const double size = exact.transform(1).cwiseAbs().maxCoeff();
  EXPECT_LT(fit.model.transform(0).cwiseAbs().maxCoeff(), 1e-9 * size);
  const double far = 1e5;
  const Eigen::MatrixXcd at_far = fit.model.transform(far) * std::complex<double>(0, far);
  EXPECT_LT((at_far - fit.model.kernel(0)).cwiseAbs().maxCoeff(), 1e-3 * fit.model.kernel(0).cwiseAbs().maxCoeff());
  for (const double t : {0.0, 0.7})
    EXPECT_LT((fit.model.kernel(t) - fit.model.kernel(t).transpose()).norm(), 1e-9 * size);
  for (const Pole& p : fit.model.poles) EXPECT_GT(p.decay, 0);
}

/// Smallest eigenvalue of the fitted damping, scaled, over a fine grid from next to rest to far beyond the data.
double smallest_damping(const PoleModel& m, const Eigen::VectorXd& scale) {
  double lowest = std::numeric_limits<double>::infinity();
  for (double omega = 1e-3; omega < 1e3; omega *= 1.004) {
    const Eigen::MatrixXd B = scale.asDiagonal() * m.transform(omega).real() * scale.asDiagonal();
    lowest =
        std::min(lowest, Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(B, Eigen::EigenvaluesOnly).eigenvalues()[0] /
                             std::min(1.0, omega * omega));
  }
  return lowest;
}

class RandomBodies : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomBodies, AreFittedWithinTheToleranceAndCannotGiveEnergy) {
  const int modes = 1 + static_cast<int>(GetParam() % 5), pairs = 2 + static_cast<int>(GetParam() % 4);
  const auto exact = support::random_passive(GetParam(), modes, pairs);
  const auto data = support::data_of(exact, 8, 80);
  const auto fit = hydro::radiation::fit(data.damping, data.A, data.A_inf, {.tolerance = 1e-2});
  EXPECT_LE(fit.report.error, 1e-2) << fit.report.why;
  EXPECT_LE(error(fit, exact, data.A_inf, data, data.damping.omega), fit.report.error * (1 + 1e-6))
      << "the report's error is what the model has";
  // Halfway between the data the error may be a little larger: the poles are at least three spacings from the axis.
  std::vector<double> between;
  for (const double omega : data.damping.omega) between.push_back(omega - 0.05);
  EXPECT_LE(error(fit, exact, data.A_inf, data, between), 3e-2);
  ASSERT_TRUE(fit.report.passive);
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(modes);
  for (const auto& B : data.damping.B) largest = largest.cwiseMax(B.diagonal());
  EXPECT_GE(smallest_damping(fit.model, largest.cwiseSqrt().cwiseInverse()), 0) << "certified";
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomBodies, testing::Range<std::uint64_t>(0, 20));

TEST(RationalFit, MakesNoisyDataPassiveAndSaysWhatThatCost) {
  const auto exact = support::random_passive(11, 3, 3);
  auto data = support::data_of(exact, 5, 50);
  const hydro::RandomStream random(5, 1);
  double largest = 0;
  for (const auto& B : data.damping.B) largest = std::max(largest, B.diagonal().maxCoeff());
  std::uint64_t next = 0;
  for (auto& B : data.damping.B)
    for (int i = 0; i < 3; ++i) B(i, i) += 5e-3 * B(i, i) * random.normal(next++) - 1e-3 * largest;
  const auto fit = hydro::radiation::fit(data.damping, data.A, data.A_inf, {.tolerance = 1e-3});
  EXPECT_TRUE(fit.report.passive);
  EXPECT_LT(fit.report.most_negative, 0);
  // Nothing is free: the sum of squares grows. The largest error, which is reported, may fall as well as rise.
  EXPECT_NE(fit.report.error, fit.report.error_before);
  EXPECT_LT(fit.report.error, 5e-2) << "noise of 5e-3, three sigma and more, and what it costs to be passive";
  EXPECT_THAT(fit.report.why, HasSubstr("no order up to"));
}

// (R27): two modes of damping 0.1 of their largest that feel each other by 0.2 of it give energy to a motion in which
// both go against each other; entries off by (0.2² − 0.1²)/(0.1 + 0.1 + 2·0.2) = 0.05 would not.
TEST(RationalFit, SaysByHowMuchDataThatGiveEnergyAreMissed) {
  const auto exact = support::random_passive(11, 2, 2);
  auto data = support::data_of(exact, 5, 50);
  Eigen::Vector2d largest = Eigen::Vector2d::Zero();
  for (const auto& B : data.damping.B) largest = largest.cwiseMax(B.diagonal());
  const Eigen::Vector2d scale = largest.cwiseSqrt();
  const std::size_t at = 30;
  data.damping.B[at] = scale.asDiagonal() * Eigen::Matrix2d{{0.1, 0.2}, {0.2, 0.1}} * scale.asDiagonal();
  const auto within = [&](double tolerance) {
    return hydro::radiation::fit(data.damping, data.A, data.A_inf, {.tolerance = tolerance, .largest_order = 8}).report;
  };
  const auto report = within(0.049);
  EXPECT_TRUE(report.passive);
  EXPECT_GE(report.error, 0.05 - 1e-12) << "no passive model comes nearer, but for rounding";
  EXPECT_THAT(report.why, HasSubstr(fmt::format("would give energy at {:.3g} rad/s", data.damping.omega[at])));
  EXPECT_THAT(report.why, HasSubstr("no passive model comes nearer than 0.05 "));
  EXPECT_THAT(within(0.051).why, testing::Not(HasSubstr("would give energy"))) << "a tolerance that may be met";
}

// (R27): three modes whose damping is w(I − vvᵀ) with v = (1, 1, 1)/√3, and −0.03 of their largest along v where they
// make waves: 0.03/(Σ|v|)² = 0.01 keeps every passive model away, while any two of the three take energy from each
// motion. The nearest damping that gives none is as far, 0.03/3, and fits go there.
TEST(RationalFit, GoesToTheNearestDampingThatGivesNoEnergy) {
  auto exact = support::random_passive(11, 3, 2);
  const Eigen::Matrix3d along = Eigen::Matrix3d::Constant(1.0 / 3), across = Eigen::Matrix3d::Identity() - along;
  for (std::size_t k = 0; k < exact.poles.size(); ++k) {
    exact.C[k] = across;
    exact.S[k] = -exact.poles[k].decay / exact.poles[k].omega * across;
  }
  auto data = support::data_of(exact, 5, 50);
  double largest = 0;
  for (const auto& B : data.damping.B) largest = std::max(largest, B(0, 0));
  for (auto& B : data.damping.B)
    if (B(0, 0) > 0.3 * largest) B -= 0.03 * largest * along;
  const auto report = hydro::radiation::fit(data.damping, data.A, data.A_inf, {.tolerance = 1e-3}).report;
  EXPECT_TRUE(report.passive);
  EXPECT_THAT(report.why, HasSubstr("no passive model comes nearer than 0.01 "));
  EXPECT_GE(report.error, 0.01) << "the largest damping is 0.99 of what it was, and the floor that much higher";
  EXPECT_LT(report.error, 0.015) << "that, and what passive models between the data and a margin cost";
}

// As of a hull with a plane of symmetry, whose modes of one kind move those of the other by what its data's last digits
// make of nothing. What is above a thousandth of the tolerance is data, not round-off.
TEST(RationalFit, TakesModesApartThatDoNotMoveEachOther) {
  for (const bool coupled : {false, true}) {
    const auto exact = support::random_passive(3, 4, 4);
    auto data = support::data_of(exact, 6, 60);
    Eigen::VectorXd largest = Eigen::VectorXd::Zero(4);
    for (const auto& B : data.damping.B) largest = largest.cwiseMax(B.diagonal());
    for (std::size_t k = 0; k < data.A.size(); ++k)
      for (const int i : {0, 2})
        for (const int j : {1, 3}) {
          const double size = std::sqrt(largest[i] * largest[j]), sign = k % 2 == 0 ? 1 : -1;
          data.damping.B[k](i, j) = data.damping.B[k](j, i) =
              coupled ? 1e-3 * data.damping.B[k](i, j) : 1e-6 * sign * size;
          data.A[k](i, j) = data.A[k](j, i) = coupled ? 1e-3 * data.A[k](i, j) : 0;
        }
    const auto fit = hydro::radiation::fit(data.damping, data.A, data.A_inf, {.tolerance = 1e-2});
    EXPECT_LE(fit.report.error, 1e-2);
    EXPECT_TRUE(fit.report.passive);
    EXPECT_GE(smallest_damping(fit.model, largest.cwiseSqrt().cwiseInverse()), 0) << "of all four, not only by twos";
    double between = 0;
    for (const double t : {0.0, 0.5, 2.0})
      between = std::max({between, std::abs(fit.model.kernel(t)(0, 1)), std::abs(fit.model.kernel(t)(2, 3))});
    EXPECT_EQ(between > 0, coupled);
  }
}

TEST(RationalFit, LeavesOutModesThatMakeNoWaves) {
  auto table = body.damping_table(8, 80, 3);
  auto A = body.added_mass(table, 7);
  for (auto& B : table.B) B(1, 1) = 0;
  for (auto& a : A) a(1, 1) = 3;
  const auto fit = hydro::radiation::fit(table, A, std::nullopt);
  EXPECT_EQ(fit.model.kernel(0.5).row(1).norm(), 0);
  EXPECT_NEAR(fit.A_inf(1, 1), 3, 1e-9);
  EXPECT_NEAR(fit.A_inf(0, 0), 7, 1e-2);  // not given: found with the fit
  EXPECT_TRUE(fit.report.passive);
}

TEST(RationalFit, NeedsDataThatBelongTogether) {
  const auto table = body.damping_table(8, 80);
  EXPECT_THROW(hydro::radiation::fit(table, {}, std::nullopt), hydro::InputError);
  const auto few = body.damping_table(8, 3);
  EXPECT_THAT([&] { hydro::radiation::fit(few, body.added_mass(few, 7), std::nullopt); },
              ThrowsMessage<hydro::InputError>(HasSubstr("four frequencies")));
  auto negative = table;
  negative.B[20](0, 0) = -1;
  EXPECT_THAT([&] { hydro::radiation::fit(negative, body.added_mass(table, 7), std::nullopt); },
              ThrowsMessage<hydro::InputError>(HasSubstr("source of power")));
}

}  // namespace
}  // namespace rational_test
