#pragma once
/// \file  Two more ways to the covariance of coefficients from correlated residuals, which do not suppose that the
///        residuals are an autoregression; (F27)-(F28), docs/theory/fit.md.
#include <cstdint>

#include "fit/correlated.hpp"

namespace fit {

/// Cluster-robust covariance: the record is cut into stretches of one period; only sums over whole stretches are taken
/// as independent. It needs cycles rather than a model of the noise, and is as wide as Student's t of cycles − 1.
/// What repeats in every cycle cancels in these sums: as with (F4), it is no scatter and is not covered.
/// \throws hydro::InputError as correlated_covariance(), and for fewer than six periods
CoefficientCovariance cluster_covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals,
                                         double period_samples, int block = 1);

struct BootstrapOptions {
  int block = 1;    ///< samples averaged first, as in correlated_covariance()
  int draws = 500;  ///< the standard error is then known to 3 %
  std::uint64_t seed = 1;
  int length = 0;  ///< of the blocks drawn, in averaged samples; 0: eight times the memory, between n^{1/3} and n/10
};
/// Moving-block bootstrap of the residuals (Künsch 1989, Annals of Statistics 17): stretches of residuals are drawn
/// with replacement, laid end to end, and fitted; the covariance is that of the fits. \throws hydro::InputError as
/// above, for fewer than 10 draws, and for blocks shorter than three times the memory of the residuals
CoefficientCovariance bootstrap_covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals,
                                           const BootstrapOptions& options = {});

}  // namespace fit
