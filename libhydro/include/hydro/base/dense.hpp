#pragma once
/// \file  Factorisations of dense matrices, each compiled once.
///
/// The algorithms are Eigen's, and LAPACK's for complex factors. Eigen's templates take a compiler three to ten seconds
/// in every file that names one, so they are instantiated in src/base/dense.cpp alone, and no other file includes
/// Eigen's own headers for them. Matrices of a fixed size of four and less, whose inverses are closed forms, are left
/// to <Eigen/LU>.
///
/// A right-hand side is a vector or a matrix of columns, real or complex as the factors are; what comes back has its
/// shape. Sizes that do not match are a broken assumption of the caller's, not an InputError. Nothing here looks for
/// NaN.
#include <Eigen/Core>

#include <memory>
#include <optional>

namespace hydro::dense {

/// A P = Q R by Householder reflections with column pivoting: least squares, and the rank.
class PivotedQr {
 public:
  /// A of shape (m, n).
  explicit PivotedQr(const Eigen::MatrixXd& A);
  ~PivotedQr();
  PivotedQr(PivotedQr&&) noexcept;

  /// x that makes ‖A x − b‖ least; entries along directions that the rank leaves out are zero. b of shape (m) or (m,
  /// k).
  template <class Derived>
  auto solve(const Eigen::MatrixBase<Derived>& b) const {
    if constexpr (Derived::ColsAtCompileTime == 1)
      return solve_vector(b);
    else
      return solve_matrix(b);
  }
  /// The number of pivots above rounding: ε times the larger side of A times the largest pivot.
  Eigen::Index rank() const;
  /// The upper triangle R, of shape (min(m, n), n), with the columns in pivoted order.
  Eigen::MatrixXd R() const;

 private:
  Eigen::VectorXd solve_vector(const Eigen::Ref<const Eigen::VectorXd>& b) const;
  Eigen::MatrixXd solve_matrix(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

/// A = Q R by Householder reflections, columns in their order; for A of full rank with no fewer rows than columns.
class HouseholderQr {
 public:
  explicit HouseholderQr(const Eigen::MatrixXd& A);
  ~HouseholderQr();
  HouseholderQr(HouseholderQr&&) noexcept;

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
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

/// A P = Q (T 0; 0 0) Z, the complete orthogonal decomposition: of all least-squares solutions the shortest.
class CompleteQr {
 public:
  /// Pivots below `threshold` times the largest count as zero; without one, below rounding as in PivotedQr.
  explicit CompleteQr(const Eigen::MatrixXd& A, std::optional<double> threshold = {});
  ~CompleteQr();
  CompleteQr(CompleteQr&&) noexcept;
  CompleteQr& operator=(CompleteQr&&) noexcept;

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::Index rank() const;

 private:
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

/// P A = L U with partial pivoting, for square A.
class Lu {
 public:
  explicit Lu(const Eigen::MatrixXd& A);
  ~Lu();
  Lu(Lu&&) noexcept;
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

 private:
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

/// The same for complex matrices, by LAPACK on the thread that calls: OpenBLAS takes the widest vectors that a
/// processor has, so on matrices of 30 to 3 000 it was two to seven times as fast as Eigen's. Entries of the factors
/// differ by rounding from one kind of processor to another, on one machine they are the same every time.
class ComplexLu {
 public:
  explicit ComplexLu(const Eigen::MatrixXcd& A);
  ~ComplexLu();
  ComplexLu(ComplexLu&&) noexcept;

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
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

/// A = L Lᵀ of a symmetric matrix, of which the lower triangle is read.
class Cholesky {
 public:
  explicit Cholesky(const Eigen::MatrixXd& A);
  ~Cholesky();
  Cholesky(Cholesky&&) noexcept;

  /// False where A is not positive definite; there are no factors then.
  explicit operator bool() const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  /// The lower triangle L.
  Eigen::MatrixXd L() const;

 private:
  struct Factors;
  std::unique_ptr<const Factors> factors_;
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

/// A symmetric A with its negative eigenvalues set to zero: of all symmetric matrices without any the nearest by the
/// sum of squares (Higham 1988, theory (P74)). A itself where it has none.
Eigen::MatrixXd positive_part(const Eigen::MatrixXd& A);

/// Eigenvalues of any square matrix, in no order.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

/// A = U diag(values) Vᵀ by Jacobi's rotations; values descend.
struct SingularValues {
  Eigen::VectorXd values;  ///< min(m, n)
  Eigen::MatrixXd U, V;    ///< (m, min(m, n)) and (n, min(m, n)), one vector a column
};
SingularValues svd(const Eigen::MatrixXd& A);
Eigen::VectorXd singular_values(const Eigen::MatrixXd& A);

}  // namespace hydro::dense
