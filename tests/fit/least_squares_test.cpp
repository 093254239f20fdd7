#include "fit/least_squares.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace least_squares_test {
namespace {

using fit::ResidualModel;
using fit::SearchReport;
using testing::HasSubstr;

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::uint64_t stream) {
  const hydro::RandomStream random(41, stream);
  Eigen::MatrixXd m(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < columns; ++j) m(i, j) = random.normal(static_cast<std::uint64_t>(i * columns + j));
  return m;
}

ResidualModel linear(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  ResidualModel model{{}, a.rows(), [a, b](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
                        r = a * x - b;
                        if (jacobian != nullptr) *jacobian = a;
                      }};
  for (Eigen::Index j = 0; j < a.cols(); ++j) model.parameters.push_back({"p" + std::to_string(j), 1});
  return model;
}

TEST(LeastSquares, SolvesALinearProblemAsTheNormalEquationsDo) {
  const Eigen::MatrixXd a = random_matrix(50, 3, 0);
  const Eigen::VectorXd b = random_matrix(50, 1, 1);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(3);
  const SearchReport report = fit::minimise(linear(a, b), x);
  EXPECT_EQ(report.outcome, SearchReport::Outcome::converged) << report.why;
  const Eigen::MatrixXd inverse = (a.transpose() * a).inverse();
  EXPECT_LT((x - inverse * a.transpose() * b).norm(), 1e-12);  // rounding times a condition number of about 2
  EXPECT_LT((report.covariance - inverse).norm(), 1e-14);
  EXPECT_NEAR(report.cost_last, 0.5 * (a * x - b).squaredNorm(), 1e-12);
  EXPECT_LT(report.cost_last, report.cost_first);
  EXPECT_EQ(report.identifiability, "every parameter is seen by the data");
}

TEST(LeastSquares, FindsTheKnownMinimumOfRosenbrocksValley) {
  ResidualModel model{
      {{"x", 1}, {"y", 1}}, 2, [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
        r << 10 * (x[1] - x[0] * x[0]), 1 - x[0];
        if (jacobian != nullptr) *jacobian << -20 * x[0], 10, -1, 0;
      }};
  Eigen::VectorXd x(2);
  x << -1.2, 1;
  const auto report = fit::minimise(model, x);
  EXPECT_EQ(report.outcome, SearchReport::Outcome::converged) << report.why;
  EXPECT_NEAR(x[0], 1, 1e-10);
  EXPECT_NEAR(x[1], 1, 1e-10);
  EXPECT_LT(report.gradient_norm, 1e-10);
}

TEST(LeastSquares, NamesTheDirectionThatTheDataDoNotSee) {
  Eigen::MatrixXd a = random_matrix(30, 3, 2);
  a.col(2) = a.col(0);  // only the sum of p0 and p2 acts
  const Eigen::VectorXd b = random_matrix(30, 1, 3);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(3);
  const auto report = fit::minimise(linear(a, b), x);
  EXPECT_EQ(report.identifiable, (std::vector<bool>{false, true, false}));
  EXPECT_THAT(report.identifiability, testing::AllOf(HasSubstr("p0"), HasSubstr("p2"), testing::Not(HasSubstr("p1"))));
  EXPECT_TRUE(std::isnan(report.covariance(0, 0)));
  EXPECT_TRUE(std::isfinite(report.covariance(1, 1)));
  EXPECT_LT(report.singular_values[2], 1e-10 * report.singular_values[0]);
}

TEST(LeastSquares, SaysWhenItRanOutOfIterations) {
  ResidualModel model{{{"x", 1}}, 1, [](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
                        r[0] = std::exp(x[0]);
                        if (jacobian != nullptr) (*jacobian)(0, 0) = std::exp(x[0]);
                      }};
  Eigen::VectorXd x(1);
  x << 20;
  const auto report = fit::minimise(model, x, {.iterations_reach = 3});
  EXPECT_EQ(report.outcome, SearchReport::Outcome::out_of_iterations);
  EXPECT_FALSE(report.why.empty());
}

TEST(LeastSquares, SaysThatItIsStuckWhereTheDerivativesAreWrong) {
  // Their sign is: every step goes the wrong way, and is cut until it is no step. That is no minimum.
  const Eigen::MatrixXd a = random_matrix(50, 2, 4);
  const Eigen::VectorXd b = a * Eigen::Vector2d(1, -2) + random_matrix(50, 1, 5);
  ResidualModel model = linear(a, b);
  model.evaluate = [a, b](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    r = a * x - b;
    if (jacobian != nullptr) *jacobian = -a;
  };
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
  const auto report = fit::minimise(model, x);
  EXPECT_EQ(report.outcome, SearchReport::Outcome::stuck) << report.why;
  const double least = (a * (a.transpose() * a).inverse() * a.transpose() * b).squaredNorm();
  EXPECT_NEAR(report.promised, least / b.squaredNorm(), 1e-9);  // of the way to the minimum that there is
}

TEST(LeastSquares, HasAnEndAtABoundThatHoldsItBack) {
  const Eigen::MatrixXd a = random_matrix(50, 2, 6);
  ResidualModel model = linear(a, a * Eigen::Vector2d(1, -2) + random_matrix(50, 1, 7));
  model.parameters[0].highest = 0.5;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(2);
  const auto report = fit::minimise(model, x);
  EXPECT_EQ(report.outcome, SearchReport::Outcome::converged) << report.why;
  EXPECT_NEAR(x[0], 0.5, 1e-12);
  EXPECT_LT(report.promised, 1e-12);
}

TEST(LeastSquares, LeavesTheStartAloneWhereTheModelIsNotFinite) {
  ResidualModel model{{{"x", 1}}, 1, [](const Eigen::VectorXd&, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
                        r[0] = std::nan("");
                        if (jacobian != nullptr) (*jacobian)(0, 0) = std::nan("");
                      }};
  Eigen::VectorXd x(1);
  x << 2;
  const auto report = fit::minimise(model, x);
  EXPECT_EQ(report.outcome, SearchReport::Outcome::not_finite);
  EXPECT_EQ(x[0], 2);
  EXPECT_FALSE(report.identifiable[0]);
}

TEST(LeastSquares, RefusesFewerObservationsThanParameters) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(3);
  EXPECT_THROW(fit::minimise(linear(random_matrix(2, 3, 0), random_matrix(2, 1, 1)), x), hydro::InputError);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2);
  EXPECT_THROW(fit::minimise(linear(random_matrix(9, 3, 0), random_matrix(9, 1, 1)), y), hydro::InputError);
}

TEST(Compressed, HasTheSolutionAndTheResidualOfTheWholeProblem) {
  const Eigen::Index n = 5000;
  for (const double apart : {1.0, 1e-5}) {  // two columns well apart; nearly the same
    Eigen::MatrixXd a = Eigen::MatrixXd::Random(n, 3);
    a.col(2) = a.col(1) + apart * a.col(2);
    Eigen::VectorXd b = a * Eigen::Vector3d(1, -2, 3);
    b += 0.3 * Eigen::VectorXd::Random(n);
    const Eigen::VectorXd x = a.householderQr().solve(b);
    const auto small = fit::compress(a, b);
    const Eigen::VectorXd y = small.columns.triangularView<Eigen::Upper>().solve(small.target);
    EXPECT_NEAR((x - y).norm() / x.norm(), 0, 1e-11);  // condition 1e5 costs five digits of sixteen
    EXPECT_NEAR(small.rest, (b - a * x).norm(), 1e-9 * b.norm());
    EXPECT_NEAR((small.columns.transpose() * small.columns - a.transpose() * a).norm(), 0, 1e-11 * a.squaredNorm());
  }
}

TEST(Compressed, KeepsAPerfectFitPerfect) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(2000, 2);
  EXPECT_LT(fit::compress(a, a * Eigen::Vector2d(2, 5)).rest, 1e-12);
}

}  // namespace
}  // namespace least_squares_test
