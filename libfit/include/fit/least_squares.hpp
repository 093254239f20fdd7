#pragma once
/// \file  Least squares: problem in, report out; (F1)-(F2), docs/theory/fit.md.
#include <Eigen/Core>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace fit {

/// Residuals r(x) of n observations and their Jacobian dr/dx, for p parameters.
struct ResidualModel {
  struct Parameter {
    std::string name;
    double scale = 1;  ///< > 0; a change of the parameter that matters, in its unit: judges what the data can see
    double lowest = -std::numeric_limits<double>::infinity();  ///< the search stays between these two
    double highest = std::numeric_limits<double>::infinity();
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
  /// Levenberg–Marquardt damps by one over this at first: nearly Gauss–Newton, so that a linear problem pays nothing.
  double trust_radius = 1e12;
};

struct SearchReport {
  /// `stuck`: no step lowers the cost, yet the Jacobian promises that one would: it jumps there, or is wrong. (F65)
  enum class Outcome { converged, stuck, out_of_iterations, not_finite } outcome;
  int iterations;
  double cost_first, cost_last;     ///< ½‖r‖²
  double gradient_norm;             ///< max |∂cost/∂x_i| at the end
  double promised;                  ///< share of the cost that a Gauss–Newton step from the end would take off; (F65)
  double trust_radius;              ///< at the end
  std::string why;                  ///< one sentence, fit for a log
  Eigen::VectorXd singular_values;  ///< of J·diag(scale) at the end, largest first, shape (p); (F2)
  std::vector<bool> identifiable;   ///< per parameter; false where a direction that the data do not see involves it
  std::string identifiability;      ///< one sentence per direction not seen, naming its parameters
  Eigen::MatrixXd covariance;  ///< (JᵀJ)⁻¹, shape (p, p), times σ² for white residuals; NaN where not identifiable
  bool ended() const { return outcome == Outcome::converged; }
  bool all_identifiable() const {
    return std::find(identifiable.begin(), identifiable.end(), false) == identifiable.end();
  }
};

/// Minimises ½‖r(x)‖² from the start x (Ceres: Levenberg–Marquardt, dense QR). `x` is replaced only if the cost fell.
/// A direction counts as not seen if its singular value is below 1e-10 of the largest (rounding of r alone would move
/// it freely). Ceres writes nothing to standard error: unless the program has initialised glog, messages of glog that
/// are not fatal are dropped while the search runs. \throws hydro::InputError if x has another length, n < p, or a
/// scale is not positive
SearchReport minimise(const ResidualModel& model, Eigen::VectorXd& x, const StopWhen& stop = {});

/// The same least-squares problem with few rows; (F1).
struct Compressed {
  Eigen::MatrixXd columns;  ///< R of columns = QR, shape (p, p)
  Eigen::VectorXd target;   ///< Qᵀ target, shape (p)
  double rest;              ///< ‖target − Q Qᵀ target‖, which no parameter can change
};
/// Compresses n rows of a linear model columns·x ≈ target to p, exactly up to rounding: fit the p rows instead.
/// Cost 2np² and one pass over memory where the columns are well apart. \throws hydro::InputError for n <= p
Compressed compress(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target);

/// The compressed problem as a residual model: residuals over `unit`, names and scales as given.
ResidualModel linear_model(const Compressed& problem, std::vector<ResidualModel::Parameter> parameters, double unit);

}  // namespace fit
