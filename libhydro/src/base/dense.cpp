#include "hydro/base/dense.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <utility>

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

struct ComplexLu::Factors {
  Eigen::PartialPivLU<MatrixXcd> lu;
};
ComplexLu::ComplexLu(const MatrixXcd& A) : factors_(new Factors{Eigen::PartialPivLU<MatrixXcd>(A)}) {}
ComplexLu::~ComplexLu() = default;
ComplexLu::ComplexLu(ComplexLu&&) noexcept = default;
VectorXcd ComplexLu::solve_vector(const Ref<const VectorXcd>& b) const { return factors_->lu.solve(b); }
double ComplexLu::rcond() const { return factors_->lu.rcond(); }
MatrixXcd ComplexLu::solve_matrix(const Ref<const MatrixXcd>& b) const { return factors_->lu.solve(b); }

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
