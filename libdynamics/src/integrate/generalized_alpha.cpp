#include "dynamics/integrate/generalized_alpha.hpp"

#include <cmath>

#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

GeneralizedAlpha::GeneralizedAlpha(const Model& model, const Settings& settings)
    : Integrator(model), settings_(settings) {
  const double rho = settings.rho_infinity;
  hydro::require(rho >= 0 && rho <= 1, "rho_infinity must lie between 0 and 1, got {}", rho);
  alpha_m_ = (2 * rho - 1) / (rho + 1);  // (D11)
  alpha_f_ = rho / (rho + 1);
  gamma_ = 0.5 + alpha_f_ - alpha_m_;
  beta_ = 0.25 * (gamma_ + 0.5) * (gamma_ + 0.5);
}

// How far a joint is open is known to rounding only; divided by ∂q/∂a that is an acceleration, the larger the shorter
// the step, and corrections below it mean nothing.
double GeneralizedAlpha::unresolved(double h) const {
  const double s = (1 - alpha_f_) / (1 - alpha_m_);
  return active().rounding() / (s * beta_ * h * h) * active().scale().norm();
}

State GeneralizedAlpha::predict(const Workspace& workspace, double h, const Eigen::VectorXd& acceleration) const {
  const Eigen::VectorXd &v = workspace.state.velocity, algorithmic = algorithmic_after(workspace, acceleration);
  const Eigen::VectorXd move = h * v + h * h * ((0.5 - beta_) * algorithmic_ + beta_ * algorithmic);  // (D9)
  return displaced(workspace.state, move, v + h * ((1 - gamma_) * algorithmic_ + gamma_ * algorithmic), h);
}

// (D10)
Eigen::VectorXd GeneralizedAlpha::algorithmic_after(const Workspace& workspace,
                                                    const Eigen::VectorXd& acceleration) const {
  return ((1 - alpha_f_) * acceleration + alpha_f_ * workspace.acceleration - alpha_m_ * algorithmic_) / (1 - alpha_m_);
}

GeneralizedAlpha::Trial GeneralizedAlpha::evaluate(Workspace& workspace, double h, Eigen::VectorXd acceleration,
                                                   Eigen::VectorXd multipliers) const {
  Trial out{std::move(acceleration), std::move(multipliers), {}, {}, {}, {}, {}, 0};
  out.state = predict(workspace, h, out.acceleration);
  out.residual = model().residual(out.state, out.acceleration, workspace);
  const JointSet& conditions = active().conditions();
  if (conditions.count() > 0) {
    out.gradients = conditions.gradients(out.state);
    out.columns = active().columns(out.gradients, out.state);
    conditions.add_transposed(out.columns, out.multipliers, out.residual);
    // Divided by ∂q/∂a, the distance by which a joint is open is an acceleration, as large as what closes it; a speed
    // by ∂v/∂a.
    const double s = (1 - alpha_f_) / (1 - alpha_m_);
    out.open = conditions.values(out.state) / (s * beta_ * h * h);
    const Eigen::VectorXd speed = conditions.times(out.gradients, out.state.velocity) / (s * gamma_ * h);
    for (Eigen::Index i = 0; i < out.open.size(); ++i)
      if (conditions.is_on_velocity(i)) out.open[i] = speed[i];
  }
  // Without joints `open` is empty and its norm zero.
  out.size = std::hypot(out.residual.cwiseQuotient(active().scale()).norm(),
                        out.open.cwiseProduct(active().condition_scale()).norm());
  return out;
}

// The step turns body i by exp(Δθ), which varies by J(Δθ) δΔθ; velocities vary by their own.
std::vector<Gradient> GeneralizedAlpha::by_step(const std::vector<Gradient>& G, const State& before,
                                                const State& after) const {
  std::vector<Gradient> out = G;
  const auto turned = [&](int body, Vector6& row) {
    const auto i = static_cast<std::size_t>(body);
    const Eigen::Vector3d turn = rotation_log(after.pose[i].attitude * before.pose[i].attitude.conjugate());
    row.tail<3>() = left_jacobian(turn).transpose() * row.tail<3>();
  };
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (active().conditions().is_on_velocity(static_cast<Eigen::Index>(i))) continue;
    const Condition& c = active().conditions().conditions()[i];
    turned(c.first, out[i].first);
    if (c.second) turned(*c.second, out[i].second);
  }
  return out;
}

bool GeneralizedAlpha::try_step(Workspace& workspace, double h, StepReport& report) {
  const double s = (1 - alpha_f_) / (1 - alpha_m_);
  const Eigen::VectorXd& scale = active().scale();
  Trial now = evaluate(workspace, h, workspace.acceleration, workspace.multipliers);
  const auto settled = [&](double move, double reach) {
    return move <= settings_.newton_tolerance * reach || move <= unresolved(h);
  };
  for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
    if (!std::isfinite(now.size)) return fail("the loads are not finite");
    ++report.newton_iterations;
    // Leaving J out of the loads' derivatives costs Newton some speed, not the solution; joints have it, to close
    // fully.
    model().tangent(now.state, 1, s * gamma_ * h, s * beta_ * h * h, workspace, workspace.matrix);
    active().conditions().add_curvature(now.state, now.multipliers, s * beta_ * h * h, workspace.matrix);
    if (!workspace.solver.factorise(workspace.matrix, now.columns, by_step(now.gradients, workspace.state, now.state),
                                    active().compliance()))
      return fail("the iteration matrix is singular");
    const auto [correction, more] = workspace.solver.solve(-now.residual, -now.open);
    const double move = correction.cwiseProduct(scale).norm();
    Trial trial;
    double factor = 1;
    for (; factor > 1e-3; factor /= 2) {
      trial = evaluate(workspace, h, now.acceleration + factor * correction, now.multipliers + factor * more);
      if (trial.size <= now.size) break;
      // At round-off the residual cannot fall any more: the full correction is as good as it gets.
      if (factor == 1 && settled(move, trial.acceleration.cwiseProduct(scale).norm())) break;
    }
    if (!std::isfinite(trial.size)) return fail("the loads are not finite");
    now = std::move(trial);
    const double reach =
        now.acceleration.cwiseProduct(scale).norm() + now.state.velocity.cwiseProduct(scale).norm() / h;
    if (factor == 1 && settled(move, reach)) {
      algorithmic_ = algorithmic_after(workspace, now.acceleration);
      workspace.state = std::move(now.state);
      workspace.acceleration = std::move(now.acceleration);
      workspace.multipliers = std::move(now.multipliers);
      return true;
    }
  }
  Eigen::Index worst = 0;
  now.residual.cwiseQuotient(scale).cwiseAbs().maxCoeff(&worst);
  return fail(fmt::format("Newton did not converge in {} iterations; worst equation: {}", settings_.iterations,
                          model().mode_name(static_cast<int>(worst))));
}

}  // namespace dynamics
