#include "dynamics/integrate/generalized_alpha.hpp"

#include <cmath>
#include <limits>

#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

GeneralizedAlpha::GeneralizedAlpha(const Model& model, const Settings& settings) : model_(model), settings_(settings) {
  const double rho = settings.rho_infinity;
  hydro::require(rho >= 0 && rho <= 1, "rho_infinity must lie between 0 and 1, got {}", rho);
  alpha_m_ = (2 * rho - 1) / (rho + 1);  // (D11)
  alpha_f_ = rho / (rho + 1);
  gamma_ = 0.5 + alpha_f_ - alpha_m_;
  beta_ = 0.25 * (gamma_ + 0.5) * (gamma_ + 0.5);
  BlockMatrix mass(model.pattern());
  model.add_mass(rest_state(model.bodies()), 1, mass);
  scale_ = mass.dense().diagonal().cwiseSqrt();
}

void GeneralizedAlpha::start(Workspace& workspace) {
  workspace.acceleration.setZero();
  const Eigen::VectorXd r = model_.residual(workspace.state, workspace.acceleration, workspace);
  model_.tangent(workspace.state, 1, 0, 0, workspace, workspace.matrix);
  if (!r.allFinite() || !workspace.solver.factorise(workspace.matrix))
    throw hydro::NumericsError(fmt::format(
        "no accelerations can be found at the start, t = {} s: the loads or the mass matrix are not finite or singular",
        workspace.state.time));
  workspace.acceleration = -workspace.solver.solve(r);
  algorithmic_ = workspace.acceleration;
}

void GeneralizedAlpha::predict(const Workspace& workspace, double h, const Eigen::VectorXd& acceleration,
                               State& next) const {
  const State& now = workspace.state;
  const Eigen::VectorXd algorithmic =
      ((1 - alpha_f_) * acceleration + alpha_f_ * workspace.acceleration - alpha_m_ * algorithmic_) / (1 - alpha_m_);
  const Eigen::VectorXd move = h * now.velocity + h * h * ((0.5 - beta_) * algorithmic_ + beta_ * algorithmic);  // (D9)
  next.time = now.time + h;
  next.velocity = now.velocity + h * ((1 - gamma_) * algorithmic_ + gamma_ * algorithmic);
  next.pose.resize(now.pose.size());
  for (std::size_t i = 0; i < now.pose.size(); ++i) {
    const auto row = 6 * static_cast<Eigen::Index>(i);
    next.pose[i].centre = now.pose[i].centre + move.segment<3>(row);
    next.pose[i].attitude = (rotation_exp(move.segment<3>(row + 3)) * now.pose[i].attitude).normalized();
  }
}

bool GeneralizedAlpha::try_step(Workspace& workspace, double h, StepReport& report) {
  const double s = (1 - alpha_f_) / (1 - alpha_m_);
  State next;
  Eigen::VectorXd a = workspace.acceleration;
  predict(workspace, h, a, next);
  Eigen::VectorXd r = model_.residual(next, a, workspace);
  const auto size_of = [&](const Eigen::VectorXd& residual) { return residual.cwiseQuotient(scale_).norm(); };
  double size = size_of(r);
  for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
    if (!std::isfinite(size)) {
      failure_ = "the loads are not finite";
      return false;
    }
    ++report.newton_iterations;
    // The exponential map turns by J(Δθ) ≈ 1 + Δθ×/2; leaving that out costs Newton some speed, not the solution.
    model_.tangent(next, 1, s * gamma_ * h, s * beta_ * h * h, workspace, workspace.matrix);
    if (!workspace.solver.factorise(workspace.matrix)) {
      failure_ = "the iteration matrix is singular";
      return false;
    }
    const Eigen::VectorXd correction = -workspace.solver.solve(r);
    double factor = 1;
    Eigen::VectorXd trial, trial_r;
    double trial_size = std::numeric_limits<double>::infinity();
    for (; factor > 1e-3; factor /= 2) {
      trial = a + factor * correction;
      predict(workspace, h, trial, next);
      trial_r = model_.residual(next, trial, workspace);
      trial_size = size_of(trial_r);
      if (trial_size <= size) break;
      // At round-off the residual cannot fall any more: the full correction is as good as it gets.
      if (factor == 1 &&
          correction.cwiseProduct(scale_).norm() <= settings_.newton_tolerance * trial.cwiseProduct(scale_).norm())
        break;
    }
    if (!std::isfinite(trial_size)) {
      failure_ = "the loads are not finite";
      return false;
    }
    a = trial;
    r = trial_r;
    size = trial_size;
    const double reach = a.cwiseProduct(scale_).norm() + next.velocity.cwiseProduct(scale_).norm() / h;
    if (factor == 1 && correction.cwiseProduct(scale_).norm() <= settings_.newton_tolerance * reach) {
      algorithmic_ =
          ((1 - alpha_f_) * a + alpha_f_ * workspace.acceleration - alpha_m_ * algorithmic_) / (1 - alpha_m_);  // (D10)
      workspace.state = std::move(next);
      workspace.acceleration = std::move(a);
      return true;
    }
  }
  Eigen::Index worst = 0;
  r.cwiseQuotient(scale_).cwiseAbs().maxCoeff(&worst);
  failure_ = fmt::format("Newton did not converge in {} iterations; worst equation: {}", settings_.iterations,
                         model_.mode_name(static_cast<int>(worst)));
  return false;
}

void GeneralizedAlpha::advance(Workspace& workspace, double h, int depth, StepReport& report) {
  if (try_step(workspace, h, report)) return;
  if (depth == settings_.deepest_halving)
    throw hydro::NumericsError(fmt::format("the run cannot go on from t = {:.6g} s, even with a step of {:.3g} s: {}",
                                           workspace.state.time, h, failure_));
  ++report.halvings;
  advance(workspace, h / 2, depth + 1, report);
  advance(workspace, h / 2, depth + 1, report);
}

StepReport GeneralizedAlpha::step(Workspace& workspace, double h) {
  StepReport report;
  advance(workspace, h, 0, report);
  workspace.accept();
  return report;
}

}  // namespace dynamics
