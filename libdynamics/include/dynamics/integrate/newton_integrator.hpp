#pragma once
/// \file  What implicit integrators share: each step solved by Newton with line search for accelerations and
/// multipliers.
#include <Eigen/Core>

#include <array>
#include <optional>

#include "dynamics/integrate/integrator.hpp"

namespace dynamics {

/// Newton ends where the residual, as an acceleration, is `residual_tolerance` of the acceleration and of the velocity
/// over the step, where one of its own corrections is 1e-9 of them, or below what rounding leaves of places; joints are
/// closed at the end of every step as well as that. Its matrix is factorised anew only where the factors of earlier
/// iterates or steps leave more than a tenth of the residual (D98).
class NewtonIntegrator : public Integrator {
 public:
  static constexpr double least_residual_tolerance = 1e-12;  ///< a thousand times what rounding leaves

 protected:
  /// 	hrows hydro::InputError if the tolerance is below `least_residual_tolerance` or above 1e-6, where corrections
  ///         of 1e-9 would end the iteration sooner
  explicit NewtonIntegrator(const Model& model, double residual_tolerance = least_residual_tolerance);

  /// What a guess of accelerations and multipliers leads to.
  struct Trial {
    Eigen::VectorXd acceleration, multipliers;
    State state;                               ///< at the end of the step
    std::optional<State> loads_at = {};        ///< where loads are taken, if not there
    std::vector<Gradient> gradients, columns;  ///< of the constraints at the end, and of their loads
    Eigen::VectorXd residual, open;  ///< forces that do not balance; how far joints are open, as accelerations
    double size = 0;                 ///< of both, scaled
  };
  /// How places and velocities move with the accelerations that Newton seeks, where loads are taken and at the end.
  struct Slopes {
    double load_place, load_speed, end_place, end_speed;
  };

 private:
  /// A step of h begins.
  virtual void prepare(const Workspace&, double /*h*/) {}
  virtual Slopes slopes(double h) const = 0;
  virtual void end_of_step(const Workspace& workspace, double h, const Eigen::VectorXd& acceleration, State& out) = 0;
  /// Fills residual (without joints) and columns, and loads_at if that is not the end of the step.
  virtual void find_loads(Workspace& workspace, double h, Trial& trial) const;
  /// The step is done; the workspace is still as before it.
  virtual void accepted(const Workspace&, const Eigen::VectorXd&) {}

  bool try_step(Workspace& workspace, double h, StepReport& report) final;
  /// Fills the trial from its accelerations and multipliers.
  void evaluate(Workspace& workspace, double h, Trial& trial);
  void evaluate_corrected(Workspace& workspace, double h, double part);
  void find_gradients_by_step(const State& before);
  double unresolved(double h) const;
  bool factorise(Workspace& workspace, double h);
  double search(Workspace& workspace, double h, double move);
  void foretell(const Workspace& workspace, int went_on);
  double reach(double h) const;
  void take_unseen(const Workspace& workspace, double h);
  void finish(Workspace& workspace, int goes_on);

  // Accelerations at the begin of the three steps before, the last first, for a first guess, as far as factors served
  // all through them.
  std::array<Eigen::VectorXd, 3> before_;
  int goes_on_ = 0;  // of how many steps
  double residual_tolerance_;
  // What Newton holds and what it tries: kept from step to step, so that a step asks for no memory.
  Trial now_, trial_;
  KktSolver::Solution correction_;
  std::vector<Gradient> by_step_;  // gradients of `now_` by what moves a step, not its end
};

}  // namespace dynamics
