#pragma once
/// \file  Time stepping by generalised-α on rotations and translations, with the guards that keep it finite.
#include <Eigen/Core>

#include "dynamics/integrate/newton_integrator.hpp"
#include "dynamics/time/alpha_parameters.hpp"

namespace dynamics {

/// Generalised-α (Chung & Hulbert 1993) in the form of Arnold & Brüls (2007), which satisfies the equations of motion
/// at the end of every step, with attitudes moved by the exponential map (Brüls, Cardona & Arnold 2012). Equations
/// (D9)-(D11).
///
/// Second order; unconditionally stable for linear problems; ρ∞ is the factor by which an infinitely fast oscillation
/// is damped each step: 1 keeps it, 0 removes it. The period of a free oscillation at ω is wrong by about (ωh)²/12
/// relative at ρ∞ = 1. Each step is solved by Newton with line search; a step that fails is halved.
///
/// Joints are closed at the end of every step, as far as Newton goes; their multipliers are of second order too (Arnold
/// & Brüls 2007), for ρ∞ < 1. Where steps change from one to the next the order stays two without joints and falls to
/// one with them (D97). Velocities leave the joints' directions by the order of the step's own error (D16).
class GeneralizedAlpha final : public NewtonIntegrator {
 public:
  struct Settings {
    double rho_infinity = 0.8;
    double residual_tolerance = least_residual_tolerance;  ///< at which Newton ends
  };
  GeneralizedAlpha(const Model& model, const Settings& settings);

 private:
  int order() const override { return 2; }
  const char* steps_stay_whole() const override;
  void begin(const Workspace& workspace) override {
    algorithmic_ = workspace.acceleration;
    last_ = 0;
  }
  void save_history(Eigen::VectorXd& out) const override;
  void set_history(const Eigen::VectorXd& was) override;
  void prepare(const Workspace& workspace, double h) override;

  Slopes slopes(double h) const override;
  void end_of_step(const Workspace& workspace, double h, const Eigen::VectorXd& acceleration, State& out) override;
  void accepted(const Workspace& before, const Eigen::VectorXd& acceleration) override;
  void find_algorithmic_after(const Workspace& workspace, const Eigen::VectorXd& acceleration);

  AlphaParameters alpha_;
  Eigen::VectorXd algorithmic_;  // the auxiliary acceleration of Arnold & Brüls
  double last_ = 0;              // the step that led to it, s; 0 if it is the acceleration itself
  Eigen::VectorXd algorithmic_after_, move_, velocity_after_;  // of the step that is tried
};

}  // namespace dynamics
