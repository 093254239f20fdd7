#pragma once
/// \file  Coulomb friction in hinges and sliders: a set-valued law, which sticks or slips and is never smoothed.
#include <limits>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/joint/travel.hpp"

namespace dynamics {

/// Friction of one joint: while it sticks it carries up to `breakaway`, while it slips it resists with `sliding` (D19),
/// or falls from the one to the other over the rate `stribeck` (D32). Or a latch: it holds whatever the load, for the
/// time `hold` from where it came to rest, and is nothing otherwise (D33).
struct Friction {
  std::string name;  ///< of the joint
  Travel travel;
  double breakaway;                     ///< static level, N m or N, >= sliding; of latches infinite
  double sliding;                       ///< dynamic level, > 0; of latches 0
  std::optional<double> stribeck = {};  ///< rad/s or m/s, > 0
  std::optional<double> hold = {};      ///< s, > 0
  double sign = 1;                      ///< −1 where its signal is told along the axis turned round
  double level(double rate) const;      ///< against the slip, N m or N
  double steepness(double rate) const;  ///< its derivative by the rate
};

/// Whether each friction sticks (0), or the sign of the travel with which it slips; and the work it has done.
class FrictionMemory final : public Memory {
 public:
  explicit FrictionMemory(std::size_t count)
      : direction(count, 0), since(count, -std::numeric_limits<double>::infinity()), work(count, 0) {}
  void accept(const State&) override {}  // an integrator changes it where an event is
  /// Begins to slip in a direction, or to stick.
  void turn(std::size_t element, int to, double time) {
    if (to == 0 && direction[element] != 0) since[element] = time;
    direction[element] = to;
  }
  std::vector<int> direction;
  std::vector<double> since;  ///< s, when it came to rest; those that begin at rest have been there for ever
  std::vector<double> work;   ///< J, taken from the bodies since the start
};

/// Loads of frictions that slip. Those that stick are conditions, Travel::holding(), which an integrator adds to the
/// joints' own, to compare their multipliers with the static level.
class FrictionKind final : public ForceKind {
 public:
  /// \throws hydro::InputError if a level, rate or time is not positive, or the static level is below the dynamic one
  explicit FrictionKind(std::vector<Friction> elements);

  std::string effect() const override;  ///< "friction", or "latch" where there is nothing else
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "sticks or slips, events located"; }
  void couple(BlockPattern& pattern) const override;
  std::unique_ptr<Memory> make_memory(const State& start) const override;
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  const FrictionKind* friction() const override { return this; }
  std::vector<Signal> signals() const override;

  const std::vector<Friction>& all() const { return elements_; }
  /// Of one that sticks and carries `load`: the share of what it can hold, or, of a latch, of its time.
  double strain(std::size_t element, double load, const FrictionMemory& memory, double time) const;
  /// What the friction does to the second body along the axis, N m or N. `multipliers` of an integrator hold those of
  /// the joints, of which there are `joints`, and then one for each element that sticks.
  double load(std::size_t element, const State& state, const Memory* memory, const Eigen::VectorXd& multipliers,
              Eigen::Index joints) const;
  /// Adds to the memory the work of what slipped between two states less than half a turn apart.
  void note_work(const State& before, const State& after, FrictionMemory& memory) const;

 private:
  std::vector<Friction> elements_;
};

}  // namespace dynamics
