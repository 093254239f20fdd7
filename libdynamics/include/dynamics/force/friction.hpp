#pragma once
/// \file  Coulomb friction in hinges and sliders: a set-valued law, which sticks or slips and is never smoothed.
#include "dynamics/force/force_kind.hpp"
#include "dynamics/joint/travel.hpp"

namespace dynamics {

/// Friction of one joint: while it sticks it carries up to `breakaway`, while it slips it resists with `sliding` (D19).
struct Friction {
  std::string name;  ///< of the joint
  Travel travel;
  double breakaway;  ///< static level, N m or N, >= sliding
  double sliding;    ///< dynamic level, > 0
};

/// Whether each friction sticks (0), or the sign of the travel with which it slips; and the work it has done.
class FrictionMemory final : public Memory {
 public:
  explicit FrictionMemory(std::size_t count) : direction(count, 0), work(count, 0) {}
  void accept(const State&) override {}  // an integrator changes it where an event is
  std::vector<int> direction;
  std::vector<double> work;  ///< J, taken from the bodies since the start
};

/// Loads of frictions that slip. Those that stick are conditions, Travel::holding(), which an integrator adds to the
/// joints' own, to compare their multipliers with the static level.
class FrictionKind final : public ForceKind {
 public:
  /// \throws hydro::InputError if a level is not positive or the static one is below the dynamic one
  explicit FrictionKind(std::vector<Friction> elements);

  std::string effect() const override { return "friction"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "sticks or slips, events located"; }
  void couple(BlockPattern& pattern) const override;
  std::unique_ptr<Memory> make_memory(const State& start) const override;
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  const FrictionKind* friction() const override { return this; }

  const std::vector<Friction>& all() const { return elements_; }
  /// What the friction does to the second body along the axis, N m or N. `multipliers` of an integrator hold those of
  /// the joints, of which there are `joints`, and then one for each element that sticks.
  double load(std::size_t element, const Memory* memory, const Eigen::VectorXd& multipliers, Eigen::Index joints) const;
  /// Adds to the memory the work of what slipped between two states less than half a turn apart.
  void note_work(const State& before, const State& after, FrictionMemory& memory) const;

 private:
  std::vector<Friction> elements_;
};

}  // namespace dynamics
