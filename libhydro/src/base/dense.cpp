#include "hydro/base/dense.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "base/lapack.hpp"
#include "hydro/base/error.hpp"

// Other libraries with LAPACK's interface lack it; its address is null then.
extern "C" void openblas_set_num_threads(int threads) __attribute__((weak));

namespace hydro::dense {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::Ref;
using Eigen::VectorXcd;
using Eigen::VectorXd;

/// The matrices here have some tens of rows. OpenBLAS starts threads for some of them, which costs more than they
/// bring, and ten times as much where other programs want the cores; rounding, too, would depend on their number.
/// Unless the user has said how many, it is told to do without.
bool without_threads() {
  if (openblas_set_num_threads && !std::getenv("OPENBLAS_NUM_THREADS")) openblas_set_num_threads(1);
  return true;
}
[[maybe_unused]] const bool threads_are_set = without_threads();

constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <class Matrix>
int rows(const Matrix& A) {
  return static_cast<int>(A.rows());
}
template <class Matrix>
int columns(const Matrix& A) {
  return static_cast<int>(A.cols());
}
/// The distance of columns in memory, which LAPACK wants positive where there are no rows, too.
template <class Matrix>
int stride(const Matrix& A) {
  return std::max(1, rows(A));
}

/// Calls a routine twice: first for the size of its workspace, then with it.
template <class Scalar = double, class Routine>
void with_workspace(Routine call) {
  Scalar best = 0;
  call(&best, -1);
  std::vector<Scalar> work(std::max<std::size_t>(1, static_cast<std::size_t>(std::real(best))));
  call(work.data(), static_cast<int>(work.size()));
}

/// The iterations for eigenvalues and singular values end for all finite matrices that are known.
void check_converged(int info, const char* what) {
  if (info != 0) throw NumericsError(fmt::format("the iteration for the {} of a matrix did not converge", what));
}

/// Triangle R of a packed factorisation, the rest zero.
MatrixXd upper_triangle(const MatrixXd& packed, Index rows) {
  MatrixXd out = MatrixXd::Zero(rows, packed.cols());
  for (Index j = 0; j < packed.cols(); ++j)
    for (Index i = 0; i <= std::min(j, rows - 1); ++i) out(i, j) = packed(i, j);
  return out;
}

/// B becomes Q B or, with 'T', Qᵀ B.
void multiply_by_Q(char trans, const MatrixXd& packed, const VectorXd& tau, MatrixXd& B) {
  const int m = rows(B), k = static_cast<int>(tau.size()), n = columns(B), lda = stride(packed), ldb = stride(B);
  if (k == 0 || n == 0) return;
  int info = 0;
  with_workspace([&](double* work, int size) {
    lapack::dormqr_("L", &trans, &m, &n, &k, packed.data(), &lda, tau.data(), B.data(), &ldb, work, &size, &info, 1, 1);
  });
}

/// The first `rank` rows of B become those of R⁻¹ B.
void divide_by_R(const MatrixXd& packed, Index rank, MatrixXd& B) {
  const int n = static_cast<int>(rank), k = columns(B), lda = stride(packed), ldb = stride(B);
  int info = 0;
  if (n > 0) lapack::dtrtrs_("U", "N", "N", &n, &k, packed.data(), &lda, B.data(), &ldb, &info, 1, 1, 1);
}

/// A P = Q R in place: reflections below the diagonal and in `tau`. `order` counts A's columns from 1.
void pivoted(MatrixXd& A, VectorXd& tau, std::vector<int>& order) {
  const int m = rows(A), n = columns(A), lda = stride(A);
  int info = 0;
  tau.resize(std::min(m, n));
  order.assign(static_cast<std::size_t>(n), 0);
  with_workspace([&](double* work, int size) {
    lapack::dgeqp3_(&m, &n, A.data(), &lda, order.data(), tau.data(), work, &size, &info);
  });
}

/// Pivots above `threshold` times the largest, which is the first.
Index pivots_above(double threshold, const MatrixXd& packed, Index pivots) {
  Index count = 0;
  while (count < pivots && std::abs(packed(count, count)) > threshold * std::abs(packed(0, 0))) ++count;
  return count;
}

/// Rows of x, which belong to the pivoted columns, to the order of A's own.
MatrixXd unsorted(const MatrixXd& x, const std::vector<int>& order) {
  MatrixXd out(static_cast<Index>(order.size()), x.cols());
  for (std::size_t i = 0; i < order.size(); ++i) out.row(order[i] - 1) = x.row(static_cast<Index>(i));
  return out;
}

}  // namespace

PivotedQr::PivotedQr(const MatrixXd& A) : packed_(A) { pivoted(packed_, tau_, order_); }
MatrixXd PivotedQr::solve_matrix(const Ref<const MatrixXd>& b) const {
  MatrixXd c = b;
  multiply_by_Q('T', packed_, tau_, c);
  // What rounding leaves of a column that others span is no pivot to divide by.
  const Index pivots = pivots_above(epsilon, packed_, tau_.size());
  divide_by_R(packed_, pivots, c);
  MatrixXd x = MatrixXd::Zero(packed_.cols(), b.cols());
  x.topRows(pivots) = c.topRows(pivots);
  return unsorted(x, order_);
}
VectorXd PivotedQr::solve_vector(const Ref<const VectorXd>& b) const { return solve_matrix(b); }
Index PivotedQr::rank() const { return pivots_above(epsilon * static_cast<double>(tau_.size()), packed_, tau_.size()); }
MatrixXd PivotedQr::R() const { return upper_triangle(packed_, tau_.size()); }

HouseholderQr::HouseholderQr(const MatrixXd& A) : packed_(A), tau_(std::min(A.rows(), A.cols())) {
  const int m = rows(A), n = columns(A), lda = stride(A);
  int info = 0;
  with_workspace(
      [&](double* work, int size) { lapack::dgeqrf_(&m, &n, packed_.data(), &lda, tau_.data(), work, &size, &info); });
}
MatrixXd HouseholderQr::solve_matrix(const Ref<const MatrixXd>& b) const {
  MatrixXd c = b;
  multiply_by_Q('T', packed_, tau_, c);
  divide_by_R(packed_, tau_.size(), c);
  MatrixXd x = MatrixXd::Zero(packed_.cols(), b.cols());
  x.topRows(tau_.size()) = c.topRows(tau_.size());
  return x;
}
VectorXd HouseholderQr::solve_vector(const Ref<const VectorXd>& b) const { return solve_matrix(b); }
MatrixXd HouseholderQr::columns_of_Q(Index count) const {
  MatrixXd Q = MatrixXd::Zero(packed_.rows(), count);
  Q.leftCols(tau_.size()) = packed_.leftCols(tau_.size());
  const int m = rows(Q), n = columns(Q), k = static_cast<int>(tau_.size()), lda = stride(Q);
  int info = 0;
  with_workspace(
      [&](double* work, int size) { lapack::dorgqr_(&m, &n, &k, Q.data(), &lda, tau_.data(), work, &size, &info); });
  return Q;
}
MatrixXd HouseholderQr::thin_Q() const { return columns_of_Q(packed_.cols()); }
MatrixXd HouseholderQr::full_Q() const { return columns_of_Q(packed_.rows()); }
MatrixXd HouseholderQr::R() const { return upper_triangle(packed_, packed_.cols()); }
VectorXd HouseholderQr::rotated(const VectorXd& b) const {
  MatrixXd c = b;
  multiply_by_Q('T', packed_, tau_, c);
  return c;
}

CompleteQr::CompleteQr(const MatrixXd& A, std::optional<double> threshold) : packed_(A) {
  pivoted(packed_, tau_, order_);
  rank_ = pivots_above(threshold.value_or(epsilon * static_cast<double>(tau_.size())), packed_, tau_.size());
  // (R S; 0 0) = (T 0; 0 0) Z, which has something to do only where columns are left over.
  const int n = columns(A), r = static_cast<int>(rank_), lda = stride(A);
  right_tau_.resize(rank_);
  int info = 0;
  if (r > 0 && r < n)
    with_workspace([&](double* work, int size) {
      lapack::dtzrzf_(&r, &n, packed_.data(), &lda, right_tau_.data(), work, &size, &info);
    });
}
VectorXd CompleteQr::solve(const VectorXd& b) const {
  MatrixXd c = b;
  multiply_by_Q('T', packed_, tau_, c);
  divide_by_R(packed_, rank_, c);
  MatrixXd x = MatrixXd::Zero(packed_.cols(), 1);
  x.topRows(rank_) = c.topRows(rank_);
  const int n = columns(packed_), one = 1, r = static_cast<int>(rank_), left = n - r, lda = stride(packed_), ldx = n;
  int info = 0;
  if (r > 0 && left > 0)
    with_workspace([&](double* work, int size) {
      lapack::dormrz_("L", "T", &n, &one, &r, &left, packed_.data(), &lda, right_tau_.data(), x.data(), &ldx, work,
                      &size, &info, 1, 1);
    });
  return unsorted(x, order_);
}

struct Lu::Factors {
  Eigen::PartialPivLU<MatrixXd> lu;
};
Lu::Lu() : factors_(new Factors) {}
Lu::Lu(const MatrixXd& A) : Lu() { compute(A); }
Lu::~Lu() = default;
Lu::Lu(Lu&&) noexcept = default;
Lu& Lu::operator=(Lu&&) noexcept = default;
void Lu::compute(const MatrixXd& A) { factors_->lu.compute(A); }
VectorXd Lu::solve_vector(const Ref<const VectorXd>& b) const { return factors_->lu.solve(b); }
MatrixXd Lu::solve_matrix(const Ref<const MatrixXd>& b) const { return factors_->lu.solve(b); }
double Lu::rcond() const { return factors_->lu.rcond(); }

ComplexLu::ComplexLu(const MatrixXcd& A)
    : packed_(A),
      pivots_(static_cast<std::size_t>(A.rows())),
      norm_(A.size() > 0 ? A.cwiseAbs().colwise().sum().maxCoeff() : 0) {
  ensure(A.rows() == A.cols(), "LU of a square matrix");
  const int n = rows(A), lda = stride(A);
  int info = 0;  // above zero where a pivot is; what solve() then gives is not finite, and rcond() is zero
  lapack::zgetrf_(&n, &n, packed_.data(), &lda, pivots_.data(), &info);
}
MatrixXcd ComplexLu::solve_matrix(const Ref<const MatrixXcd>& b) const {
  MatrixXcd x = b;
  const int n = rows(packed_), k = columns(b), lda = stride(packed_);
  int info = 0;
  lapack::zgetrs_("N", &n, &k, packed_.data(), &lda, pivots_.data(), x.data(), &lda, &info, 1);
  return x;
}
VectorXcd ComplexLu::solve_vector(const Ref<const VectorXcd>& b) const { return solve_matrix(b); }
double ComplexLu::rcond() const {
  if (!std::isfinite(norm_)) return std::numeric_limits<double>::quiet_NaN();
  const int n = rows(packed_), lda = stride(packed_);
  std::vector<lapack::Complex> work(2 * pivots_.size());
  std::vector<double> real_work(2 * pivots_.size());
  double out = 0;
  int info = 0;
  lapack::zgecon_("1", &n, packed_.data(), &lda, &norm_, &out, work.data(), real_work.data(), &info, 1);
  return out;
}

Cholesky::Cholesky(const MatrixXd& A) : L_(A) {
  const int n = rows(A), lda = stride(A);
  lapack::dpotrf_("L", &n, L_.data(), &lda, &failed_at_, 1);
  if (!L_.diagonal().allFinite()) failed_at_ = n;  // OpenBLAS takes a pivot that is no number for a positive one
}
MatrixXd Cholesky::solve(const MatrixXd& b) const {
  MatrixXd x = b;
  const int n = rows(L_), k = columns(b), lda = stride(L_);
  int info = 0;
  lapack::dpotrs_("L", &n, &k, L_.data(), &lda, x.data(), &lda, &info, 1);
  return x;
}
MatrixXd Cholesky::L() const { return upper_triangle(L_.transpose(), L_.rows()).transpose(); }

MatrixXd inverse(const MatrixXd& A) { return Lu(A).solve(MatrixXd::Identity(A.rows(), A.cols())); }

MatrixXd symmetric_part(const MatrixXd& A) { return (A + A.transpose()) / 2; }

namespace {
/// LAPACK says nothing of matrices that are not finite; what comes of them is not finite either.
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

SymmetricEigen symmetric(const MatrixXd& A, const char* with_vectors) {
  const int n = rows(A), lda = stride(A);
  SymmetricEigen out{VectorXd::Constant(n, not_a_number), A};
  if (!A.allFinite()) return {out.values, MatrixXd::Constant(n, n, not_a_number)};
  int info = 0;
  with_workspace([&](double* work, int size) {
    lapack::dsyev_(with_vectors, "L", &n, out.vectors.data(), &lda, out.values.data(), work, &size, &info, 1, 1);
  });
  check_converged(info, "eigenvalues");
  return out;
}

SingularValues decomposed(MatrixXd A, const char* with_vectors) {
  const int m = rows(A), n = columns(A), least = std::min(m, n), lda = stride(A), ldvt = std::max(1, least);
  VectorXd values = VectorXd::Constant(least, not_a_number);
  MatrixXd U = MatrixXd::Constant(m, least, not_a_number), Vt = MatrixXd::Constant(least, n, not_a_number);
  if (!A.allFinite()) return {values, U, Vt.transpose()};
  int info = 0;
  with_workspace([&](double* work, int size) {
    lapack::dgesvd_(with_vectors, with_vectors, &m, &n, A.data(), &lda, values.data(), U.data(), &lda, Vt.data(), &ldvt,
                    work, &size, &info, 1, 1);
  });
  check_converged(info, "singular values");
  return {values, U, Vt.transpose()};
}
}  // namespace

SymmetricEigen symmetric_eigen(const MatrixXd& A) { return symmetric(A, "V"); }
VectorXd symmetric_eigenvalues(const MatrixXd& A) { return symmetric(A, "N").values; }

VectorXcd eigenvalues(const MatrixXd& A) {
  const int n = rows(A), lda = stride(A), one = 1;
  if (!A.allFinite()) return VectorXcd::Constant(n, not_a_number);
  MatrixXd scratch = A;
  VectorXd real(n), imaginary(n);
  int info = 0;
  with_workspace([&](double* work, int size) {
    lapack::dgeev_("N", "N", &n, scratch.data(), &lda, real.data(), imaginary.data(), nullptr, &one, nullptr, &one,
                   work, &size, &info, 1, 1);
  });
  check_converged(info, "eigenvalues");
  VectorXcd out(n);
  for (Index i = 0; i < n; ++i) out[i] = {real[i], imaginary[i]};
  return out;
}

SingularValues svd(const MatrixXd& A) { return decomposed(A, "S"); }
VectorXd singular_values(const MatrixXd& A) { return decomposed(A, "N").values; }

LowRank low_rank(const MatrixXcd& A, double least) {
  const int m = rows(A), n = columns(A), lda = stride(A), pivots = std::min(m, n);
  MatrixXcd packed = A;
  VectorXcd tau(pivots);
  std::vector<int> order(static_cast<std::size_t>(n), 0);
  std::vector<double> norms(2 * order.size());
  int info = 0;
  with_workspace<lapack::Complex>([&](lapack::Complex* work, int size) {
    lapack::zgeqp3_(&m, &n, packed.data(), &lda, order.data(), tau.data(), work, &size, norms.data(), &info);
  });
  int rank = 0;
  while (rank < pivots && std::abs(packed(rank, rank)) > least) ++rank;
  LowRank out{packed.leftCols(rank), MatrixXcd::Zero(rank, n)};
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < std::min(rank, j + 1); ++i) out.R(i, order[static_cast<std::size_t>(j)] - 1) = packed(i, j);
  with_workspace<lapack::Complex>([&](lapack::Complex* work, int size) {
    lapack::zungqr_(&m, &rank, &rank, out.Q.data(), &lda, tau.data(), work, &size, &info);
  });
  return out;
}

}  // namespace hydro::dense
