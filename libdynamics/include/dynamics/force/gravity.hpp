#pragma once
/// \file  Weight.
#include "dynamics/force/force_kind.hpp"

namespace dynamics {

/// −m g ẑ on each body, at its centre of gravity; stored energy m g z from the global origin. For bodies whose
/// hydrostatic stiffness does not hold their weight already.
class GravityKind final : public ForceKind {
 public:
  GravityKind(const std::vector<RigidBody>& bodies, double gravity);
  std::string effect() const override { return "gravity"; }
  std::size_t elements() const override { return weight_.size(); }
  std::string method() const override { return "constant weight"; }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant&, JacobianSink&) const override {}  // constant
  EnergyFlow energy(const Instant& now) const override;
  bool linear_at_rest() const override { return true; }

 private:
  std::vector<double> weight_;  // N, one a body
};

}  // namespace dynamics
