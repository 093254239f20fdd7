#pragma once
/// \file  LU factors of a sparse complex matrix. Not installed.
#include <Eigen/KLUSupport>
#include <Eigen/Sparse>

#include <complex>

namespace dynamics {

/// By SuiteSparse KLU: blocks of a triangle first, each in the order of approximate minimum degree, row pivots.
class ComplexSparseLu : private Eigen::KLU<Eigen::SparseMatrix<std::complex<double>>> {
 public:
  using Matrix = Eigen::SparseMatrix<std::complex<double>>;

  /// `A` is compressed and must stay as long as these factors.
  explicit ComplexSparseLu(Matrix& A);
  /// True if A is singular to working precision: its reciprocal condition number, estimated, is below 1e-15.
  bool is_singular() const { return singular_; }
  /// Of each column; not for a singular A.
  Eigen::MatrixXcd solve(const Eigen::MatrixXcd& b) const { return Eigen::KLU<Matrix>::solve(b); }

 private:
  bool singular_;
};

}  // namespace dynamics
