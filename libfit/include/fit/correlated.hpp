#pragma once
/// \file  Uncertainty of least-squares coefficients when residuals are correlated in time; (F3)-(F4),
/// docs/theory/fit.md.
///
/// Samples taken at 1 kHz of a force that changes within a second are not a thousand independent facts. Treating them
/// as such makes bounds too narrow by the square root of (samples / effective samples).
#include <Eigen/Core>

#include <string>

#include "fit/coefficient.hpp"

namespace fit {

/// Autocovariance of a stationary autoregressive series fitted to a record (Yule–Walker, order by BIC); (F3).
struct Autoregression {
  Eigen::VectorXd coefficients;    ///< φ_1 … φ_p; e_t = Σ φ_i e_{t−i} + white
  Eigen::VectorXd autocovariance;  ///< γ_0, γ_1 … until |γ_k| < 1e-6 γ_0 or the record's length
};
/// \throws hydro::InputError for fewer than 8 samples or a record that is constant zero
Autoregression fit_autoregression(const Eigen::VectorXd& record, int order_at_most = 20);

/// 1 + 2Σρ²: so many squares of such a series are worth one that is independent of the others.
double memory_of_squares(const Autoregression& series);

struct CoefficientCovariance {
  Eigen::MatrixXd covariance;         ///< of the coefficients, honest for correlated residuals, shape (p, p); (F4)
  Eigen::MatrixXd white_covariance;   ///< what white residuals would give: σ²(JᵀJ)⁻¹, for comparison
  Eigen::VectorXd effective_samples;  ///< n·white/honest variance, per coefficient: white samples worth as much
  double dof;                         ///< for Student's t with `covariance`: n_b/(1 + 2Σρ²) − p, but at least 2
  bool dof_raised;                    ///< the formula gave less than 2: the residuals repeat rather than scatter,
                                      ///< or hardly forget within the record
  double white_dof;                   ///< n − p
  double residual_share_lost;         ///< of the residuals' sum of squares, taken out by the fit and put back
  int order;                          ///< of the autoregression
  int block;                          ///< samples averaged before it was fitted
};

/// What to do where residuals stay correlated over so much of the record that the coefficients took more than half of
/// them: what is left then says little of what there was.
enum class LongMemory {
  refuse,  ///< throw
  widen    ///< twice the variance that is left, and Student's t of two degrees of freedom (`dof_raised`)
};

/// Covariance of coefficients fitted by ordinary least squares to n samples even in time, by the sandwich (F4) with the
/// autocovariance of an autoregression through block means of the residuals.
///
/// `block` samples are averaged first: choose it so that the columns of the Jacobian hardly change within (a fortieth
/// of the shortest period that matters costs 0.2 %). Valid for stationary residuals that forget within a small part
/// of the record; what a model gets wrong in the same way in every cycle is no noise and is covered in part only.
/// Coverage is tested for white and AR(1) residuals (0.92 to 0.98 for intervals of 0.95).
///
/// `known` are draws of a part of the residuals whose law is known, one a column: noise of a motion that was
/// differentiated, rounding to the steps of a sensor. What it does to the coefficients is taken from the draws
/// themselves, and the autoregression is asked for the rest alone (F69). Without columns: nothing is known.
/// \throws hydro::InputError if shapes disagree, J has not full rank, or the record has fewer than 8 blocks
CoefficientCovariance correlated_covariance(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residuals,
                                            int block = 1, LongMemory long_memory = LongMemory::refuse,
                                            const Eigen::MatrixXd& known = {});

/// Coefficient number j of a fit: its value with the interval of Student's t at `confidence`.
Coefficient with_interval(const std::string& name, double value, const CoefficientCovariance& u, Eigen::Index j,
                          double confidence);

}  // namespace fit
