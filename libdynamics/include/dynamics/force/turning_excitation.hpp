#pragma once
/// \file  Wave excitation of a body that turns slowly to other headings. (D121)
#include "dynamics/force/force_kind.hpp"
#include "dynamics/force/wave_signals.hpp"

namespace dynamics {

/// First-order excitation of one body about its centre of gravity, global axes, at equally spaced yaws; six signals for
/// each, one after the other.
struct TurningExcitation {
  std::string name;  ///< of the body
  int body;
  double first_yaw, spacing;  ///< rad, from rest
  int yaws;                   ///< at least two
  WaveSignals load;
  double time_constant;  ///< s, of what counts as slow: ψ̄' = (ψ − ψ̄)/τ
};

/// Yaw of a pose: of the body's x axis in the horizontal, rad, from that at rest.
double yaw_of(const Pose& pose);

/// The slow yaw of each body.
class SlowYaw final : public Memory {
 public:
  SlowYaw(const std::vector<TurningExcitation>& elements, const State& start);
  /// \throws hydro::NumericsError if a body has turned beyond its table
  void accept(const State& state) override;
  bool can_be_kept() const override { return true; }
  void keep_state(hydro::StateBytes& bytes) override { bytes.pass(yaw, time_); }

  std::vector<double> yaw;  ///< rad, one an element

 private:
  void check() const;
  const std::vector<TurningExcitation>& elements_;
  double time_;
};

/// Straight between the yaws of the table; within a step the yaw is that of its beginning.
class TurningExcitationKind final : public ForceKind {
 public:
  explicit TurningExcitationKind(std::vector<TurningExcitation> elements) : elements_(std::move(elements)) {}
  std::string effect() const override { return "excitation.turning"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override;
  std::unique_ptr<Memory> make_memory(const State& start) const override {
    return std::make_unique<SlowYaw>(elements_, start);
  }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant&, JacobianSink&) const override {}
  EnergyFlow energy(const Instant& now) const override;

 private:
  std::vector<TurningExcitation> elements_;
};

}  // namespace dynamics
