#pragma once
/// \file  Factorisations of dense matrices, each compiled once.
///
/// The algorithms are LAPACK's (Anderson et al. 1999, LAPACK Users' Guide), which comes compiled. Eigen's own are
/// templates that take a compiler three to ten seconds in every file that names one, so no file includes their headers;
/// only inverses of matrices of a fixed size of four and less, which are closed forms, are left to <Eigen/LU>.
///
/// A right-hand side is a vector or a matrix of columns, real or complex as the factors are; what comes back has its
/// shape. Sizes that do not match are a broken assumption of the caller's, not an InputError. What is not finite gives
/// what is not finite. NumericsError is thrown where an iteration for eigenvalues or singular values does not end.
#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace hydro::dense {

/// A P = Q R by Householder reflections with column pivoting: least squares, and the rank.
class PivotedQr {
 public:
  /// A of shape (m, n).
  explicit PivotedQr(const Eigen::MatrixXd& A);

  /// x that makes ‖A x − b‖ least; entries along directions that the rank leaves out are zero. b of shape (m) or (m,
  /// k).
  template <class Derived>
  auto solve(const Eigen::MatrixBase<Derived>& b) const {
    if constexpr (Derived::ColsAtCompileTime == 1)
      return solve_vector(b);
    else
      return solve_matrix(b);
  }
  /// The number of pivots above rounding: ε times the smaller side of A times the largest pivot.
  Eigen::Index rank() const;
  /// The upper triangle R, of shape (min(m, n), n), with the columns in pivoted order.
  Eigen::MatrixXd R() const;

 private:
  Eigen::VectorXd solve_vector(const Eigen::Ref<const Eigen::VectorXd>& b) const;
  Eigen::MatrixXd solve_matrix(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  Eigen::MatrixXd packed_;  // R above, reflections below the diagonal
  Eigen::VectorXd tau_;     // the reflections' factors
  std::vector<int> order_;  // of the columns, counted from 1
};

/// A = Q R by Householder reflections, columns in their order; for A of full rank with no fewer rows than columns.
class HouseholderQr {
 public:
  explicit HouseholderQr(const Eigen::MatrixXd& A);

  /// x that makes ‖A x − b‖ least.
  template <class Derived>
  auto solve(const Eigen::MatrixBase<Derived>& b) const {
    if constexpr (Derived::ColsAtCompileTime == 1)
      return solve_vector(b);
    else
      return solve_matrix(b);
  }
  /// The first n columns of Q, which span those of A; shape (m, n).
  Eigen::MatrixXd thin_Q() const;
  /// Q whole, of shape (m, m): its last m − n columns are orthogonal to all of A's.
  Eigen::MatrixXd full_Q() const;
  /// The upper triangle R, of shape (n, n).
  Eigen::MatrixXd R() const;
  /// Qᵀ b, of shape (m).
  Eigen::VectorXd rotated(const Eigen::VectorXd& b) const;

 private:
  Eigen::VectorXd solve_vector(const Eigen::Ref<const Eigen::VectorXd>& b) const;
  Eigen::MatrixXd solve_matrix(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  Eigen::MatrixXd columns_of_Q(Eigen::Index count) const;
  Eigen::MatrixXd packed_;  // R above, reflections below the diagonal
  Eigen::VectorXd tau_;     // the reflections' factors
};

/// A P = Q (T 0; 0 0) Z, the complete orthogonal decomposition: of all least-squares solutions the shortest.
class CompleteQr {
 public:
  /// Pivots below `threshold` times the largest count as zero; without one, below rounding as in PivotedQr.
  explicit CompleteQr(const Eigen::MatrixXd& A, std::optional<double> threshold = {});

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::Index rank() const { return rank_; }

 private:
  Eigen::MatrixXd packed_;  // T above, reflections of Q below, those of Z right of it
  Eigen::VectorXd tau_, right_tau_;
  std::vector<int> order_;  // of the columns, counted from 1
  Eigen::Index rank_ = 0;
};

/// P A = L U with partial pivoting, for square A. A run asks for it at each step, with so few unknowns that a call of
/// LAPACK would cost as much as its work: this one is Eigen's.
class Lu {
 public:
  Lu();
  explicit Lu(const Eigen::MatrixXd& A);
  ~Lu();
  Lu(Lu&&) noexcept;
  Lu& operator=(Lu&&) noexcept;
  /// Factorises anew, in the memory that is there if A has the size of the one before.
  void compute(const Eigen::MatrixXd& A);

  template <class Derived>
  auto solve(const Eigen::MatrixBase<Derived>& b) const {
    if constexpr (Derived::ColsAtCompileTime == 1)
      return solve_vector(b);
    else
      return solve_matrix(b);
  }
  /// The reciprocal condition number in the 1-norm, estimated (Higham 1988); below about 1e-16 A is singular.
  double rcond() const;

 private:
  Eigen::VectorXd solve_vector(const Eigen::Ref<const Eigen::VectorXd>& b) const;
  Eigen::MatrixXd solve_matrix(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

/// The same for complex matrices.
class ComplexLu {
 public:
  explicit ComplexLu(const Eigen::MatrixXcd& A);

  template <class Derived>
  auto solve(const Eigen::MatrixBase<Derived>& b) const {
    if constexpr (Derived::ColsAtCompileTime == 1)
      return solve_vector(b);
    else
      return solve_matrix(b);
  }
  /// The reciprocal condition number in the 1-norm, estimated (Higham 1988); below about 1e-16 A is singular.
  double rcond() const;

 private:
  Eigen::VectorXcd solve_vector(const Eigen::Ref<const Eigen::VectorXcd>& b) const;
  Eigen::MatrixXcd solve_matrix(const Eigen::Ref<const Eigen::MatrixXcd>& b) const;
  Eigen::MatrixXcd packed_;
  std::vector<int> pivots_;
  double norm_;  // of A, the largest sum of a column's moduli
};

/// A = L Lᵀ of a symmetric matrix, of which the lower triangle is read.
class Cholesky {
 public:
  explicit Cholesky(const Eigen::MatrixXd& A);

  /// False where A is not positive definite; there are no factors then.
  explicit operator bool() const { return failed_at_ == 0; }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// The lower triangle L.
  Eigen::MatrixXd L() const;

 private:
  Eigen::MatrixXd L_;  // with what was above it
  int failed_at_ = 0;  // pivot that is not positive, counted from 1
};

/// A⁻¹ by LU; for small, well-conditioned A only.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& A);

/// (A + Aᵀ)/2: of all symmetric matrices the nearest to A.
Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd& A);

/// A = V diag(values) Vᵀ of a symmetric matrix, of which the lower triangle is read; values ascend.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;  ///< one a column
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& A);
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& A);

/// Eigenvalues of any square matrix, in no order.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

/// A = U diag(values) Vᵀ; values descend, and are exact to ε times the largest.
struct SingularValues {
  Eigen::VectorXd values;  ///< min(m, n)
  Eigen::MatrixXd U, V;    ///< (m, min(m, n)) and (n, min(m, n)), one vector a column
};
SingularValues svd(const Eigen::MatrixXd& A);
Eigen::VectorXd singular_values(const Eigen::MatrixXd& A);

/// A ≈ Q R by Householder reflections with column pivoting, cut before the first pivot whose modulus is `least` or
/// less.
struct LowRank {
  Eigen::MatrixXcd Q, R;  ///< (m, rank), orthonormal columns, and (rank, n)
};
LowRank low_rank(const Eigen::MatrixXcd& A, double least);

}  // namespace hydro::dense
