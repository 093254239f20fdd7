#pragma once
/// \file  Private: a product of matrices for processors with AVX2 and FMA. It speaks of numbers alone, since the Eigen
/// that makes it is another one than the rest of the program's.
#include <cstddef>

namespace hydro::detail {

/// A matrix of which rows are adjacent, and columns `stride` apart.
struct Numbers {
  const double* data;
  std::ptrdiff_t rows, columns, stride;
};

/// `out` (m, n) = AᵀB, columns adjacent.
void wide_transposed_product(const Numbers& A, const Numbers& B, double* out);

}  // namespace hydro::detail
