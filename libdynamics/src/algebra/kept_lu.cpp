#include "algebra/kept_lu.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"

namespace dynamics {

using Eigen::Index;
using Eigen::VectorXd;

bool KeptDenseLu::factorise(const Eigen::MatrixXd& matrix) {
  constexpr double working_precision = 1e-15;
  lu_.compute(matrix);
  const double size = matrix.cwiseAbs().colwise().sum().maxCoeff();
  return size > 0 && 1 / (size * size_of_inverse()) > working_precision;
}

/// Aᵀx = b of the factors PA = LU.
void KeptDenseLu::solve_transposed(const VectorXd& right, VectorXd& out) {
  permuted_ = right;
  lu_.matrixLU().triangularView<Eigen::Upper>().transpose().solveInPlace(permuted_);
  lu_.matrixLU().triangularView<Eigen::UnitLower>().transpose().solveInPlace(permuted_);
  out.resize(right.size());
  for (Index i = 0; i < out.size(); ++i) out[i] = permuted_[lu_.permutationP().indices()[i]];
}

/// ‖A⁻¹‖₁, estimated from below: up the gradient of ‖A⁻¹x‖₁ from corner to corner of the x with ‖x‖₁ = 1, and one x of
/// alternating signs besides (Hager 1984; Higham 1988, algorithm 4.1).
double KeptDenseLu::size_of_inverse() {
  constexpr int corners = 4;
  const Index n = lu_.rows();
  right_.setConstant(n, 1.0 / static_cast<double>(n));
  solve(right_, found_);
  double size = found_.lpNorm<1>();
  if (n == 1) return size;
  Index corner = -1;
  for (int k = 0; k < corners; ++k) {
    sign_ = found_.unaryExpr([](double x) { return x < 0 ? -1.0 : 1.0; });
    if (k > 0 && sign_ == sign_before_) break;
    solve_transposed(sign_, right_);
    Index next = 0;
    right_.cwiseAbs().maxCoeff(&next);
    if (next == corner) break;
    corner = next;
    right_.setZero();
    right_[corner] = 1;
    solve(right_, found_);
    if (found_.lpNorm<1>() <= size) break;
    size = found_.lpNorm<1>();
    sign_before_.swap(sign_);
  }
  for (Index i = 0; i < n; ++i)
    right_[i] = (i % 2 == 0 ? 1 : -1) * (1 + static_cast<double>(i) / static_cast<double>(n - 1));
  solve(right_, found_);
  return std::max(size, 2 * found_.lpNorm<1>() / (3 * static_cast<double>(n)));
}

bool KeptSparseLu::factorise(Matrix& matrix) {
  if (m_numeric != nullptr && refactorise(matrix)) return true;
  if (m_symbolic == nullptr) analyzePattern(matrix);
  factorize(matrix);
  return info() == Eigen::Success;
}

/// By the pivots of the matrix before. \returns false where numbers grow on the way: other pivots then do better
bool KeptSparseLu::refactorise(Matrix& matrix) {
  constexpr double least = 1e-4;  // largest number of a column over the largest of its factors: costs four digits
  int *columns = matrix.outerIndexPtr(), *rows = matrix.innerIndexPtr();
  double* values = matrix.valuePtr();
  return klu_refactor(columns, rows, values, m_symbolic, m_numeric, &m_common) != 0 &&
         klu_rgrowth(columns, rows, values, m_symbolic, m_numeric, &m_common) != 0 && m_common.rgrowth >= least;
}

void KeptSparseLu::solve_in_place(double* b, Index rows, Index columns) {
  const bool solved =
      klu_solve(m_symbolic, m_numeric, static_cast<int>(rows), static_cast<int>(columns), b, &m_common) != 0;
  hydro::ensure(solved, "factors that are there solve");
}

}  // namespace dynamics
