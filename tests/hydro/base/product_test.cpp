#include "hydro/base/product.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
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

TEST(AddProduct, IsTheSumOnPaperForAnyShapeAndPart) {
  const auto complex = [](Eigen::Index rows, Eigen::Index columns, std::uint64_t stream) {
    Eigen::MatrixXcd out(rows, columns);
    out.real() = drawn(rows, columns, stream);
    out.imag() = drawn(rows, columns, stream + 1);
    return out;
  };
  for (const auto& [m, k, n] : {std::array<Eigen::Index, 3>{1, 1, 1}, {3, 7, 5}, {33, 17, 48}, {75, 76, 47}}) {
    const Eigen::MatrixXcd A = complex(m + 3, k + 2, 5);
    const hydro::RowMajorXcd B = complex(k + 4, n + 1, 7);
    hydro::RowMajorXcd out = complex(m + 2, n, 9);
    const hydro::RowMajorXcd before = out;
    hydro::add_product(A.block(1, 2, m, k), B.middleRows(3, k).leftCols(n), out.middleRows(2, m));
    // Complex products are four real ones; each sum is off by 2k ε Σ|a||b|, here and there.
    for (Eigen::Index i = 0; i < m; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        std::complex<double> sum = before(i + 2, j);
        double size = std::abs(sum);
        for (Eigen::Index l = 0; l < k; ++l) {
          sum += A(i + 1, l + 2) * B(l + 3, j);
          size += std::abs(A(i + 1, l + 2)) * std::abs(B(l + 3, j));
        }
        const double share = 4 * static_cast<double>(k + 1) * std::numeric_limits<double>::epsilon();
        EXPECT_LT(std::abs(out(i + 2, j) - sum), share * size) << i << ' ' << j;
      }
    EXPECT_TRUE(out.topRows(2) == before.topRows(2));
  }
}

}  // namespace product_test
}  // namespace
