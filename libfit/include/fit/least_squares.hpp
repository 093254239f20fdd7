#pragma once
/// \file  Least squares: problem in, report out; (F1)-(F2), docs/theory/fit.md.
#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace fit {

/// Residuals r(x) of n observations and their Jacobian dr/dx, for p parameters.
struct ResidualModel {
  struct Parameter {
    std::string name;
    double scale = 1;  ///< > 0; a change of the parameter that matters, in its unit: judges what the data can see
  };
  std::vector<Parameter> parameters;  ///< p of them
  Eigen::Index residuals;             ///< n
  /// Fills r, shape (n), and unless it is null the Jacobian, shape (n, p). May be called in any order.
  std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian)> evaluate;
};

/// The search ends as soon as one of these holds.
struct StopWhen {
  double cost_change_below = 1e-15;  ///< |Δcost| <= this · cost: rounding of the cost itself
  double gradient_below = 1e-14;     ///< max |∂cost/∂x_i| <= this: a perfect fit of residuals of order one
  double step_below = 1e-14;         ///< ‖Δx‖ <= this · ‖x‖: rounding of x
  int iterations_reach = 100;        ///< a linear problem takes five to ten
};

struct FitReport {
  enum class Outcome { converged, out_of_iterations, not_finite } outcome;
  int iterations;
  double cost_first, cost_last;     ///< ½‖r‖²
  double gradient_norm;             ///< max |∂cost/∂x_i| at the end
  std::string why;                  ///< one sentence, fit for a log
  Eigen::VectorXd singular_values;  ///< of J·diag(scale) at the end, largest first, shape (p); (F2)
  std::vector<bool> identifiable;   ///< per parameter; false where a direction that the data do not see involves it
  std::string identifiability;      ///< one sentence per direction not seen, naming its parameters
  Eigen::MatrixXd covariance;  ///< (JᵀJ)⁻¹, shape (p, p), times σ² for white residuals; NaN where not identifiable
};

/// Minimises ½‖r(x)‖² from the start x (Ceres: Levenberg–Marquardt, dense QR). `x` is replaced only if the cost fell.
/// A direction counts as not seen if its singular value is below 1e-10 of the largest (rounding of r alone would move
/// it freely). \throws hydro::InputError if x has another length, n < p, or a scale is not positive
FitReport minimise(const ResidualModel& model, Eigen::VectorXd& x, const StopWhen& stop = {});

}  // namespace fit
