#pragma once
/// \file  A load that is known at instants beforehand, whatever the bodies do.
#include "dynamics/force/force_kind.hpp"

namespace dynamics {

/// Loads on the modes of a model, as State::velocity is ordered, at t = 0, spacing, 2 spacing …; N and N m.
struct LoadRecord {
  double spacing;            ///< s
  Eigen::MatrixXd on_modes;  ///< (modes, samples)
};

/// Straight between samples; before the first and after the last as there. Its work is counted as supplied.
class RecordedLoadKind final : public ForceKind {
 public:
  /// \throws hydro::InputError unless each record has a positive spacing and a sample
  explicit RecordedLoadKind(std::vector<LoadRecord> elements);
  std::string effect() const override { return "recorded load"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "straight between samples"; }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant&, JacobianSink&) const override {}
  EnergyFlow energy(const Instant& now) const override;

 private:
  std::vector<LoadRecord> elements_;
};

}  // namespace dynamics
