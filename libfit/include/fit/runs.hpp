#pragma once
/// \file  One law for many runs: coefficients against Keulegan-Carpenter, Reynolds or frequency number, with runs that
///        differ by more than their own intervals say; (F31)-(F33), docs/theory/fit.md.
#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

#include "fit/coefficient.hpp"

namespace fit {

/// What a run tells about one coefficient, and the numbers it was made at.
struct RunEstimate {
  double value;
  double standard_error;  ///< > 0
  double kc, re, beta;    ///< > 0 where a law asks for them; β = Re/KC = D²/(νT)
  std::string file = {};  ///< that errors of this run are placed at; "": they give its number
};

/// C = c_0 + c_1 ln(x/x₀) + …, x₀ the geometric mean over the runs, so that c_0 is the value in their middle.
enum class Law { constant, kc, re, beta, kc_and_re };
std::string name_of(Law law);  ///< "constant", "ln KC", …

struct RandomEffects {
  Law law;
  std::vector<std::string> terms;   ///< "constant", "ln(KC/12.3)" …
  Eigen::VectorXd coefficients;     ///< shape (p)
  Eigen::MatrixXd covariance;       ///< shape (p, p), (F32)
  std::vector<Interval> intervals;  ///< Student, n − p degrees of freedom
  double between;                   ///< τ: standard deviation from run to run beyond the runs' own errors (REML)
  double heterogeneity;             ///< I² = τ²/(τ² + typical own variance), 0 … 1
  Interval prediction;              ///< where the next run in the middle of these should come out
  double log_likelihood;            ///< at the maximum over coefficients and τ
  double aicc, bic;                 ///< −2 ln L + penalties of p + 1 parameters; AICc = ∞ where n <= p + 2
  double cross_validation;          ///< rms error of predicting each run from the others
  Eigen::VectorXd residuals;        ///< value minus law, shape (n)
};

/// Fits one law to runs with random effects: value_i = law(x_i) + b_i + e_i, b_i ~ N(0, τ²), e_i ~ N(0, σ_i²).
/// Errors of the coefficients after Knapp & Hartung (2003), never smaller than the runs' own errors alone give.
/// \throws hydro::InputError for fewer than p + 2 runs, errors not positive, numbers not positive, or runs that do not
/// differ in what the law asks for
RandomEffects fit_runs(std::span<const RunEstimate> runs, Law law, double confidence = 0.95);

/// All laws that the runs can tell, best AICc first. \throws hydro::InputError for fewer than 3 runs
std::vector<RandomEffects> compare_laws(std::span<const RunEstimate> runs, double confidence = 0.95);

}  // namespace fit
