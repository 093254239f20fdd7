#pragma once
/// \file  Power take-off and other work on the travel of a slider or the angle of a hinge. (D52), (D53)
#include <string>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/force/force_law.hpp"
#include "dynamics/joint/travel.hpp"

namespace dynamics {

/// A force against the travel of a joint's second body seen from its first, and its opposite.
struct Pto {
  Travel travel;
  TravelLaw law;
  double sign = 1;        ///< −1 where the law counts the travel the other way
  std::string name = {};  ///< of the joint
};

/// Travel, its rate, and the force against it, as the law counts them: m, m/s, N or rad, rad/s, N m.
struct PtoState {
  double travel, rate, force;
};
PtoState pto_state(const Pto& pto, const State& state);

class PtoKind final : public ForceKind {
 public:
  /// Angles of hinges must be counted: see Travel.
  explicit PtoKind(std::vector<Pto> elements);
  std::string effect() const override { return "pto"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "spring, damper, limit and end stops on the travel of a joint"; }
  void couple(BlockPattern& pattern) const override;
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  bool linear_at_rest() const override { return true; }
  std::vector<Signal> signals() const override;

 private:
  std::vector<Pto> elements_;
};

}  // namespace dynamics
