#include "dynamics/integrate/generalized_alpha.hpp"

#include "hydro/base/error.hpp"

namespace dynamics {

GeneralizedAlpha::GeneralizedAlpha(const Model& model, const Settings& settings) : NewtonIntegrator(model) {
  const double rho = settings.rho_infinity;
  hydro::require(rho >= 0 && rho <= 1, "rho_infinity must lie between 0 and 1, got {}", rho);
  alpha_m_ = (2 * rho - 1) / (rho + 1);  // (D11)
  alpha_f_ = rho / (rho + 1);
  gamma_ = 0.5 + alpha_f_ - alpha_m_;
  beta_ = 0.25 * (gamma_ + 0.5) * (gamma_ + 0.5);
}

NewtonIntegrator::Slopes GeneralizedAlpha::slopes(double h) const {
  const double s = (1 - alpha_f_) / (1 - alpha_m_), place = s * beta_ * h * h, speed = s * gamma_ * h;
  return {place, speed, place, speed};
}

State GeneralizedAlpha::end_of_step(const Workspace& workspace, double h, const Eigen::VectorXd& acceleration) const {
  const Eigen::VectorXd &v = workspace.state.velocity, algorithmic = algorithmic_after(workspace, acceleration);
  const Eigen::VectorXd move = h * v + h * h * ((0.5 - beta_) * algorithmic_ + beta_ * algorithmic);  // (D9)
  return displaced(workspace.state, move, v + h * ((1 - gamma_) * algorithmic_ + gamma_ * algorithmic), h);
}

// (D10)
Eigen::VectorXd GeneralizedAlpha::algorithmic_after(const Workspace& workspace,
                                                    const Eigen::VectorXd& acceleration) const {
  return ((1 - alpha_f_) * acceleration + alpha_f_ * workspace.acceleration - alpha_m_ * algorithmic_) / (1 - alpha_m_);
}

}  // namespace dynamics
