#pragma once
/// \file  LU factors of matrices that come again and again in one shape: they ask for memory the first time alone. Not
///        installed.
#include <Eigen/KLUSupport>
#include <Eigen/LU>
#include <Eigen/Sparse>

namespace dynamics {

/// Of a dense matrix, with row pivots.
class KeptDenseLu {
 public:
  /// False if the matrix, which must be finite, is singular to working precision.
  bool factorise(const Eigen::MatrixXd& matrix);
  /// Into another vector than `right`.
  void solve(const Eigen::VectorXd& right, Eigen::VectorXd& out) const { out = lu_.solve(right); }

 private:
  double size_of_inverse();
  void solve_transposed(const Eigen::VectorXd& right, Eigen::VectorXd& out);

  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::VectorXd right_, found_, sign_, sign_before_, permuted_;  // room for size_of_inverse()
};

/// Of a sparse matrix, by SuiteSparse KLU. Its pivots are kept from matrix to matrix while they serve.
class KeptSparseLu : private Eigen::KLU<Eigen::SparseMatrix<double>> {
 public:
  using Matrix = Eigen::SparseMatrix<double>;

  /// The matrix is compressed and has its numbers at the same places each time. \returns false if it is singular
  bool factorise(Matrix& matrix);
  void solve_in_place(Eigen::VectorXd& b) { solve_in_place(b.data(), b.rows(), 1); }
  void solve_in_place(Eigen::MatrixXd& b) { solve_in_place(b.data(), b.rows(), b.cols()); }
  /// Numbers in the factors.
  long entries() const { return m_numeric == nullptr ? 0 : m_numeric->lnz + m_numeric->unz; }

 private:
  bool refactorise(Matrix& matrix);
  void solve_in_place(double* b, Eigen::Index rows, Eigen::Index columns);
};

}  // namespace dynamics
