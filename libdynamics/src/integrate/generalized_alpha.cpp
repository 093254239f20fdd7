#include "dynamics/integrate/generalized_alpha.hpp"

#include "hydro/base/error.hpp"

namespace dynamics {

GeneralizedAlpha::GeneralizedAlpha(const Model& model, const Settings& settings)
    : NewtonIntegrator(model), alpha_(settings.rho_infinity) {
  hydro::require(settings.rho_infinity >= 0 && settings.rho_infinity <= 1,
                 "rho_infinity must lie between 0 and 1, got {}", settings.rho_infinity);
}

NewtonIntegrator::Slopes GeneralizedAlpha::slopes(double h) const {
  const double s = (1 - alpha_.alpha_f) / (1 - alpha_.alpha_m), place = s * alpha_.beta * h * h,
               speed = s * alpha_.gamma * h;
  return {place, speed, place, speed};
}

State GeneralizedAlpha::end_of_step(const Workspace& workspace, double h, const Eigen::VectorXd& acceleration) const {
  const Eigen::VectorXd &v = workspace.state.velocity, algorithmic = algorithmic_after(workspace, acceleration);
  const Eigen::VectorXd move =
      h * v + h * h * ((0.5 - alpha_.beta) * algorithmic_ + alpha_.beta * algorithmic);  // (D9)
  return displaced(workspace.state, move, v + h * ((1 - alpha_.gamma) * algorithmic_ + alpha_.gamma * algorithmic), h);
}

// (D10)
Eigen::VectorXd GeneralizedAlpha::algorithmic_after(const Workspace& workspace,
                                                    const Eigen::VectorXd& acceleration) const {
  return ((1 - alpha_.alpha_f) * acceleration + alpha_.alpha_f * workspace.acceleration -
          alpha_.alpha_m * algorithmic_) /
         (1 - alpha_.alpha_m);
}

}  // namespace dynamics
