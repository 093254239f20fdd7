#pragma once
/// \file  What an integrator asks of a kind of force whose elements stick or slip. (D19), (D20)
#include <limits>
#include <vector>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/joint/joint.hpp"

namespace dynamics {

/// Whether each friction sticks (0), or the sign of the rate with which it slips; and the work it has done.
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
  bool can_be_kept() const override { return true; }
  void keep_state(hydro::StateBytes& bytes) override { bytes.pass(direction, since, work); }
  std::vector<int> direction;
  std::vector<double> since;  ///< s, when it came to rest; those that begin at rest have been there for ever
  std::vector<double> work;   ///< J, taken from the bodies since the start
};

/// The set-valued law of a kind of force, ForceKind::friction(), whose memory is a FrictionMemory. Elements that slip
/// are loads of the kind; those that stick are constraints, which an integrator adds to the joints' own, to compare
/// their multipliers with what they can hold.
class FrictionLaw {
 public:
  virtual ~FrictionLaw() = default;
  virtual std::size_t elements() const = 0;
  /// How fast an element slips, m/s or rad/s; its sign is that of FrictionMemory::direction.
  virtual double rate(std::size_t element, const State& state) const = 0;
  /// The constraint that holds an element where it is in `state`.
  virtual Constraint holding(std::size_t element, const State& state) const = 0;
  /// Of one that sticks and carries `load`: the share of what it can hold, or, of a latch, of its time.
  virtual double utilisation(std::size_t element, double load, const FrictionMemory& memory, double time) const = 0;
  /// What the friction does to the second body along the axis, N m or N. `multipliers` of an integrator hold those of
  /// the joints, of which there are `joints`, and then one for each element that sticks.
  virtual double load(std::size_t element, const State& state, const Memory* memory, const Eigen::VectorXd& multipliers,
                      Eigen::Index joints) const = 0;
  /// Adds to the memory the work of what slipped between two states less than half a turn apart.
  virtual void note_work(const State& before, const State& after, FrictionMemory& memory) const = 0;
};

}  // namespace dynamics
