#include "hydro/base/dense.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

#include "hydro/base/random.hpp"

namespace dense_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
namespace dense = hydro::dense;

/// Normal numbers, different for each seed.
MatrixXd drawn(Index rows, Index columns, std::uint64_t seed = 1) {
  const hydro::RandomStream stream(seed, 0);
  MatrixXd out(rows, columns);
  for (Index k = 0; k < out.size(); ++k) out(k) = stream.normal(static_cast<std::uint64_t>(k));
  return out;
}
MatrixXcd drawn_complex(Index rows, Index columns) {
  return drawn(rows, columns, 1) + std::complex<double>(0, 1) * drawn(rows, columns, 2);
}
/// Rank two: the last columns are sums of the first ones.
MatrixXd of_rank_two(Index rows) { return drawn(rows, 2) * drawn(2, 5, 2); }

// Backward errors of these methods are some n ε (Higham 2002, chapters 9, 10, 19); matrices here have n <= 40, and
// random ones condition numbers of some hundreds.
constexpr double rounding = 1e-12;

template <class A, class B>
void expect_same(const A& a, const B& b, double tolerance = rounding) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.cols(), b.cols());
  EXPECT_LE((a - b).norm(), tolerance * (1 + b.norm()));
}

TEST(DenseLu, SolvesRealAndComplexSystemsForVectorsAndColumns) {
  for (const Index n : {1, 2, 6, 40}) {
    const MatrixXd A = drawn(n, n), x = drawn(n, 3, 2);
    const MatrixXcd C = drawn_complex(n, n), z = drawn_complex(n, 3);
    expect_same(dense::Lu(A).solve(MatrixXd(A * x)), x, 1e-11);
    expect_same(dense::Lu(A).solve(VectorXd(A * x.col(1))), x.col(1), 1e-11);
    expect_same(dense::ComplexLu(C).solve(MatrixXcd(C * z)), z, 1e-11);
    expect_same(dense::ComplexLu(C).solve(VectorXcd(C * z.col(2))), z.col(2), 1e-11);
    expect_same(A * dense::inverse(A), MatrixXd::Identity(n, n), 1e-11);
  }
}

TEST(DenseLu, TellsTheConditionOfDiagonalMatricesExactlyAndOfSingularOnesAsNoMoreThanRounding) {
  const VectorXd sizes = (VectorXd(3) << 1, -0.5, 1e-9).finished();
  EXPECT_NEAR(dense::Lu(sizes.asDiagonal()).rcond(), 1e-9, 1e-20);
  EXPECT_NEAR(dense::ComplexLu(MatrixXcd(sizes.cast<std::complex<double>>().asDiagonal())).rcond(), 1e-9, 1e-20);
  EXPECT_FALSE(dense::Lu(MatrixXd::Ones(3, 3)).rcond() > 1e-15);
  EXPECT_EQ(dense::ComplexLu(MatrixXcd::Ones(3, 3)).rcond(), 0);
  EXPECT_TRUE(std::isnan(dense::Lu(MatrixXd::Constant(2, 2, std::nan(""))).rcond()));
}

TEST(DenseLu, FactorisesAnewWhatItHeldBefore) {
  dense::Lu lu(drawn(4, 4));
  for (const Index n : {4, 7, 2}) {
    const MatrixXd A = drawn(n, n, 5);
    lu.compute(A);
    expect_same(A * lu.solve(VectorXd(VectorXd::Ones(n))), VectorXd::Ones(n), 1e-11);
  }
}

TEST(PivotedQr, LeavesAResidualAtRightAnglesToTheColumns) {
  const MatrixXd A = drawn(30, 5), b = drawn(30, 2, 2);
  const dense::PivotedQr qr(A);
  EXPECT_LE((A.transpose() * (A * qr.solve(b) - b)).norm(), rounding * A.norm() * b.norm());
  expect_same(qr.solve(b).col(1), qr.solve(VectorXd(b.col(1))));
  EXPECT_EQ(qr.rank(), 5);
}

TEST(PivotedQr, FindsTheRankAndATriangleWithTheColumnsOfAPivoted) {
  const MatrixXd A = of_rank_two(12);
  const dense::PivotedQr qr(A);
  EXPECT_EQ(qr.rank(), 2);
  const MatrixXd R = qr.R();
  ASSERT_EQ(R.rows(), 5);
  EXPECT_NEAR(R.norm(), A.norm(), rounding * A.norm());  // Q turns, and the pivots only sort
  for (Index i = 1; i < 5; ++i) {
    EXPECT_EQ(R.col(i - 1).tail(5 - i).norm(), 0);
    EXPECT_LE(std::abs(R(i, i)), std::abs(R(i - 1, i - 1)));
  }
  EXPECT_EQ(dense::PivotedQr(drawn(3, 8)).R().rows(), 3);
  EXPECT_EQ(dense::PivotedQr(drawn(3, 8)).rank(), 3);
}

TEST(PivotedQr, SolvesWithFewerPivotsWhereAColumnIsZero) {
  MatrixXd A = drawn(9, 4);
  A.col(1).setZero();
  const VectorXd b = drawn(9, 1, 2), x = dense::PivotedQr(A).solve(b);
  EXPECT_EQ(x[1], 0);
  EXPECT_LE((A.transpose() * (A * x - b)).norm(), rounding * A.norm() * b.norm());
}

TEST(HouseholderQr, GivesOrthonormalColumnsAndATriangle) {
  const MatrixXd A = drawn(20, 6);
  const dense::HouseholderQr qr(A);
  const MatrixXd Q = qr.thin_Q(), whole = qr.full_Q();
  expect_same(Q * qr.R(), A);
  expect_same(whole.transpose() * whole, MatrixXd::Identity(20, 20));
  expect_same(whole.leftCols(6), Q);
  EXPECT_LE((A.transpose() * whole.rightCols(14)).norm(), rounding * A.norm());
  const VectorXd b = drawn(20, 1, 2);
  expect_same(qr.rotated(b), whole.transpose() * b);
  EXPECT_LE((A.transpose() * (A * qr.solve(b) - b)).norm(), rounding * A.norm() * b.norm());
  EXPECT_EQ(qr.R()(3, 2), 0);
}

TEST(CompleteQr, GivesOfAllSolutionsTheShortest) {
  for (const Index rows : {3, 5, 12}) {
    const MatrixXd A = of_rank_two(rows);
    const dense::CompleteQr qr(A);
    EXPECT_EQ(qr.rank(), 2);
    const VectorXd b = drawn(rows, 1, 3), x = qr.solve(b);
    EXPECT_LE((A.transpose() * (A * x - b)).norm(), rounding * A.norm() * b.norm());
    // The shortest has nothing in the null space: it is a combination of A's rows.
    const VectorXd y = dense::CompleteQr(A.transpose()).solve(x);
    expect_same(A.transpose() * y, x);
  }
}

TEST(CompleteQr, CountsAsZeroWhatIsBelowItsThreshold) {
  const MatrixXd A = (VectorXd(3) << 1, 1e-3, 1e-6).finished().asDiagonal();
  EXPECT_EQ(dense::CompleteQr(A).rank(), 3);
  EXPECT_EQ(dense::CompleteQr(A, 1e-4).rank(), 2);
  EXPECT_EQ(dense::CompleteQr(A, 1e-4).solve(VectorXd::Ones(3))[2], 0);
  EXPECT_EQ(dense::CompleteQr(MatrixXd::Zero(3, 2)).solve(VectorXd::Ones(3)).norm(), 0);
}

TEST(DenseCholesky, FactorisesWhatIsPositiveDefiniteAndRefusesWhatIsNot) {
  const MatrixXd B = drawn(8, 8);
  MatrixXd A = B * B.transpose();
  const dense::Cholesky factors(A);
  ASSERT_TRUE(factors);
  expect_same(factors.L() * factors.L().transpose(), A);
  EXPECT_EQ(factors.L()(0, 1), 0);
  expect_same(A * factors.solve(B), B, 1e-9);  // the condition number of A is the square of B's
  A.triangularView<Eigen::StrictlyUpper>().setConstant(17);
  expect_same(dense::Cholesky(A).L(), factors.L());  // above the diagonal nothing is read
  A(3, 3) = -1;
  EXPECT_FALSE(dense::Cholesky(A));
}

TEST(SymmetricEigen, MeetsItsEquationWithValuesThatAscend) {
  const MatrixXd A = dense::symmetric_part(drawn(12, 12));
  MatrixXd lower = A;
  lower.triangularView<Eigen::StrictlyUpper>().setConstant(17);
  const auto [values, vectors] = dense::symmetric_eigen(lower);
  expect_same(A * vectors, vectors * values.asDiagonal());
  expect_same(vectors.transpose() * vectors, MatrixXd::Identity(12, 12));
  for (Index i = 1; i < 12; ++i) EXPECT_LE(values[i - 1], values[i]);
  expect_same(dense::symmetric_eigenvalues(lower), values);
}

TEST(Eigenvalues, AreThoseOfABlockOfEachPair) {
  MatrixXd A = MatrixXd::Zero(3, 3);
  A << -0.2, 1.5, 0, -1.5, -0.2, 0, 0, 0, 4;
  const MatrixXd turned = drawn(3, 3, 4);
  const VectorXcd found = dense::eigenvalues(turned * A * dense::inverse(turned));
  for (const std::complex<double> wanted : {std::complex<double>(-0.2, 1.5), {-0.2, -1.5}, {4, 0}})
    EXPECT_LE((found.array() - wanted).abs().minCoeff(), 1e-11) << wanted;
}

TEST(SingularValueDecomposition, MeetsItsEquationForTallAndWideMatrices) {
  for (const auto& [rows, columns] : std::vector<std::pair<Index, Index>>{{9, 4}, {4, 9}, {5, 5}}) {
    const MatrixXd A = drawn(rows, columns);
    const auto [values, U, V] = dense::svd(A);
    const Index least = std::min(rows, columns);
    expect_same(U * values.asDiagonal() * V.transpose(), A);
    expect_same(U.transpose() * U, MatrixXd::Identity(least, least));
    expect_same(V.transpose() * V, MatrixXd::Identity(least, least));
    for (Index i = 1; i < least; ++i) EXPECT_GE(values[i - 1], values[i]);
    expect_same(dense::singular_values(A), values);
  }
}

TEST(LowRank, IsTheMatrixToItsLeastPivot) {
  const MatrixXcd A = drawn_complex(10, 3) * drawn_complex(3, 8);
  const auto [Q, R] = dense::low_rank(A, 1e-9);
  EXPECT_EQ(Q.cols(), 3);
  expect_same(Q * R, A);
  expect_same(Q.adjoint() * Q, MatrixXcd::Identity(3, 3));
  EXPECT_EQ(dense::low_rank(A, 1e9).R.rows(), 0);
}

TEST(Dense, GivesOfWhatIsNotFiniteWhatIsNotFinite) {
  MatrixXd A = MatrixXd::Identity(3, 3);
  A(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(dense::symmetric_eigen(A).values.allFinite());
  EXPECT_FALSE(dense::eigenvalues(A).allFinite());
  EXPECT_FALSE(dense::singular_values(A).allFinite());
  EXPECT_FALSE(dense::Cholesky(A));
  EXPECT_FALSE(dense::Lu(A).solve(VectorXd(VectorXd::Ones(3))).allFinite());
}

TEST(Dense, TakesMatricesWithoutRowsOrColumns) {
  EXPECT_EQ(dense::Lu(MatrixXd(0, 0)).solve(VectorXd(0)).size(), 0);
  EXPECT_EQ(dense::PivotedQr(MatrixXd(0, 3)).solve(VectorXd(VectorXd(0))), VectorXd::Zero(3));
  EXPECT_EQ(dense::PivotedQr(MatrixXd(4, 0)).solve(VectorXd(VectorXd::Ones(4))).size(), 0);
  EXPECT_EQ(dense::CompleteQr(MatrixXd(0, 3)).solve(VectorXd(0)), VectorXd::Zero(3));
  EXPECT_EQ(dense::symmetric_eigenvalues(MatrixXd(0, 0)).size(), 0);
  EXPECT_EQ(dense::svd(MatrixXd(3, 0)).values.size(), 0);
  EXPECT_TRUE(dense::Cholesky(MatrixXd(0, 0)));
}

}  // namespace
}  // namespace dense_test
