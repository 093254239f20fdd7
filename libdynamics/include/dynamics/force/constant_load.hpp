#pragma once
/// \file  Loads that stay as they are, or are given over time: wind, a tow, a weight hung on, a pull that is let go.
#include "dynamics/force/force_kind.hpp"
#include "dynamics/state/point.hpp"
#include "dynamics/time/load_history.hpp"

namespace dynamics {

/// A force and a moment, both constant in global axes or a share of that over time (D150); the force acts at a point of
/// the body. Counted as supplied.
struct ConstantLoad {
  PointOnBody at;
  Eigen::Vector3d force, moment;  ///< in full, N, N m
  LoadHistory history = {};
};

class ConstantLoadKind final : public ForceKind {
 public:
  explicit ConstantLoadKind(std::vector<ConstantLoad> elements) : elements_(std::move(elements)) {}
  std::string effect() const override { return "load"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override;
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  /// Where none of them rises or falls.
  bool linear_at_rest() const override;
  bool acts_before_runs() const override { return true; }
  /// The shortest ramp among its elements, s; ∞: none rises or falls.
  double shortest_ramp() const;

 private:
  std::vector<ConstantLoad> elements_;
};

}  // namespace dynamics
