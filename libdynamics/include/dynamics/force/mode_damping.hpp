#pragma once
/// \file  Linear and quadratic damping of single modes of a body, as a decay tells them. (D136)
#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

#include "dynamics/force/force_kind.hpp"

namespace dynamics {

/// F_i = −(b_i + q_i |u_i|) u_i of each mode i, with u the velocity of the body's origin and its angular velocity,
/// global axes; forces act at the origin.
struct ModeDamping {
  int body;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< from the centre of gravity, body axes, m
  Vector6 linear = Vector6::Zero();                  ///< b: N s/m, N m s/rad; not negative
  Vector6 quadratic = Vector6::Zero();               ///< q: N s²/m², N m s²/rad²; not negative
};

class ModeDampingKind final : public ForceKind {
 public:
  explicit ModeDampingKind(std::vector<ModeDamping> elements) : elements_(std::move(elements)) {}

  std::string effect() const override { return "damping"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "linear and quadratic by the velocity of each mode at the origin"; }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  /// Of the linear part; the quadratic one is flat at rest.
  bool linear_at_rest() const override { return true; }

 private:
  std::vector<ModeDamping> elements_;
};

}  // namespace dynamics
