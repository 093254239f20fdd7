#pragma once
/// \file  What all integrators share: the start, steps that are halved when they fail, and steps that are cut where
/// friction or contacts change.
#include <Eigen/Core>

#include <string>

#include "dynamics/integrate/set_valued.hpp"
#include "dynamics/model/model.hpp"

namespace dynamics {

/// What one full step took.
struct StepReport {
  int newton_iterations = 0;
  int halvings = 0;  ///< how often a step had to be cut in two
  std::vector<Event> events = {};
};

/// Friction sticks as one more condition or slips with a given load, contacts are closed as one more condition or open;
/// where that changes, the step is cut at the instant, found to round-off, and goes on with accelerations of its own
/// (D20), (D26). No velocity counts as small, no stiffness stands for contact.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// Finds the accelerations and the joints' loads of the workspace's state and begins there.
  /// \throws hydro::NumericsError if they cannot be found, hydro::InputError naming the joint if one is open or its
  /// bodies' velocities pull it apart, or the contact whose shapes overlap
  void start(Workspace& workspace);

  /// One full step of h seconds; the workspace ends in the new state, memory moved on.
  /// \throws hydro::NumericsError naming time, worst mode and reason when halving is of no use; the workspace then
  /// holds the last good state
  StepReport step(Workspace& workspace, double h);

 protected:
  explicit Integrator(const Model& model) : model_(model), active_(model) {}
  // Copies have the laws of their own conditions.
  Integrator(const Integrator& other) : model_(other.model_), active_(other.active_), failure_(other.failure_) {}
  Integrator& operator=(const Integrator&) = delete;

  /// One step while nothing changes. On failure the workspace is as before and fail() has been told why.
  virtual bool try_step(Workspace& workspace, double h, StepReport& report) = 0;
  /// The accelerations of the workspace are new: at a start and after a change.
  virtual void begin(const Workspace&) {}
  /// What the method carries from step to step beside the workspace.
  virtual Eigen::VectorXd history() const { return {}; }
  virtual void set_history(const Eigen::VectorXd&) {}

  const Model& model() const { return model_; }
  const ActiveSet& active() const { return active_; }
  bool fail(std::string why) { return failure_ = std::move(why), false; }
  /// The attitude and place after a displacement `move` (6N) and the new velocity.
  State displaced(const State& now, const Eigen::VectorXd& move, Eigen::VectorXd velocity, double h) const;

 private:
  struct Snapshot {
    State state;
    Eigen::VectorXd acceleration, multipliers, history;
  };
  Snapshot snapshot(const Workspace& workspace) const;
  void restore(Workspace& workspace, const Snapshot& before);
  bool try_turned_step(Workspace& workspace, double h, StepReport& report);
  void go_straight(Workspace& workspace, double h) const;
  void advance(Workspace& workspace, double h, int depth, StepReport& report);
  void advance_to_changes(Workspace& workspace, double h, StepReport& report);
  double step_to_change(Workspace& workspace, double h, StepReport& report);
  void begin_anew(Workspace& workspace);
  void require_closed_joints(const State& state) const;

  const Model& model_;
  ActiveSet active_;
  SetValuedLaws laws_{model_, active_};
  std::string failure_;
  double step_ = 0;  // the one asked for
};

}  // namespace dynamics
