
#include "fit/least_squares.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace fit {
namespace {

/// Aᵀ A of the rows [A b], summed over stretches that stay in cache.
Eigen::MatrixXd gram(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  constexpr Eigen::Index stretch = 512;
  const Eigen::Index n = a.rows(), p = a.cols();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(p + 1, p + 1);
  for (Eigen::Index from = 0; from < n; from += stretch) {
    const Eigen::Index rows = std::min(stretch, n - from);
    for (Eigen::Index i = 0; i < p; ++i) {
      for (Eigen::Index j = 0; j <= i; ++j) sum(i, j) += a.col(i).segment(from, rows).dot(a.col(j).segment(from, rows));
      sum(p, i) += a.col(i).segment(from, rows).dot(b.segment(from, rows));
    }
    sum(p, p) += b.segment(from, rows).squaredNorm();
  }
  return sum;
}

Compressed by_householder(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target) {
  const Eigen::Index p = columns.cols();
  const hydro::dense::HouseholderQr qr(columns);
  const Eigen::VectorXd rotated = qr.rotated(target);
  return {qr.R(), rotated.head(p), rotated.tail(target.size() - p).norm()};
}

}  // namespace

// Cholesky of the Gram matrix of unit columns squares the condition number, so it is taken only below a condition of
// about 100, where it costs four digits of sixteen; nearly parallel columns go through Householder.
Compressed compress(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target) {  // (F1)
  const Eigen::Index n = columns.rows(), p = columns.cols();
  hydro::require(target.size() == n && n > p, "{} rows and {} targets cannot give {} coefficients", n, target.size(),
                 p);
  const Eigen::MatrixXd g = gram(columns, target);
  const Eigen::VectorXd length = g.diagonal().head(p).cwiseSqrt();
  if (!(length.minCoeff() > 0)) return by_householder(columns, target);
  const Eigen::MatrixXd unit =
      length.cwiseInverse().asDiagonal() * g.topLeftCorner(p, p) * length.cwiseInverse().asDiagonal();
  const hydro::dense::Cholesky cholesky(unit);
  if (!cholesky) return by_householder(columns, target);
  const Eigen::MatrixXd lower = cholesky.L();
  if (lower.diagonal().minCoeff() < 0.01) return by_householder(columns, target);
  const Eigen::VectorXd scaled = length.cwiseInverse().cwiseProduct(g.row(p).head(p).transpose());
  const Eigen::VectorXd rotated = lower.triangularView<Eigen::Lower>().solve(scaled);
  const double left = g(p, p) - rotated.squaredNorm();
  if (left < 1e-6 * g(p, p)) return by_householder(columns, target);  // the difference would be rounding
  return {lower.transpose() * length.asDiagonal(), rotated, std::sqrt(left)};
}

ResidualModel linear_model(const Compressed& problem, std::vector<ResidualModel::Parameter> parameters, double unit) {
  ResidualModel model;
  model.parameters = std::move(parameters);
  model.residuals = problem.target.size() + 1;
  model.evaluate = [problem, unit](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    const Eigen::Index p = problem.target.size();
    r.resize(p + 1);
    r.head(p) = (problem.columns * x - problem.target) / unit;
    r[p] = problem.rest / unit;
    if (jacobian == nullptr) return;
    jacobian->setZero(p + 1, p);
    jacobian->topRows(p) = problem.columns / unit;
  };
  return model;
}

}  // namespace fit
