#include "hydro/base/dense.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "hydro/base/parallel.hpp"
#include "hydro/base/random.hpp"

extern "C" {
[[gnu::weak]] int openblas_get_num_threads();
[[gnu::weak]] void openblas_set_num_threads(int);
}

namespace hydro::dense_test {

using Eigen::Index, Eigen::MatrixXcd, Eigen::VectorXcd;

constexpr double eps = std::numeric_limits<double>::epsilon();

MatrixXcd drawn(Index rows, Index columns, std::uint64_t seed) {
  const RandomStream random(seed, 0);
  std::uint64_t at = 0;
  MatrixXcd out(rows, columns);
  for (Index j = 0; j < columns; ++j)
    for (Index i = 0; i < rows; ++i, at += 2) out(i, j) = {random.normal(at), random.normal(at + 1)};
  return out;
}

// Partial pivoting is backward stable: a residual is below ε n g ‖A‖‖x‖ (Higham 2002, theorem 9.5); matrices drawn at
// random have a growth g of some n^⅔, here below 30.
TEST(ComplexLu, LeavesNoMoreThanRounding) {
  for (const Index n : {1, 2, 7, 30, 65, 200}) {
    const MatrixXcd A = drawn(n, n, 1), B = drawn(n, 5, 2);
    const dense::ComplexLu lu(A);
    const MatrixXcd X = lu.solve(B);
    EXPECT_LE((A * X - B).norm(), 30 * eps * static_cast<double>(n) * A.norm() * X.norm()) << n;
    const VectorXcd b = B.col(3), x = lu.solve(b);
    EXPECT_LE((A * x - b).norm(), 30 * eps * static_cast<double>(n) * A.norm() * x.norm()) << n;
  }
}

TEST(ComplexLu, TakesColumnsOfALargerMatrix) {
  const MatrixXcd A = drawn(12, 12, 3), B = drawn(20, 9, 4);
  const MatrixXcd X = dense::ComplexLu(A).solve(B.block(5, 2, 12, 4));
  EXPECT_LE((A * X - B.block(5, 2, 12, 4)).norm(), 1e-12 * X.norm() * A.norm());
}

// Of a diagonal matrix the condition in the 1-norm is the largest modulus over the smallest, and the estimate exact.
TEST(ComplexLu, TellsTheCondition) {
  VectorXcd d(4);
  d << std::complex<double>(3, 4), 1e-9, std::complex<double>(0, -2), 1;
  EXPECT_NEAR(dense::ComplexLu(d.asDiagonal()).rcond(), 2e-10, 1e-14 * 2e-10);
  MatrixXcd singular = drawn(30, 30, 5);
  singular.col(7) = singular.col(11) * std::complex<double>(2, 1) - singular.col(3);
  EXPECT_LT(dense::ComplexLu(singular).rcond(), 1e-16);
  EXPECT_EQ(dense::ComplexLu(MatrixXcd::Zero(3, 3)).rcond(), 0);
}

// Two threads that factorise at once find the same bits as one, and leave OpenBLAS as it was.
TEST(ComplexLu, IsTheSameOnAnyNumberOfThreads) {
  constexpr Index large = 300;  // OpenBLAS divides a product of this size among its threads
  if (openblas_set_num_threads == nullptr) GTEST_SKIP() << "LAPACK is another than OpenBLAS";
  const MatrixXcd A = drawn(large, large, 6), B = drawn(large, 3, 7);
  const int before = openblas_get_num_threads();
  openblas_set_num_threads(1);
  const MatrixXcd alone = dense::ComplexLu(A).solve(B);
  openblas_set_num_threads(3);
  std::vector<MatrixXcd> together(6);
  in_parallel(together.size(), 2, [&](std::size_t i) { together[i] = dense::ComplexLu(A).solve(B); });
  EXPECT_EQ(openblas_get_num_threads(), 3);
  openblas_set_num_threads(before);
  for (const MatrixXcd& x : together) EXPECT_EQ(x, alone);
}

}  // namespace hydro::dense_test
