#pragma once
/// \file  Linear fits that a few wild samples do not pull away; (F39), docs/theory/fit.md.
#include <Eigen/Core>

namespace fit {

/// How a residual e counts, in deviations σ of the residuals.
enum class RobustLoss {
  huber,          ///< e²/2 up to 1.345 σ, straight beyond: 95 % as good as least squares for Gaussian noise
  bisquare,       ///< Tukey's: less and less, and for nothing beyond 4.685 σ; 95 % as good too
  least_absolute  ///< |e|: 64 % as good for Gaussian noise, better where residuals have long tails
};

struct RobustFit {
  Eigen::VectorXd x;          ///< shape (p)
  Eigen::VectorXd influence;  ///< ψ(e), the slope of what a residual counts, shape (n)
  double deviation;           ///< σ of the residuals, from their median distance from zero
  double slope;               ///< mean of ψ'; cov x̂ = that of least squares with ψ/slope for e
  double share_inside;        ///< of samples within 1.345 σ, bisquare: 4.685 σ
  int rounds;
};
/// Newton steps by one factorisation, with σ of the first rounds; the bisquare begins from Huber's estimate and ends in
/// the minimum next to it. Least absolute residuals are taken as squares within ±σ n^(−1/3), which shifts coefficients
/// by as little of their errors. A tenth of wild samples does no harm; half of them do. It guards against wild forces,
/// not against wild motions. \throws hydro::InputError for shapes that disagree; hydro::NumericsError if the search
/// does not settle in 200 rounds
RobustFit fit_robust(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target, RobustLoss loss);

}  // namespace fit
