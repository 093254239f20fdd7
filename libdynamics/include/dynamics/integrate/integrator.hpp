#pragma once
/// \file  What all integrators share: the start, steps that are halved when they fail, and steps that are cut where
/// friction or contacts change.
#include <Eigen/Core>

#include <optional>
#include <string>

#include "dynamics/integrate/set_valued.hpp"
#include "dynamics/model/model.hpp"

namespace dynamics {

/// What one full step took.
struct StepReport {
  int newton_iterations = 0;
  int halvings = 0;  ///< how often a step had to be cut in two
  int parts = 0;     ///< pieces into which a tolerance cut the step
  int leaps = 0;     ///< taken through what smooth steps cannot follow (D149)
  std::vector<Event> events = {};
};

/// Friction sticks as one more constraint or slips with a given load, contacts are closed as one more constraint or
/// open; where that changes, the step is cut at the instant, found to round-off, and goes on with accelerations of its
/// own (D20), (D26). No velocity counts as small, no stiffness stands for contact.
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

  /// Between two steps, where a controller has changed an element: finds accelerations and the joints' loads anew and
  /// goes on from them. \throws hydro::NumericsError if they cannot be found
  void loads_jumped(Workspace& workspace);

  /// Why what the method carries from step to step cannot be kept; null if it can.
  virtual const char* cannot_be_kept() const { return nullptr; }
  /// The workspace's state and what the method carries on from it: taken up, or given back to an integrator and a
  /// workspace that are new, after the memories of the workspace. What only spares work, factors and first guesses, is
  /// not kept: who goes on to the bit makes it anew in either case.
  void keep_state(Workspace& workspace, hydro::StateBytes& bytes);

  /// From now on cuts each step so that its local error, estimated by doing it in one and in two (D96), stays below
  /// `tolerance`, relative to the largest speeds of the run so far. Costs half as much again. What is kept at whole
  /// steps only, the memory of radiated waves, does not become finer. \throws hydro::InputError unless it is positive,
  /// or where the method cannot
  void cut_steps(double tolerance);

 protected:
  explicit Integrator(const Model& model) : model_(model), active_(model) {}
  // Copies have the laws of their own constraints.
  Integrator(const Integrator& other) : model_(other.model_), active_(other.active_), failure_(other.failure_) {}
  Integrator& operator=(const Integrator&) = delete;

  /// One step while nothing changes. On failure the workspace is as before and fail() has been told why.
  virtual bool try_step(Workspace& workspace, double h, StepReport& report) = 0;
  /// Global order of the method.
  virtual int order() const = 0;
  /// Why steps cannot be cut to a tolerance; null if they can.
  virtual const char* steps_stay_whole() const { return nullptr; }
  /// The accelerations of the workspace are new: at a start and after a change.
  virtual void begin(const Workspace&) {}
  /// What the method carries from step to step beside the workspace.
  virtual void save_history(Eigen::VectorXd& out) const { out.resize(0); }
  virtual void set_history(const Eigen::VectorXd&) {}
  /// What it carries beside that history, which a step that fails does not take back.
  virtual void keep_own_state(hydro::StateBytes&) {}

  const Model& model() const { return model_; }
  const ActiveSet& active() const { return active_; }
  bool fail(std::string why) { return failure_ = std::move(why), false; }
  /// The attitude and place after a displacement `move` (6N) and the new velocity.
  State displaced(const State& now, const Eigen::VectorXd& move, const Eigen::VectorXd& velocity, double h) const;
  /// The same, into a state that has room.
  void displace(const State& now, const Eigen::VectorXd& move, const Eigen::VectorXd& velocity, double h,
                State& out) const;

 private:
  struct Snapshot {
    State state;
    Eigen::VectorXd acceleration, multipliers, history;
  };
  void save(const Workspace& workspace, Snapshot& out) const;
  void restore(Workspace& workspace, const Snapshot& before);
  bool try_counted_step(Workspace& workspace, double h, StepReport& report);
  void go_straight(Workspace& workspace, double h) const;
  void advance(Workspace& workspace, double h, StepReport& report);
  void advance_halving(Workspace& workspace, double h, int depth, StepReport& report);
  void advance_within(Workspace& workspace, double h, StepReport& report);
  double local_error(Workspace& workspace, double h, StepReport& report);
  void note_speeds(const Workspace& workspace, double h);
  void advance_to_changes(Workspace& workspace, double h, StepReport& report);
  struct Way {
    double time;   ///< s
    bool changes;  ///< at its end something does
  };
  Way go_to_change(Workspace& workspace, double h, StepReport& report);
  void require_closed_joints(const State& state) const;

  const Model& model_;
  ActiveSet active_;
  SetValuedLaws laws_{model_, active_};
  std::string failure_;
  // What is tried: a step, the way to a change, a part of a step. Kept, so that a step asks for no memory.
  Snapshot before_step_, before_change_, before_part_;
  State whole_;          // where one step leads that is done in two halves too
  Eigen::VectorXd off_;  // by how much they differ
  double step_ = 0;      // the one asked for
  std::optional<double> tolerance_;
  double part_ = 0;    // the step that a tolerance chose last, s
  double speeds_ = 0;  // the largest so far, in the metric of the masses
};

}  // namespace dynamics
