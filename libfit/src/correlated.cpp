#include "fit/correlated.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

#include "block_means.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "rest_memory.hpp"

namespace fit {
namespace {

// Divided by n, not n − k: only so is the sequence non-negative definite and the autoregression stationary.
Eigen::VectorXd sample_autocovariance(const Eigen::VectorXd& x, Eigen::Index lags) {
  const Eigen::Index n = x.size();
  Eigen::VectorXd gamma(lags + 1);
  for (Eigen::Index k = 0; k <= lags; ++k) gamma[k] = x.head(n - k).dot(x.tail(n - k)) / static_cast<double>(n);
  return gamma;
}

// γ_k = Σ φ_i γ_{k−i} beyond the order, until it has died out.
Eigen::VectorXd extended(const Eigen::VectorXd& gamma, const Eigen::VectorXd& phi, Eigen::Index n) {
  const Eigen::Index p = phi.size();
  std::vector<double> g(gamma.data(), gamma.data() + p + 1);
  while (static_cast<Eigen::Index>(g.size()) < n) {
    double next = 0, recent = 0;
    for (Eigen::Index i = 1; i <= p; ++i) {
      const double earlier = g[g.size() - static_cast<std::size_t>(i)];
      next += phi[i - 1] * earlier;
      recent = std::max(recent, std::abs(earlier));
    }
    if (recent < 1e-6 * g[0]) break;
    g.push_back(next);
  }
  return Eigen::Map<const Eigen::VectorXd>(g.data(), static_cast<Eigen::Index>(g.size()));
}

// Jᵀ Σ J with the Toeplitz matrix Σ_ij = γ_|i−j|.
Eigen::MatrixXd toeplitz_form(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& gamma) {
  const Eigen::Index n = jacobian.rows();
  Eigen::MatrixXd sum = gamma[0] * jacobian.transpose() * jacobian;
  for (Eigen::Index k = 1; k < std::min(gamma.size(), n); ++k) {
    const Eigen::MatrixXd lagged = jacobian.topRows(n - k).transpose() * jacobian.bottomRows(n - k);
    sum += gamma[k] * (lagged + lagged.transpose());
  }
  return sum;
}

/// Levinson–Durbin gives every order up to the highest; BIC = n ln σ²_p + p ln n picks one. (F3)
Eigen::VectorXd best_autoregression(const Eigen::VectorXd& gamma, Eigen::Index n) {
  const auto samples = static_cast<double>(n);
  Eigen::VectorXd phi(0), best(0);
  double variance = gamma[0];
  double best_bic = samples * std::log(variance);
  for (Eigen::Index p = 1; p < gamma.size(); ++p) {
    const double reflection = (gamma[p] - (p > 1 ? phi.dot(gamma.segment(1, p - 1).reverse()) : 0.0)) / variance;
    Eigen::VectorXd next(p);
    if (p > 1) next.head(p - 1) = phi - reflection * phi.reverse();
    next[p - 1] = reflection;
    phi = next;
    variance *= 1 - reflection * reflection;
    if (!(variance > 0)) break;  // a perfectly predictable record
    const double bic = samples * std::log(variance) + static_cast<double>(p) * std::log(samples);
    if (bic < best_bic) {
      best_bic = bic;
      best = phi;
    }
  }
  return best;
}

/// Adds what a known part does to the coefficients, `changes` by each of its draws, shape (p, draws). Degrees of
/// freedom after Welch and Satterthwaite, the mean over the coefficients. (F69)
void add_known(const Eigen::MatrixXd& changes, CoefficientCovariance& u) {
  const auto draws = static_cast<double>(changes.cols());
  const Eigen::MatrixXd known = changes * changes.transpose() / draws;
  const Eigen::ArrayXd share = known.diagonal().array() / (known + u.covariance).diagonal().array();
  u.covariance += known;
  u.dof_raised = u.dof_raised && share.mean() < 0.5;
  u.dof = 1 / ((1 - share).square() / u.dof + share.square() / draws).mean();
}

constexpr Eigen::Index highest_order = 20;

/// The autoregression of what is left of a record beside its known part. (F69)
Autoregression fit_rest(const Eigen::VectorXd& record, const Eigen::MatrixXd& known) {
  const Eigen::Index n = record.size();
  const RestMemory rest = rest_memory(record, known, std::min(highest_order, n / 8));
  const Eigen::VectorXd phi = best_autoregression(rest.ratio, n);
  return {phi, rest.level * extended(rest.ratio, phi, n)};
}

}  // namespace

Autoregression fit_autoregression(const Eigen::VectorXd& record, int order_at_most) {  // (F3)
  const Eigen::Index n = record.size();
  hydro::require(n >= 8, "an autoregression needs at least 8 samples, got {}", n);
  const Eigen::VectorXd gamma = sample_autocovariance(record, std::min<Eigen::Index>(order_at_most, n / 8));
  hydro::require(gamma[0] > 0, "the residuals are all zero: they have no autocovariance");
  const Eigen::VectorXd best = best_autoregression(gamma, n);
  return {best, extended(gamma, best, n)};
}

double memory_of_squares(const Autoregression& series) {
  const Eigen::VectorXd& gamma = series.autocovariance;
  return 1 + 2 * (gamma.tail(gamma.size() - 1) / std::max(gamma[0], 1e-300)).squaredNorm();
}

CoefficientCovariance correlated_covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals,
                                            int block, LongMemory long_memory, const Eigen::MatrixXd& known) {
  const Eigen::Index n = jacobian.rows(), p = jacobian.cols();
  hydro::require(residuals.size() == n, "{} residuals but a Jacobian of {} rows", residuals.size(), n);
  hydro::require(known.size() == 0 || known.rows() == n, "{} residuals but known parts of {} rows", n, known.rows());
  hydro::require(block >= 1 && n / block >= 8 && n > p, "{} samples in blocks of {} are too few for an uncertainty", n,
                 block);
  const hydro::dense::PivotedQr qr(jacobian);
  hydro::require(qr.rank() == p, "the coefficients cannot be told apart: the Jacobian has rank {} of {}", qr.rank(), p);
  const Eigen::MatrixXd inverse = hydro::dense::inverse(jacobian.transpose() * jacobian);

  const Eigen::MatrixXd means = block_means(jacobian, block);
  const Eigen::VectorXd residual_means = block_means(residuals, block);
  const auto ar =
      known.size() == 0 ? fit_autoregression(residual_means) : fit_rest(residual_means, block_means(known, block));
  const auto blocks = static_cast<double>(means.rows());
  const double covered = static_cast<double>(n) / (blocks * block);  // samples after the last whole block count as well
  const Eigen::MatrixXd block_inverse = hydro::dense::inverse(means.transpose() * means);
  Eigen::MatrixXd meat = toeplitz_form(means, ar.autocovariance);
  // The fit took tr(P Σ) out of the residuals' sum of squares (for white residuals: p σ²); put it back.
  double lost = ar.autocovariance[0] > 0 ? (block_inverse * meat).trace() / (blocks * ar.autocovariance[0]) : 0.0;
  const bool too_long = lost >= 0.5;
  hydro::require(!too_long || long_memory == LongMemory::widen,
                 "the residuals stay correlated over so much of the record that {} coefficients explain most of them",
                 p);
  lost = std::min(lost, 0.5);
  meat /= 1 - lost;

  CoefficientCovariance result;
  result.residual_share_lost = lost;
  result.covariance = inverse * meat * inverse * (block * block * covered);  // (F4)
  result.white_dof = static_cast<double>(n - p);
  result.white_covariance = residuals.squaredNorm() / result.white_dof * inverse;
  // The formula is about random residuals. A residual that repeats is known exactly, yet gives next to nothing here;
  // two is the least for which Student's t has a quantile of use (4.3 at 95 %).
  const double formula = blocks / memory_of_squares(ar) - static_cast<double>(p);
  result.dof_raised = formula < 2 || too_long;
  result.dof = result.dof_raised ? 2 : formula;
  if (known.size() > 0) add_known(inverse * (jacobian.transpose() * known), result);
  result.effective_samples =
      static_cast<double>(n) * result.white_covariance.diagonal().cwiseQuotient(result.covariance.diagonal());
  result.order = static_cast<int>(ar.coefficients.size());
  result.block = block;
  return result;
}

Coefficient with_interval(const std::string& name, double value, const CoefficientCovariance& u, Eigen::Index j,
                          double confidence) {
  using hydro::signal::student_t_quantile;
  Coefficient c;
  c.name = name;
  c.value = value;
  c.standard_error = std::sqrt(u.covariance(j, j));
  const double half = student_t_quantile((1 + confidence) / 2, u.dof) * c.standard_error;
  const double white = student_t_quantile((1 + confidence) / 2, u.white_dof) * std::sqrt(u.white_covariance(j, j));
  c.interval = {value - half, value + half};
  c.white_interval = {value - white, value + white};
  c.effective_samples = u.effective_samples[j];
  return c;
}

}  // namespace fit
