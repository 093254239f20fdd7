#include "wide_product.hpp"

// This file alone is compiled for AVX2 and FMA, so nothing of it may be taken for a function of the rest of the
// program, which any processor runs: its Eigen goes by another name, and what that inlines of the standard library
// stays inside.
#define Eigen FroudeWideEigen
#undef EIGEN_MALLOC_ALREADY_ALIGNED  // to 16 bytes, as malloc is: here it has to be 32
#include <Eigen/Core>

namespace hydro::detail {

void wide_transposed_product(const Numbers& A, const Numbers& B, double* out) {
  using Map = Eigen::Map<const Eigen::MatrixXd, Eigen::Unaligned, Eigen::OuterStride<>>;
  const Map a(A.data, A.rows, A.columns, Eigen::OuterStride<>(A.stride));
  const Map b(B.data, B.rows, B.columns, Eigen::OuterStride<>(B.stride));
  Eigen::Map<Eigen::MatrixXd>(out, A.columns, B.columns).noalias() = a.transpose() * b;
}

void wide_add_product(const ComplexNumbers& A, const ComplexNumbers& B, const ComplexSums& out) {
  using Rows = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Stride = Eigen::OuterStride<>;
  const Eigen::Map<const Eigen::MatrixXcd, Eigen::Unaligned, Stride> a(A.data, A.rows, A.columns, Stride(A.stride));
  const Eigen::Map<const Rows, Eigen::Unaligned, Stride> b(B.data, B.rows, B.columns, Stride(B.stride));
  Eigen::Map<Rows, Eigen::Unaligned, Stride>(out.data, A.rows, B.columns, Stride(out.stride)).noalias() += a * b;
}

}  // namespace hydro::detail
