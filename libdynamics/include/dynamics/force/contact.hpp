#pragma once
/// \file  Bodies that touch and part: a set-valued law. No stiffness stands for it and no depth of overlap.
#include "dynamics/force/force_kind.hpp"
#include "dynamics/joint/conditions.hpp"

namespace dynamics {

/// Two shapes of two bodies that do not pass through each other (D23)-(D25).
struct Contact {
  std::string name;
  int first;
  std::optional<int> second;  ///< empty: the ground
  GapCondition shapes;
  double restitution = 0;  ///< e, of the approach along the normal that comes back; 0 … 1
  double friction = 0;     ///< μ, of the load along the normal; 0: smooth
};

/// What a contact does at present, and what it has done.
struct ContactState {
  enum Is { open, slides, sticks };
  Is is = open;
  Eigen::Index row = -1;  ///< of its normal among an integrator's multipliers; −1: none
  int held = 0;           ///< directions along the surface that follow it there, while it sticks
  Eigen::Vector3d slip = {0, 0,
                          0};  ///< direction in which the second slips over the first, global; of a contact that slides
  std::size_t impacts = 0;
  double dissipated = 0;  ///< J, by impacts and slip, since the start
};

class ContactMemory final : public Memory {
 public:
  explicit ContactMemory(std::size_t count) : contact(count) {}
  void accept(const State&) override {}  // an integrator changes it where an event is
  std::vector<ContactState> contact;
};

/// Its loads are multipliers of an integrator, so it adds none: it knows the geometry, and keeps the accounts.
class ContactKind final : public ForceKind {
 public:
  /// \throws hydro::InputError for a restitution outside 0 … 1, a friction below zero, shapes that have no law (meet())
  explicit ContactKind(std::vector<Contact> elements);

  std::string effect() const override { return "contact"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "impacts, contact and friction set-valued, events located"; }
  void couple(BlockPattern& pattern) const override;
  std::unique_ptr<Memory> make_memory(const State&) const override {
    return std::make_unique<ContactMemory>(elements_.size());
  }
  void add_load(const Instant&, LoadSink&) const override {}
  void add_jacobian(const Instant&, JacobianSink&) const override {}
  EnergyFlow energy(const Instant& now) const override;
  const ContactKind* contact() const override { return this; }
  std::vector<Signal> signals() const override;

  const std::vector<Contact>& all() const { return elements_; }
  Meeting meeting(std::size_t element, const State& state) const;
  double gap(std::size_t element, const State& state) const { return meeting(element, state).gap; }
  /// How the points that are closest move against each other, the second's seen from the first's.
  struct Motion {
    Meeting meeting;
    double parting;        ///< along the normal, m/s: the rate of the gap
    Eigen::Vector3d slip;  ///< across it, m/s, global
  };
  Motion motion(std::size_t element, const State& state) const;
  /// Shapes that are apart at both ends of a step but were not between: the share of the step at which they are first
  /// seen to overlap (D131). Nothing if they did not, or moved against each other by less than half their thickness.
  std::optional<double> passing(std::size_t element, const State& before, const State& after) const;
  /// The condition that keeps the gap at zero.
  Condition closed(std::size_t element) const;
  /// Two conditions that keep what touches from slipping along the surface, in directions across its normal in `state`.
  std::array<Condition, 2> sticking(std::size_t element, const State& state) const;
  /// How the points that touch in `state` move along a direction of the surface.
  Gradient along(std::size_t element, const Eigen::Vector3d& direction, const State& state) const;
  /// Load along the normal, >= 0, N, from the multipliers of an integrator.
  double load(std::size_t element, const Memory* memory, const Eigen::VectorXd& multipliers) const;

 private:
  std::vector<Contact> elements_;
};

}  // namespace dynamics
