#pragma once
/// \file  The two Euler methods of first order, kept to show what they cost: Van Zanten (2020) and Huijgen (2024) step
/// so.
#include "dynamics/integrate/newton_integrator.hpp"

namespace dynamics {

/// v₁ = v₀ + h a₁, q₁ = q₀ + h v₁ (D27): never unstable for linear problems, but a free oscillation at ω loses the
/// share ½ωh of its amplitude each radian.
class ImplicitEuler final : public NewtonIntegrator {
 public:
  explicit ImplicitEuler(const Model& model) : NewtonIntegrator(model) {}

 private:
  int order() const override { return 1; }
  Slopes slopes(double h) const override { return {h * h, h, h * h, h}; }
  void end_of_step(const Workspace& workspace, double h, const Eigen::VectorXd& acceleration, State& out) override {
    velocity_after_ = workspace.state.velocity + h * acceleration;
    move_ = h * velocity_after_;
    displace(workspace.state, move_, velocity_after_, h, out);
  }
  Eigen::VectorXd move_, velocity_after_;  // of the step that is tried
};

/// v₁ = v₀ + h a₀, q₁ = q₀ + h v₁ (D27): explicit; unstable for ωh > 2. Below, the energy of a conservative motion
/// wavers by ½ωh but does not drift. Joints are closed after each step by the least motion (D18). \throws
/// hydro::InputError for models with contacts
class SemiImplicitEuler final : public Integrator {
 public:
  explicit SemiImplicitEuler(const Model& model);

 private:
  int order() const override { return 1; }
  bool try_step(Workspace& workspace, double h, StepReport& report) override;
  State end_;  // of the step that is tried; kept, as the others, so that a step asks for no memory
  Eigen::VectorXd acceleration_, multipliers_, velocity_, move_;
};

}  // namespace dynamics
