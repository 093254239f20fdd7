#include "hydro/base/product.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "hydro/base/random.hpp"

namespace {
namespace product_test {

Eigen::MatrixXd drawn(Eigen::Index rows, Eigen::Index columns, std::uint64_t stream) {
  const hydro::RandomStream normal(1, stream);
  Eigen::MatrixXd out(rows, columns);
  for (Eigen::Index i = 0; i < out.size(); ++i) out.data()[i] = normal.normal(static_cast<std::uint64_t>(i));
  return out;
}

/// One entry as it is written on paper, with the sum of what it adds up.
struct Entry {
  double value = 0, size = 0;
};

Entry entry(const Eigen::MatrixXd& A, Eigen::Index i, const Eigen::MatrixXd& B, Eigen::Index j) {
  Entry out;
  for (Eigen::Index k = 0; k < A.rows(); ++k) {
    out.value += A(k, i) * B(k, j);
    out.size += std::abs(A(k, i) * B(k, j));
  }
  return out;
}

void expect_product(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, const Eigen::MatrixXd& got) {
  ASSERT_EQ(got.rows(), A.cols());
  ASSERT_EQ(got.cols(), B.cols());
  // Both sums are off by k ε Σ|a||b| at most, in whatever order they are taken.
  const double share = 2 * static_cast<double>(A.rows()) * std::numeric_limits<double>::epsilon() / 2;
  for (Eigen::Index i = 0; i < A.cols(); ++i)
    for (Eigen::Index j = 0; j < B.cols(); ++j) {
      const Entry e = entry(A, i, B, j);
      EXPECT_NEAR(got(i, j), e.value, share * e.size) << i << ' ' << j;
    }
}

TEST(TransposedProduct, IsTheSumOnPaperForAnyShape) {
  for (const auto& [k, m, n] : {std::array<Eigen::Index, 3>{1, 1, 1}, {7, 3, 5}, {64, 33, 17}, {311, 61, 62}}) {
    const Eigen::MatrixXd A = drawn(k, m, 1), B = drawn(k, n, 2);
    expect_product(A, B, hydro::transposed_product(A, B));
  }
}

TEST(TransposedProduct, TakesPartsOfMatrices) {
  const Eigen::MatrixXd A = drawn(40, 20, 3), B = drawn(50, 30, 4);
  expect_product(A.block(3, 2, 31, 9), B.block(5, 7, 31, 12),
                 hydro::transposed_product(A.block(3, 2, 31, 9), B.block(5, 7, 31, 12)));
}

TEST(TransposedProduct, OfNothingIsZeroOrEmpty) {
  EXPECT_TRUE(hydro::transposed_product(Eigen::MatrixXd(0, 3), Eigen::MatrixXd(0, 2)).isZero(0));
  EXPECT_EQ(hydro::transposed_product(Eigen::MatrixXd(4, 0), Eigen::MatrixXd(4, 2)).size(), 0);
}

}  // namespace product_test
}  // namespace
