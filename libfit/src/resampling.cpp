#include "fit/resampling.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

#include "block_means.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace fit {
namespace {

/// The sandwich's outer part for the full record, from block means: (JᵀJ)⁻¹ and the factor of the middle.
struct Outer {
  Eigen::MatrixXd inverse;
  double factor;
};
Outer outer(const Eigen::MatrixXd& jacobian, Eigen::Index blocks, int block) {
  const double covered = static_cast<double>(jacobian.rows()) / static_cast<double>(blocks * block);
  return {hydro::dense::inverse(jacobian.transpose() * jacobian), block * block * covered};
}

}  // namespace

CoefficientCovariance cluster_covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals,
                                         double period_samples, int block) {  // (F27)
  CoefficientCovariance result = correlated_covariance(jacobian, residuals, block);
  const Eigen::Index n = jacobian.rows(), p = jacobian.cols();
  hydro::require(period_samples >= 4, "a period of {:.3g} samples is no cluster", period_samples);
  // Whole clusters of equal length, the remainder shared out among them.
  const auto clusters = static_cast<Eigen::Index>(std::floor(static_cast<double>(n) / period_samples + 1e-6));
  hydro::require(clusters >= 6, "intervals from single cycles need six of them at least, the record has {}", clusters);
  Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(p, p);
  for (Eigen::Index c = 0; c < clusters; ++c) {
    const Eigen::Index from = n * c / clusters, to = n * (c + 1) / clusters;
    const Eigen::VectorXd sum = jacobian.middleRows(from, to - from).transpose() * residuals.segment(from, to - from);
    middle += sum * sum.transpose();
  }
  const auto g = static_cast<double>(clusters);
  const Eigen::MatrixXd inverse = hydro::dense::inverse(jacobian.transpose() * jacobian);
  result.covariance = g / (g - static_cast<double>(p)) * inverse * middle * inverse;
  result.effective_samples =
      static_cast<double>(n) * result.white_covariance.diagonal().cwiseQuotient(result.covariance.diagonal());
  result.dof = g - static_cast<double>(p);
  result.dof_raised = false;
  return result;
}

CoefficientCovariance bootstrap_covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals,
                                           const BootstrapOptions& options) {  // (F28)
  hydro::require(options.draws >= 10, "a bootstrap needs at least 10 draws, got {}", options.draws);
  CoefficientCovariance result = correlated_covariance(jacobian, residuals, options.block);
  const Eigen::MatrixXd means = block_means(jacobian, options.block);
  Eigen::VectorXd e = block_means(residuals, options.block);
  const Eigen::Index n = e.size(), p = jacobian.cols();
  const Eigen::VectorXd gamma = fit_autoregression(e).autocovariance;
  const double memory = gamma.cwiseAbs().sum() / gamma[0];
  const double usual = std::clamp(8 * memory, std::cbrt(static_cast<double>(n)), static_cast<double>(n) / 10);
  const auto length = static_cast<Eigen::Index>(options.length > 0 ? options.length : std::ceil(usual));
  hydro::require(length >= 1 && static_cast<double>(length) >= 3 * memory && 2 * length <= n,
                 "the residuals are correlated over {:.3g} of {} averaged samples: blocks of {} hold too little of "
                 "that, or are too few",
                 memory, n, length);
  e.array() -= e.mean();
  // What the fit took out of the residuals (F4), and what blocks lose that begin and end anywhere.
  const double lost = result.residual_share_lost;
  e /= std::sqrt(1 - lost);
  const hydro::RandomStream random(options.seed, 0);
  const Outer o = outer(jacobian, n, options.block);
  Eigen::MatrixXd middle = Eigen::MatrixXd::Zero(p, p);
  std::uint64_t drawn = 0;
  for (int d = 0; d < options.draws; ++d) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(p);
    for (Eigen::Index at = 0; at < n; at += length) {
      const Eigen::Index rows = std::min(length, n - at);
      const auto from = static_cast<Eigen::Index>(random.uniform(drawn++) * static_cast<double>(n - length + 1));
      sum += means.middleRows(at, rows).transpose() * e.segment(from, rows);
    }
    middle += sum * sum.transpose() / options.draws;
  }
  result.covariance = o.factor * o.inverse * middle * o.inverse;
  result.effective_samples = static_cast<double>(jacobian.rows()) *
                             result.white_covariance.diagonal().cwiseQuotient(result.covariance.diagonal());
  return result;
}

}  // namespace fit
