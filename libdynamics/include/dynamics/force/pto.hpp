#pragma once
/// \file  Power take-off and other work along the coordinate of a slider or hinge. (D52), (D53)
#include <string>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/force/force_law.hpp"
#include "dynamics/joint/coordinate.hpp"

namespace dynamics {

/// A force against the coordinate of a joint's second body seen from its first, and its opposite.
struct Pto {
  JointCoordinate coordinate;
  PtoLaw law;
  double sign = 1;        ///< −1 where the law counts the coordinate the other way
  std::string name = {};  ///< of the joint
};

/// Coordinate, its rate, and the force against it, as the law counts them: m, m/s, N or rad, rad/s, N m.
struct PtoState {
  double coordinate, rate, force;
};
PtoState pto_state(const Pto& pto, const State& state);

class PtoKind final : public ForceKind {
 public:
  /// Angles of hinges must be counted: see JointCoordinate.
  explicit PtoKind(std::vector<Pto> elements);
  std::string effect() const override { return "pto"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "spring, damper, limit and end stops on the coordinate of a joint"; }
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
