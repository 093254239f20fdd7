#pragma once
/// \file  When friction and contacts change, and into what. Integrators take smooth steps between.
#include "dynamics/integrate/active_set.hpp"

namespace dynamics {

/// A change of a set-valued law, or an impact.
struct Event {
  enum class Law { friction, contact } law;
  double time;          ///< s
  std::size_t element;  ///< of the friction or contact law
  int becomes;          ///< friction: the direction in which it slips, 0 if it sticks; contact: a ContactState::Is
};

/// The laws of friction (D19), (D20) and contact (D23)-(D26) at the instants where something changes.
class SetValuedLaws {
 public:
  SetValuedLaws(const Model& model, ActiveSet& active) : model_(model), active_(active) {}

  /// What holds and what slips where a run starts, with its accelerations.
  /// \throws hydro::InputError for shapes that overlap there
  void begin(Workspace& workspace);

  /// How far the law next to change is from doing so; negative if it should have changed already. Loads are those of
  /// the state, not of the method that led to it, whose own waver in short steps.
  struct Margin {
    Event::Law law = Event::Law::friction;
    std::size_t element = 0;
    double value = 1;       ///< a share, a speed in m/s, a length in m
    int becomes = 0;        ///< as in Event
    bool together = false;  ///< contacts that share their loads are at their limit, not this one alone (D130)
  };
  Margin least_margin(Workspace& workspace);
  /// Of what is open at both ends of a step, `before` and the workspace's state, and was not all through it: the share
  /// of the step at which the first is seen to overlap (D131).
  std::optional<double> passing(const State& before, Workspace& workspace) const;

  /// Carries out what least_margin() found where it is zero, and whatever follows at that instant: impacts, slip,
  /// stick. `step`: of the run, s, what rounding of speeds is seen against.
  std::vector<Event> change(Workspace& workspace, const Margin& at, double step);
  /// Bounces count anew from here: a step begins.
  void begin_step() { bounces_spent_ = false; }
  /// Ends what goes on in ever shorter times, bounces and rocking: contacts that could close within a step have no more
  /// speed along their normals, and what closes in the rest of the step does so without restitution (D26).
  void still(Workspace& workspace, double step);

  /// Whether a rough contact is closed; whether one slides.
  bool rubs(Workspace& workspace) const;
  bool slides(Workspace& workspace) const;
  /// A step of h seconds in which contacts stick, slide, close and part by themselves (D149), through what smooth steps
  /// cannot follow: slips that end together. Of first order in h, and its work is noted.
  std::vector<Event> leap(Workspace& workspace, double h);

  /// Where contacts are more than bodies need, the multipliers of a step may ask of one what it cannot bear: they
  /// become those of the share nearest to even that all can bear (D130).
  void share_loads(Workspace& workspace);

  /// From the workspace's state on work is counted.
  void begin_work(Workspace& workspace);
  /// Adds the work of what slipped since.
  void note_work(Workspace& workspace);
  /// Points that stick on round shapes roll: they are taken anew where they touch now.
  /// \returns true if accelerations had to be found anew too
  bool follow_rolling(Workspace& workspace);

 private:
  bool bounces_spent_ = false;
  static constexpr double closed = 1e-9;  // m, and of the fastest speed: what rounding of a placed body leaves
  bool collide(Workspace& workspace);
  void classify_contacts(Workspace& workspace) const;
  void classify_friction(Workspace& workspace) const;
  void take_up(Workspace& workspace, const Margin& at);
  Eigen::Vector3d direction_of_slip(std::size_t element, const Eigen::VectorXd& multipliers,
                                    Workspace& workspace) const;
  void settle(Workspace& workspace);
  bool release(Workspace& workspace);
  struct Shared;
  std::optional<Shared> shared(Workspace& workspace) const;
  Eigen::VectorXd even_loads(const Shared& shared, const Eigen::VectorXd& multipliers) const;
  Margin margin_of_share(const Margin& even, const Eigen::VectorXd& multipliers, double rounding,
                         Workspace& workspace) const;
  std::optional<bool> release_together(double rounding, Workspace& workspace);
  bool give_way(const Shared& shared, const Eigen::VectorXd& loads, Workspace& workspace) const;
  struct Touching;
  Touching touching(const JointSet& held, std::vector<std::size_t> elements, Workspace& workspace) const;
  Touching touching_now(Workspace& workspace) const;
  bool decide_together(Workspace& workspace) const;
  bool close_what_would_overlap(Workspace& workspace);
  double slow(const Workspace& workspace) const;
  double rounding(const Eigen::VectorXd& acceleration, const Eigen::VectorXd& multipliers) const;
  double rounding(const Workspace& workspace) const { return rounding(workspace.acceleration, workspace.multipliers); }
  bool any_rough(Workspace& workspace, bool (*is)(const ContactState&)) const;
  JointSet held_now(Workspace& workspace) const;
  Eigen::VectorXd without_contacts(const Touching& all, const JointSet& held, Workspace& workspace) const;
  void note_work_of_joints(Workspace& workspace) const;
  void find_slip_power(Workspace& workspace, Eigen::VectorXd& power) const;
  double pull(std::size_t element, const Workspace& workspace) const;
  struct Seen {
    int is;  ///< as Event::becomes
    std::size_t impacts;
    bool operator==(const Seen&) const = default;
  };
  std::vector<Seen> situation(Workspace& workspace) const;
  std::vector<Event> events_since(const std::vector<Seen>& was, Workspace& workspace) const;

  const Model& model_;
  ActiveSet& active_;
  double step_ = 0;
  bool shares_ = false;  // the multipliers are no longer those of equal pads
  // Kept from step to step, so that a step asks for no memory.
  ActiveSet::Balance loads_;  // of the state that is looked at
  State before_;              // where work is counted from, and powers of the slip of each contact, W
  Eigen::VectorXd slip_power_before_, slip_power_;
};

}  // namespace dynamics
