#include "fit/least_squares.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fit/search_watch.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/look_up.hpp"
#include "quiet_logging.hpp"

namespace fit {
namespace {

// Of residuals of order one: rounding of what they are differences of, and no residual at all.
constexpr double perfect_residual = 1e-9;

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
    hydro::look_up();
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

/// Parameters that stand at a bound and would go beyond it.
std::vector<int> held_at_bounds(const ResidualModel& model, const Eigen::VectorXd& x, const Eigen::VectorXd& r,
                                const Eigen::MatrixXd& jacobian) {
  std::vector<int> out;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const auto& q = model.parameters[static_cast<std::size_t>(j)];
    const double slope = jacobian.col(j).dot(r);
    if ((x[j] <= q.lowest && slope > 0) || (x[j] >= q.highest && slope < 0)) out.push_back(static_cast<int>(j));
  }
  return out;
}

/// (F65) ‖P r‖²/‖r‖², P the projection onto what the columns span; 0 where the fit is perfect. Derivatives that are
/// differences are good to 1e-4: a direction that is weaker than that promises errors of its own, and is left out.
double promised_share(const std::vector<int>& held, const Eigen::VectorXd& r, const Eigen::MatrixXd& jacobian) {
  if (r.norm() <= perfect_residual * std::sqrt(static_cast<double>(r.size()))) return 0;
  Eigen::MatrixXd columns = jacobian;
  for (const int j : held) columns.col(j).setZero();
  for (auto column : columns.colwise())
    if (const double norm = column.norm(); norm > 0) column /= norm;
  if (columns.isZero(0)) return 0;
  return (columns * hydro::dense::CompleteQr(columns, 1e-4).solve(r)).squaredNorm() / r.squaredNorm();
}

// (F2)
void judge(const ResidualModel& model, const Eigen::MatrixXd& jacobian, SearchReport& report) {
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
  options.initial_trust_region_radius = stop.trust_radius;
  // A simulation may fail far away; five steps in a row, the usual limit, are few where each is half of the last.
  options.max_num_consecutive_invalid_steps = 20;
  options.logging_type = ceres::SILENT;
  return options;
}

/// Tells whoever watches this thread how far a search is.
class ToldIterations : public ceres::IterationCallback {
 public:
  explicit ToldIterations(const StopWhen& stop) : stop_(stop) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& now) override {
    if (now.iteration > 0) SearchWatch::current()->come_to(std::max(decades(now), spent(now)));
    return ceres::SOLVER_CONTINUE;
  }

 private:
  double decades(const ceres::IterationSummary& now) const {
    const double change = std::abs(now.cost_change) / std::max(now.cost, std::numeric_limits<double>::min());
    if (!now.step_is_successful || !(change < 1)) return 0;
    return std::min(1.0,
                    std::log(std::max(change, std::numeric_limits<double>::min())) / std::log(stop_.cost_change_below));
  }
  double spent(const ceres::IterationSummary& now) const {
    return std::min(1.0, static_cast<double>(now.iteration) / std::max(1, stop_.iterations_reach));
  }
  const StopWhen& stop_;
};

/// Runs Ceres from x, some parameters held, and fills the first half of the report. \return where it ended
std::vector<double> search(const ResidualModel& model, const Eigen::VectorXd& x, const std::vector<int>& held,
                           const StopWhen& stop, SearchReport& report) {
  std::vector<double> trial(x.data(), x.data() + x.size());
  ceres::Problem problem;
  problem.AddResidualBlock(new ModelCost(model), nullptr, trial.data());
  if (held.size() == trial.size())
    problem.SetParameterBlockConstant(trial.data());
  else if (!held.empty())
    problem.SetManifold(trial.data(), new ceres::SubsetManifold(static_cast<int>(trial.size()), held));
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
    ceres::Solver::Options options = solver_options(stop);
    ToldIterations told(stop);
    if (SearchWatch::current() != nullptr) options.callbacks.push_back(&told);
    ceres::Solve(options, &problem, &summary);
    if (SearchWatch::current() != nullptr) SearchWatch::current()->end_search();
  }
  // Where every parameter is held there is nothing to iterate.
  report.iterations = std::max(0, static_cast<int>(summary.iterations.size()) - 1);
  report.cost_first = summary.initial_cost;
  report.cost_last = summary.final_cost;
  report.gradient_norm = summary.iterations.empty() ? 0 : summary.iterations.back().gradient_max_norm;
  report.trust_radius = summary.iterations.empty() ? stop.trust_radius : summary.iterations.back().trust_region_radius;
  report.why = summary.message;
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
      report.outcome = SearchReport::Outcome::converged;
      break;
    case ceres::NO_CONVERGENCE:
      report.outcome = SearchReport::Outcome::out_of_iterations;
      break;
    default:
      report.outcome = SearchReport::Outcome::not_finite;
      break;
  }
  return trial;
}

/// Ceres cuts its steps off at bounds, and the other parameters then go to where they would be without them. So what
/// stands at a bound and would cross it is held there, and the others are searched for alone, until no more come or go.
/// Residuals and Jacobian are those of x, before and after. \return what is held in the end
std::vector<int> search_with_bounds(const ResidualModel& model, StopWhen stop, Eigen::VectorXd& x, Eigen::VectorXd& r,
                                    Eigen::MatrixXd& jacobian, SearchReport& report) {
  const double cost_first = r.squaredNorm() / 2;
  int iterations = 0;
  std::vector<int> held = held_at_bounds(model, x, r, jacobian);
  while (true) {
    const std::vector<double> best = search(model, x, held, stop, report);
    if (report.cost_last < report.cost_first)
      x = Eigen::Map<const Eigen::VectorXd>(best.data(), static_cast<Eigen::Index>(best.size()));
    model.evaluate(x, r, &jacobian);
    iterations += report.iterations;
    stop.iterations_reach -= std::max(1, report.iterations);
    const std::vector<int> now = held_at_bounds(model, x, r, jacobian);
    const bool settled = now == held;
    held = now;
    if (!settled && report.ended() && stop.iterations_reach <= 0)
      report.outcome = SearchReport::Outcome::out_of_iterations;
    if (settled || !report.ended()) break;
  }
  report.cost_first = cost_first;
  report.iterations = iterations;
  return held;
}

}  // namespace

SearchReport minimise(const ResidualModel& model, Eigen::VectorXd& x, const StopWhen& stop) {  // (F1)
  check(model, x);
  SearchReport report{};
  Eigen::VectorXd r(model.residuals);
  Eigen::MatrixXd jacobian(model.residuals, x.size());
  model.evaluate(x, r, &jacobian);
  if (!r.allFinite() || !jacobian.allFinite()) {  // Ceres would end without a first cost
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    report.outcome = SearchReport::Outcome::not_finite;
    report.cost_first = report.cost_last = report.gradient_norm = report.promised = nan;
    report.trust_radius = stop.trust_radius;
    report.why = "residuals or Jacobian are not finite at the start";
    report.identifiable.assign(model.parameters.size(), false);
    report.identifiability = report.why;
    report.covariance = Eigen::MatrixXd::Constant(x.size(), x.size(), nan);
    report.singular_values = Eigen::VectorXd::Constant(x.size(), nan);
    return report;
  }
  const std::vector<int> held = search_with_bounds(model, stop, x, r, jacobian, report);
  report.promised = promised_share(held, r, jacobian);
  if (report.ended() && report.promised * static_cast<double>(model.residuals) > 1)
    report.outcome = SearchReport::Outcome::stuck;
  judge(model, jacobian, report);
  return report;
}

}  // namespace fit
