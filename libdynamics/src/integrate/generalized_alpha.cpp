#include "dynamics/integrate/generalized_alpha.hpp"

#include "hydro/base/error.hpp"

namespace dynamics {

GeneralizedAlpha::GeneralizedAlpha(const Model& model, const Settings& settings)
    : NewtonIntegrator(model, settings.residual_tolerance), alpha_(settings.rho_infinity) {
  hydro::require(settings.rho_infinity >= 0 && settings.rho_infinity <= 1,
                 "rho_infinity must lie between 0 and 1, got {}", settings.rho_infinity);
}

const char* GeneralizedAlpha::steps_stay_whole() const {
  if (model().joints().count() == 0 && !active().may_change()) return nullptr;
  return "with joints, friction or contacts generalised-alpha loses its order while steps change; take "
         "energy_momentum, "
         "or implicit_euler with contacts";
}

void GeneralizedAlpha::save_history(Eigen::VectorXd& out) const {
  out.resize(algorithmic_.size() + 1);
  out << algorithmic_, last_;
}

void GeneralizedAlpha::set_history(const Eigen::VectorXd& was) {
  algorithmic_ = was.head(was.size() - 1);
  last_ = was[was.size() - 1];
}

// (D97) What joints carry does not go straight from step to step: stretched, it would swing up.
void GeneralizedAlpha::prepare(const Workspace& workspace, double h) {
  if (last_ > 0 && last_ != h && active().constraints().count() == 0)
    algorithmic_ = workspace.acceleration + h / last_ * (algorithmic_ - workspace.acceleration);
  last_ = h;
}

NewtonIntegrator::Slopes GeneralizedAlpha::slopes(double h) const {
  const double s = (1 - alpha_.alpha_f) / (1 - alpha_.alpha_m), place = s * alpha_.beta * h * h,
               speed = s * alpha_.gamma * h;
  return {place, speed, place, speed};
}

// (D9)
void GeneralizedAlpha::end_of_step(const Workspace& workspace, double h, const Eigen::VectorXd& acceleration,
                                   State& out) {
  find_algorithmic_after(workspace, acceleration);
  const Eigen::VectorXd &v = workspace.state.velocity, &before = algorithmic_, &after = algorithmic_after_;
  move_ = h * v + h * h * ((0.5 - alpha_.beta) * before + alpha_.beta * after);
  velocity_after_ = v + h * ((1 - alpha_.gamma) * before + alpha_.gamma * after);
  displace(workspace.state, move_, velocity_after_, h, out);
}

void GeneralizedAlpha::accepted(const Workspace& before, const Eigen::VectorXd& acceleration) {
  find_algorithmic_after(before, acceleration);
  algorithmic_ = algorithmic_after_;
}

// (D10)
void GeneralizedAlpha::find_algorithmic_after(const Workspace& workspace, const Eigen::VectorXd& acceleration) {
  algorithmic_after_ =
      ((1 - alpha_.alpha_f) * acceleration + alpha_.alpha_f * workspace.acceleration - alpha_.alpha_m * algorithmic_) /
      (1 - alpha_.alpha_m);
}

}  // namespace dynamics
