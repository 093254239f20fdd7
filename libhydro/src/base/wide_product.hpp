#pragma once
/// \file  Private: a product of matrices for processors with AVX2 and FMA. It speaks of numbers alone, since the Eigen
/// that makes it is another one than the rest of the program's.
#include <complex>
#include <cstddef>

namespace hydro::detail {

/// A matrix of which rows are adjacent, and columns `stride` apart.
struct Numbers {
  const double* data;
  std::ptrdiff_t rows, columns, stride;
};

/// The same of complex numbers: `stride` is between columns where the entries of a column are adjacent, between rows
/// where those of a row are.
struct ComplexNumbers {
  const std::complex<double>* data;
  std::ptrdiff_t rows, columns, stride;
};
struct ComplexSums {
  std::complex<double>* data;
  std::ptrdiff_t stride;
};

/// `out` += A B; entries of a column of A are adjacent, entries of a row of B and of `out`.
void wide_add_product(const ComplexNumbers& A, const ComplexNumbers& B, const ComplexSums& out);

/// `out` (m, n) = AᵀB, columns adjacent.
void wide_transposed_product(const Numbers& A, const Numbers& B, double* out);

}  // namespace hydro::detail
