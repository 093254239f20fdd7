#pragma once
/// \file  Weight.
#include "dynamics/force/force_kind.hpp"

namespace dynamics {

/// −m g ẑ on bodies, at their centres of gravity; stored energy m g (z − z at rest). For bodies whose
/// hydrostatic stiffness does not hold their weight already.
class GravityKind final : public ForceKind {
 public:
  /// `with_gravity`: indices of the bodies that feel it.
  GravityKind(const std::vector<RigidBody>& bodies, double gravity, const std::vector<int>& with_gravity);
  /// All of them.
  GravityKind(const std::vector<RigidBody>& bodies, double gravity);
  std::string effect() const override { return "weight"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "constant, at the centre of gravity"; }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant&, JacobianSink&) const override {}  // constant
  EnergyFlow energy(const Instant& now) const override;
  /// No stiffness about the centre of gravity, but a load that something must carry at rest.
  bool linear_at_rest() const override { return true; }

 private:
  struct Element {
    int body;
    double weight;       // N
    double rest_height;  // m
  };
  std::vector<Element> elements_;
};

}  // namespace dynamics
