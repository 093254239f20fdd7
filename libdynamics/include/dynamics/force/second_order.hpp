#pragma once
/// \file  Wave loads of second order on bodies as they are placed: quadratic forms of the waves. (D137)
#include <array>
#include <optional>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/force/wave_signals.hpp"

namespace dynamics {

/// On one body about its centre of gravity, mode by mode, with the ramp r of the waves and the signals x that they
/// drive: F = r² mean + xᵀ form x, N and N m, or of Newman's product F_m = r² mean_m + x₀ x_{2+2m} + x₁ x_{3+2m}.
struct SecondOrderLoad {
  int body;
  std::optional<WaveSignals> signals = {};   ///< (n); none: the mean alone
  std::array<Eigen::MatrixXd, 6> form = {};  ///< (n, n); without numbers: none of this mode
  bool product = false;                      ///< in place of forms; the signals are then 14
  Vector6 mean = Vector6::Zero();
  double ramp_s = 0;
  std::string method = {};

  Vector6 at(double time) const;
};

class SecondOrderKind final : public ForceKind {
 public:
  explicit SecondOrderKind(std::vector<SecondOrderLoad> elements) : elements_(std::move(elements)) {}
  std::string effect() const override { return "second_order"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return elements_.front().method; }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant&, JacobianSink&) const override {}
  EnergyFlow energy(const Instant& now) const override;

 private:
  std::vector<SecondOrderLoad> elements_;
};

}  // namespace dynamics
