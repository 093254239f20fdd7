#pragma once
/// \file  A midpoint step that keeps momentum and, of weights, joints and linear springs, energy.
#include "dynamics/integrate/newton_integrator.hpp"

namespace dynamics {

/// Energy–momentum step of second order (D29), after Simo & Wong (1991) for rotations, with joints by the exact
/// differences of their constraints: linear and angular momentum of bodies, and the energy of what joints and weights
/// make, stay to Newton's tolerance at any step, without any damping. Other loads are taken at the midpoint: their
/// energy is right to second order, and what oscillates faster than the step resolves goes on for ever, so that stiff
/// scenes want GeneralizedAlpha. Accelerations and multipliers are means over the step. \throws hydro::InputError for
/// models with contacts
class EnergyMomentum final : public NewtonIntegrator {
 public:
  explicit EnergyMomentum(const Model& model);

 private:
  int order() const override { return 2; }
  Slopes slopes(double h) const override { return {h * h / 4, h / 2, h * h / 2, h}; }
  void end_of_step(const Workspace& workspace, double h, const Eigen::VectorXd& acceleration, State& out) override;
  void find_loads(Workspace& workspace, double h, Trial& trial) const override;
};

}  // namespace dynamics
