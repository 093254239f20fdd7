#pragma once
/// \file  Forces along joint coordinates that a controller sets between steps. (D155)
#include <memory>
#include <string>
#include <vector>

#include "dynamics/force/pto.hpp"

namespace dynamics {

/// What a controller sets at one instant: the force against a coordinate that is at x₀ then and goes at ẋ₀, and how it
/// follows the motion until it is set anew, T = force + stiffness (x − x₀) + damping (ẋ − ẋ₀). N, N/m, N s/m of
/// sliders; N m, N m/rad, N m s/rad of hinges.
struct Command {
  double force = 0, stiffness = 0, damping = 0;
};

/// What acts along each coordinate: its own law, until something is set.
class CommandMemory final : public Memory {
 public:
  explicit CommandMemory(const std::vector<Pto>& elements);
  void accept(const State&) override {}
  /// Between steps: from `now` on this is the force of the element, within the limit and beside the stops of its own
  /// law. \returns true if the force has jumped by it, so that Integrator::loads_jumped() must follow
  bool set(std::size_t element, const Command& command, const State& now);

  const Pto& acting(std::size_t element) const { return elements_[element].pto; }
  const PtoKind& kind(std::size_t element) const { return elements_[element].kind; }
  /// What was set supplies power, or takes it if that is negative, and holds no energy; what springs of its own law
  /// held when it was set first stays with the machine.
  EnergyFlow energy(std::size_t element, const State& now) const;

 private:
  struct Element {
    Pto pto;       // as it acts
    PtoKind kind;  // of it alone
    Pto bounds;    // limit and stops
    bool is_set = false;
    double held = 0;  // J, when it was set first
  };
  std::vector<Element> elements_;
};

/// Power take-offs whose forces are set; without memory, and before anything is set, they are as their own laws say.
class CommandedForceKind final : public ForceKind {
 public:
  explicit CommandedForceKind(const std::vector<Pto>& elements);
  std::string effect() const override { return "pto.controlled"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "force on the coordinate of a joint, set by a controller"; }
  bool linear_at_rest() const override { return true; }
  void couple(BlockPattern& pattern) const override { own_.couple(pattern); }
  std::unique_ptr<Memory> make_memory(const State&) const override {
    return std::make_unique<CommandMemory>(elements_);
  }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  std::unique_ptr<const ForceKind> stiffer_than_at(const State& state) const override {
    return own_.stiffer_than_at(state);
  }
  /// Those of power take-offs: "NAME.pto_force" or "NAME.pto_moment", and "NAME.pto_power".
  std::vector<Signal> signals() const override;

 private:
  std::vector<Pto> elements_;
  PtoKind own_;
};

}  // namespace dynamics
