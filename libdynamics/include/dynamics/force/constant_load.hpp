#pragma once
/// \file  Loads that stay as they are: wind, a tow, a weight hung on.
#include "dynamics/force/force_kind.hpp"
#include "dynamics/state/point.hpp"

namespace dynamics {

/// A force and a moment, both constant in global axes; the force acts at a point of the body. Counted as supplied.
struct ConstantLoad {
  PointOnBody at;
  Eigen::Vector3d force, moment;  ///< N, N m
};

class ConstantLoadKind final : public ForceKind {
 public:
  explicit ConstantLoadKind(std::vector<ConstantLoad> elements) : elements_(std::move(elements)) {}
  std::string effect() const override { return "load"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "constant force and moment"; }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  bool linear_at_rest() const override { return true; }

 private:
  std::vector<ConstantLoad> elements_;
};

}  // namespace dynamics
