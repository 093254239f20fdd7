#include "fit/least_squares.hpp"

#include <ceres/ceres.h>

#include <cmath>
#include <limits>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "quiet_logging.hpp"

namespace fit {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Hands a ResidualModel to Ceres: one parameter block, the model's own Jacobian.
class ModelCost : public ceres::CostFunction {
 public:
  explicit ModelCost(const ResidualModel& model) : model_(model) {
    set_num_residuals(static_cast<int>(model.residuals));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(model.parameters.size()));
  }
  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const auto p = static_cast<Eigen::Index>(model_.parameters.size());
    const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(parameters[0], p);
    Eigen::VectorXd r(model_.residuals);
    Eigen::MatrixXd jacobian;
    const bool wanted = jacobians != nullptr && jacobians[0] != nullptr;
    if (wanted) jacobian.resize(model_.residuals, p);
    model_.evaluate(x, r, wanted ? &jacobian : nullptr);
    Eigen::Map<Eigen::VectorXd>(residuals, model_.residuals) = r;
    if (wanted) Eigen::Map<RowMajor>(jacobians[0], model_.residuals, p) = jacobian;
    return r.allFinite() && (!wanted || jacobian.allFinite());
  }

 private:
  const ResidualModel& model_;
};

void check(const ResidualModel& model, const Eigen::VectorXd& x) {
  const auto p = static_cast<Eigen::Index>(model.parameters.size());
  hydro::require(x.size() == p, "the start has {} values, the model {} parameters", x.size(), p);
  hydro::require(model.residuals >= p && p > 0, "{} observations cannot give {} parameters", model.residuals, p);
  for (const auto& parameter : model.parameters)
    hydro::require(std::isfinite(parameter.scale) && parameter.scale > 0, "the scale of {} must be positive, got {}",
                   parameter.name, parameter.scale);
}

// The combination of parameters along one right singular vector, "cd" or "0.71 ca + 0.71 mass".
std::string direction_name(const ResidualModel& model, const Eigen::VectorXd& v, std::vector<bool>& identifiable) {
  constexpr double share = 0.05;  // of the vector's length; less is not worth naming
  std::vector<std::string> parts;
  std::size_t last = 0;
  for (std::size_t j = 0; j < model.parameters.size(); ++j) {
    const double c = v[static_cast<Eigen::Index>(j)];
    if (std::abs(c) < share) continue;
    parts.push_back(fmt::format("{:.2f} {}", c, model.parameters[j].name));
    identifiable[j] = false;
    last = j;
  }
  return parts.size() == 1 ? model.parameters[last].name : fmt::format("{}", fmt::join(parts, " + "));
}

// (F2)
void judge(const ResidualModel& model, const Eigen::MatrixXd& jacobian, FitReport& report) {
  constexpr double not_seen = 1e-10;
  const auto p = static_cast<Eigen::Index>(model.parameters.size());
  Eigen::VectorXd scale(p);
  for (Eigen::Index j = 0; j < p; ++j) scale[j] = model.parameters[static_cast<std::size_t>(j)].scale;
  const Eigen::MatrixXd scaled = jacobian * scale.asDiagonal();
  const auto svd = hydro::dense::svd(scaled);
  report.singular_values = svd.values;
  report.identifiable.assign(static_cast<std::size_t>(p), true);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(p, p);
  for (Eigen::Index i = 0; i < p; ++i) {
    const Eigen::VectorXd v = svd.V.col(i);
    const double s = report.singular_values[i];
    if (s > not_seen * report.singular_values[0]) {
      covariance += v * v.transpose() / (s * s);
      continue;
    }
    report.identifiability += fmt::format("{}the data do not see {} (singular value {:.2g} against {:.2g})",
                                          report.identifiability.empty() ? "" : "; ",
                                          direction_name(model, v, report.identifiable), s, report.singular_values[0]);
  }
  report.covariance = scale.asDiagonal() * covariance * scale.asDiagonal();
  for (Eigen::Index j = 0; j < p; ++j)
    if (!report.identifiable[static_cast<std::size_t>(j)]) {
      report.covariance.row(j).setConstant(std::numeric_limits<double>::quiet_NaN());
      report.covariance.col(j).setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  if (report.identifiability.empty()) report.identifiability = "every parameter is seen by the data";
}

ceres::Solver::Options solver_options(const StopWhen& stop) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = stop.cost_change_below;
  options.gradient_tolerance = stop.gradient_below;
  options.parameter_tolerance = stop.step_below;
  options.max_num_iterations = stop.iterations_reach;
  // Nearly Gauss–Newton from the start: a linear problem should not pay for damping.
  options.initial_trust_region_radius = 1e12;
  // A simulation may fail far away; five steps in a row, the usual limit, are few where each is half of the last.
  options.max_num_consecutive_invalid_steps = 20;
  options.logging_type = ceres::SILENT;
  return options;
}

/// Runs Ceres from x and fills the first half of the report. \return where it ended
std::vector<double> search(const ResidualModel& model, const Eigen::VectorXd& x, const StopWhen& stop,
                           FitReport& report) {
  std::vector<double> trial(x.data(), x.data() + x.size());
  ceres::Problem problem;
  problem.AddResidualBlock(new ModelCost(model), nullptr, trial.data());
  for (std::size_t j = 0; j < trial.size(); ++j) {
    const auto& parameter = model.parameters[j];
    if (std::isfinite(parameter.lowest))
      problem.SetParameterLowerBound(trial.data(), static_cast<int>(j), parameter.lowest);
    if (std::isfinite(parameter.highest))
      problem.SetParameterUpperBound(trial.data(), static_cast<int>(j), parameter.highest);
  }
  ceres::Solver::Summary summary;
  {
    const QuietLogging quiet;
    ceres::Solve(solver_options(stop), &problem, &summary);
  }
  report.iterations = static_cast<int>(summary.iterations.size()) - 1;
  report.cost_first = summary.initial_cost;
  report.cost_last = summary.final_cost;
  report.gradient_norm = summary.iterations.back().gradient_max_norm;
  report.why = summary.message;
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
      report.outcome = FitReport::Outcome::converged;
      break;
    case ceres::NO_CONVERGENCE:
      report.outcome = FitReport::Outcome::out_of_iterations;
      break;
    default:
      report.outcome = FitReport::Outcome::not_finite;
      break;
  }
  return trial;
}

}  // namespace

FitReport minimise(const ResidualModel& model, Eigen::VectorXd& x, const StopWhen& stop) {  // (F1)
  check(model, x);
  FitReport report{};
  Eigen::VectorXd r(model.residuals);
  Eigen::MatrixXd jacobian(model.residuals, x.size());
  model.evaluate(x, r, &jacobian);
  if (!r.allFinite() || !jacobian.allFinite()) {  // Ceres would end without a first cost
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    report.outcome = FitReport::Outcome::not_finite;
    report.cost_first = report.cost_last = report.gradient_norm = nan;
    report.why = "residuals or Jacobian are not finite at the start";
    report.identifiable.assign(model.parameters.size(), false);
    report.identifiability = report.why;
    report.covariance = Eigen::MatrixXd::Constant(x.size(), x.size(), nan);
    report.singular_values = Eigen::VectorXd::Constant(x.size(), nan);
    return report;
  }
  const std::vector<double> best = search(model, x, stop, report);
  if (report.cost_last < report.cost_first)
    x = Eigen::Map<const Eigen::VectorXd>(best.data(), static_cast<Eigen::Index>(best.size()));
  model.evaluate(x, r, &jacobian);
  judge(model, jacobian, report);
  return report;
}

}  // namespace fit
