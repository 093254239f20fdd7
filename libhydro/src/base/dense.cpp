#include "hydro/base/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <complex>
#include <mutex>
#include <utility>
#include <vector>

#include "hydro/base/error.hpp"

extern "C" {
// LAPACK, as a Fortran compiler calls it: the length of each text stands after all other arguments.
using LapackComplex = std::complex<double>;
void zgetrf_(const int* m, const int* n, LapackComplex* a, const int* lda, int* pivots, int* info);
void zgetrs_(const char* trans, const int* n, const int* columns, const LapackComplex* factors, const int* lda,
             const int* pivots, LapackComplex* b, const int* ldb, int* info, std::size_t trans_length);
void zgecon_(const char* norm, const int* n, const LapackComplex* factors, const int* lda, const double* norm_of_a,
             double* rcond, LapackComplex* work, double* real_work, int* info, std::size_t norm_length);
// Of OpenBLAS alone; null with another LAPACK.
[[gnu::weak]] int openblas_get_num_threads();
[[gnu::weak]] void openblas_set_num_threads(int);
}

namespace hydro::dense {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::Ref;
using Eigen::VectorXcd;
using Eigen::VectorXd;

struct PivotedQr::Factors {
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
};
PivotedQr::PivotedQr(const MatrixXd& A) : factors_(new Factors{Eigen::ColPivHouseholderQR<MatrixXd>(A)}) {}
PivotedQr::~PivotedQr() = default;
PivotedQr::PivotedQr(PivotedQr&&) noexcept = default;
VectorXd PivotedQr::solve_vector(const Ref<const VectorXd>& b) const { return factors_->qr.solve(b); }
MatrixXd PivotedQr::solve_matrix(const Ref<const MatrixXd>& b) const { return factors_->qr.solve(b); }
Eigen::Index PivotedQr::rank() const { return factors_->qr.rank(); }
MatrixXd PivotedQr::R() const {
  const MatrixXd& packed = factors_->qr.matrixQR();
  return packed.topRows(std::min(packed.rows(), packed.cols())).triangularView<Eigen::Upper>();
}

struct HouseholderQr::Factors {
  Eigen::HouseholderQR<MatrixXd> qr;
};
HouseholderQr::HouseholderQr(const MatrixXd& A) : factors_(new Factors{Eigen::HouseholderQR<MatrixXd>(A)}) {}
HouseholderQr::~HouseholderQr() = default;
HouseholderQr::HouseholderQr(HouseholderQr&&) noexcept = default;
VectorXd HouseholderQr::solve_vector(const Ref<const VectorXd>& b) const { return factors_->qr.solve(b); }
MatrixXd HouseholderQr::solve_matrix(const Ref<const MatrixXd>& b) const { return factors_->qr.solve(b); }
MatrixXd HouseholderQr::thin_Q() const {
  const auto& qr = factors_->qr;
  return qr.householderQ() * MatrixXd::Identity(qr.rows(), qr.cols());
}
MatrixXd HouseholderQr::full_Q() const { return factors_->qr.householderQ(); }
MatrixXd HouseholderQr::R() const {
  const auto& qr = factors_->qr;
  return qr.matrixQR().topRows(qr.cols()).triangularView<Eigen::Upper>();
}
VectorXd HouseholderQr::rotated(const VectorXd& b) const { return factors_->qr.householderQ().transpose() * b; }

struct CompleteQr::Factors {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> qr;
};
CompleteQr::CompleteQr(const MatrixXd& A, std::optional<double> threshold) {
  auto factors = std::make_unique<Factors>();
  if (threshold) factors->qr.setThreshold(*threshold);
  factors->qr.compute(A);
  factors_ = std::move(factors);
}
CompleteQr::~CompleteQr() = default;
CompleteQr::CompleteQr(CompleteQr&&) noexcept = default;
CompleteQr& CompleteQr::operator=(CompleteQr&&) noexcept = default;
VectorXd CompleteQr::solve(const VectorXd& b) const { return factors_->qr.solve(b); }
Eigen::Index CompleteQr::rank() const { return factors_->qr.rank(); }

struct Lu::Factors {
  Eigen::PartialPivLU<MatrixXd> lu;
};
Lu::Lu(const MatrixXd& A) : factors_(new Factors{Eigen::PartialPivLU<MatrixXd>(A)}) {}
Lu::~Lu() = default;
Lu::Lu(Lu&&) noexcept = default;
VectorXd Lu::solve(const VectorXd& b) const { return factors_->lu.solve(b); }

namespace {

/// While one lives, OpenBLAS works on the thread that calls it: threads share frequencies here, and sums whose order
/// the number of threads decides would differ by rounding. The last gives back what was set before the first.
class OneBlasThread {
 public:
  OneBlasThread() {
    if (openblas_set_num_threads == nullptr) return;
    const std::lock_guard lock(living_mutex_);
    if (living_++ > 0) return;
    before_ = openblas_get_num_threads();
    if (before_ != 1) openblas_set_num_threads(1);
  }
  ~OneBlasThread() {
    if (openblas_set_num_threads == nullptr) return;
    const std::lock_guard lock(living_mutex_);
    if (--living_ == 0 && before_ != 1) openblas_set_num_threads(before_);
  }
  OneBlasThread(const OneBlasThread&) = delete;
  OneBlasThread& operator=(const OneBlasThread&) = delete;

 private:
  static inline std::mutex living_mutex_;
  static inline int living_ = 0, before_ = 1;
};

int as_int(Eigen::Index n) { return static_cast<int>(n); }

}  // namespace

struct ComplexLu::Factors {
  MatrixXcd lu;
  std::vector<int> pivots;
  double norm = 0;  // of A, the largest sum of a column
};

ComplexLu::ComplexLu(const MatrixXcd& A)
    : factors_([&A] {
        ensure(A.rows() == A.cols(), "a matrix with factors is square");
        auto made = std::make_unique<Factors>(A, std::vector<int>(static_cast<std::size_t>(A.rows())));
        if (A.size() == 0) return made;
        made->norm = A.cwiseAbs2().cwiseSqrt().colwise().sum().maxCoeff();
        const OneBlasThread one;
        const int n = as_int(A.rows());
        int info = 0;  // a zero pivot is no error here: solutions are not finite then, and rcond is zero
        zgetrf_(&n, &n, made->lu.data(), &n, made->pivots.data(), &info);
        return made;
      }()) {}
ComplexLu::~ComplexLu() = default;
ComplexLu::ComplexLu(ComplexLu&&) noexcept = default;

VectorXcd ComplexLu::solve_vector(const Ref<const VectorXcd>& b) const { return solve_matrix(b); }

MatrixXcd ComplexLu::solve_matrix(const Ref<const MatrixXcd>& b) const {
  ensure(b.rows() == factors_->lu.rows(), "a right-hand side has the rows of the matrix");
  MatrixXcd x = b;
  if (x.size() == 0) return x;
  const OneBlasThread one;
  const int n = as_int(x.rows()), columns = as_int(x.cols());
  int info = 0;
  zgetrs_("N", &n, &columns, factors_->lu.data(), &n, factors_->pivots.data(), x.data(), &n, &info, 1);
  return x;
}

double ComplexLu::rcond() const {
  if (factors_->lu.size() == 0) return 1;
  const OneBlasThread one;
  const int n = as_int(factors_->lu.rows());
  std::vector<LapackComplex> work(2 * factors_->pivots.size());
  std::vector<double> real_work(2 * factors_->pivots.size());
  double rcond = 0;
  int info = 0;
  zgecon_("1", &n, factors_->lu.data(), &n, &factors_->norm, &rcond, work.data(), real_work.data(), &info, 1);
  return rcond;
}

struct Cholesky::Factors {
  Eigen::LLT<MatrixXd> llt;
};
Cholesky::Cholesky(const MatrixXd& A) : factors_(new Factors{Eigen::LLT<MatrixXd>(A)}) {}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky::operator bool() const { return factors_->llt.info() == Eigen::Success; }
MatrixXd Cholesky::solve(const MatrixXd& b) const { return factors_->llt.solve(b); }
MatrixXd Cholesky::L() const { return factors_->llt.matrixL(); }

MatrixXd inverse(const MatrixXd& A) { return A.inverse(); }

MatrixXd symmetric_part(const MatrixXd& A) { return (A + A.transpose()) / 2; }

SymmetricEigen symmetric_eigen(const MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(A);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}
VectorXd symmetric_eigenvalues(const MatrixXd& A) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues();
}

MatrixXd positive_part(const MatrixXd& A) {
  const auto [values, vectors] = symmetric_eigen(A);
  return values[0] >= 0 ? A : MatrixXd(vectors * values.cwiseMax(0).asDiagonal() * vectors.transpose());
}

VectorXcd eigenvalues(const MatrixXd& A) {
  return Eigen::EigenSolver<MatrixXd>(A, /*computeEigenvectors=*/false).eigenvalues();
}

SingularValues svd(const MatrixXd& A) {
  const Eigen::JacobiSVD<MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}
VectorXd singular_values(const MatrixXd& A) { return Eigen::JacobiSVD<MatrixXd>(A).singularValues(); }

}  // namespace hydro::dense
