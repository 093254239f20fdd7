#pragma once
/// \file  Linear fits that a few wild samples do not pull away; (F39), docs/theory/fit.md.
#include <Eigen/Core>

namespace fit {

/// Huber's estimate: squares up to 1.345 deviations, straight beyond. 95 % as good as least squares for Gaussian noise.
struct RobustFit {
  Eigen::VectorXd x;          ///< shape (p)
  Eigen::VectorXd influence;  ///< ψ(e): the residuals, those beyond the bound set to it, shape (n)
  double deviation;           ///< of the residuals, from their median distance from zero
  double share_inside;  ///< of samples within the bound; cov x̂ = that of least squares with ψ for e, over its square
  int rounds;
};
/// Least squares with weights that follow the residuals, until coefficients change by less than 1e-8 of their errors.
/// A tenth of wild samples does no harm; half of them do. It guards against wild forces, not against wild motions.
/// \throws hydro::InputError for shapes that disagree; hydro::NumericsError if weights do not settle in 100 rounds
RobustFit fit_huber(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target);

}  // namespace fit
