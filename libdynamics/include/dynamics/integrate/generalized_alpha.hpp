#pragma once
/// \file  Time stepping by generalised-α on rotations and translations, with the guards that keep it finite.
#include <Eigen/Core>

#include <string>

#include "dynamics/force/friction.hpp"
#include "dynamics/model/model.hpp"

namespace dynamics {

/// What one full step took.
struct StepReport {
  int newton_iterations = 0;
  int halvings = 0;  ///< how often a step had to be cut in two
  int events = 0;    ///< how often friction began to slip, or came to rest
};

/// Generalised-α (Chung & Hulbert 1993) in the form of Arnold & Brüls (2007), which satisfies the equations of motion
/// at the end of every step, with attitudes moved by the exponential map (Brüls, Cardona & Arnold 2012). Equations
/// (D9)-(D11).
///
/// Second order; unconditionally stable for linear problems; ρ∞ is the factor by which an infinitely fast oscillation
/// is damped each step: 1 keeps it, 0 removes it. The period of a free oscillation at ω is wrong by about (ωh)²/12
/// relative at ρ∞ = 1. Each step is solved by Newton with line search; a step that fails is halved.
///
/// Friction sticks as one more condition or slips with a given load; where it changes, the step is cut at the instant,
/// found to round-off, and goes on with accelerations of its own (D20). No velocity counts as small.
///
/// Joints are closed at the end of every step, to round-off; their multipliers are of second order too (Arnold & Brüls
/// 2007), for ρ∞ < 1. Velocities leave the joints' directions by the order of the step's own error (D16).
class GeneralizedAlpha {
 public:
  struct Settings {
    double rho_infinity = 0.8;
    double newton_tolerance = 1e-9;  ///< of the last correction relative to the acceleration and velocity / step
    int iterations = 20;
    int deepest_halving = 10;  ///< a step is cut into 2¹⁰ pieces at most
  };
  GeneralizedAlpha(const Model& model, const Settings& settings);

  /// Finds the accelerations and the joints' loads of the workspace's state and begins there.
  /// \throws hydro::NumericsError if they cannot be found, hydro::InputError naming the joint if one is open or its
  /// bodies' velocities pull it apart
  void start(Workspace& workspace);

  /// One full step of h seconds; the workspace ends in the new state, memory moved on.
  /// \throws hydro::NumericsError naming time, worst mode and reason when halving is of no use; the workspace then
  /// holds the last good state
  StepReport step(Workspace& workspace, double h);

 private:
  /// What a step begins from, to go back to.
  struct Snapshot {
    State state;
    Eigen::VectorXd acceleration, multipliers, algorithmic;
  };
  Snapshot snapshot(const Workspace& workspace) const;
  void restore(Workspace& workspace, const Snapshot& before);
  bool solve_accelerations(Workspace& workspace);
  FrictionMemory& friction_memory(Workspace& workspace) const;
  void set_conditions(Workspace& workspace);
  void settle_friction(Workspace& workspace);
  /// How far the friction next to change is from doing so: its index, and a share of its static level or a rate;
  /// negative if it should have changed already.
  struct Margin {
    std::size_t element = 0;
    double value = 1;
    int changes_to = 0;  ///< the direction in which it then slips; 0: it may hold
  };
  Margin friction_margin(Workspace& workspace) const;
  void advance_to_events(Workspace& workspace, double h, StepReport& report);
  double step_to_event(Workspace& workspace, double h, StepReport& report);
  bool try_step(Workspace& workspace, double h, StepReport& report);
  void advance(Workspace& workspace, double h, int depth, StepReport& report);
  void predict(const Workspace& workspace, double h, const Eigen::VectorXd& acceleration, State& next) const;
  /// What a guess of accelerations and multipliers at the end of the step leads to.
  struct Trial {
    Eigen::VectorXd acceleration, multipliers;
    State state;
    std::vector<Gradient> gradients;
    Eigen::VectorXd residual, open;  ///< forces that do not balance; how far joints are open, as accelerations
    double size;                     ///< of both, scaled
  };
  Trial evaluate(Workspace& workspace, double h, Eigen::VectorXd acceleration, Eigen::VectorXd multipliers) const;
  std::vector<Gradient> by_step(const std::vector<Gradient>& G, const State& before, const State& after) const;
  double unresolved(double h) const;
  void find_joint_scale(const State& state);
  void require_closed_joints(const State& state, const std::vector<Gradient>& G) const;

  const Model& model_;
  Settings settings_;
  const FrictionKind* friction_ = nullptr;
  std::size_t friction_index_ = 0;  // among the model's forces
  JointSet active_;                 // the joints, and what friction holds
  double alpha_m_, alpha_f_, beta_, gamma_;
  Eigen::VectorXd algorithmic_;  // the auxiliary acceleration of Arnold & Brüls
  Eigen::VectorXd scale_;  // √ of the diagonal of mass plus added mass: makes newtons and newton metres comparable
  Eigen::VectorXd joint_scale_;  // the same for the joints' conditions
  double rounding_ = 0;          // m, of a joint's place computed from its bodies' positions
  std::string failure_;          // why the last attempt failed
};

}  // namespace dynamics
