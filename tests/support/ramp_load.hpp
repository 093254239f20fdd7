#pragma once
// A force that grows evenly, for tests and cases of what lets go.
#include "dynamics/force/force_kind.hpp"

namespace support {

/// A load on the first body that grows with time: on surge N/s, and on pitch N m/s.
class RampLoad final : public dynamics::ForceKind {
 public:
  RampLoad(double surge, double pitch) : surge_(surge), pitch_(pitch) {}
  std::string effect() const override { return "ramp"; }
  std::size_t elements() const override { return 1; }
  std::string method() const override { return "linear in time"; }
  void add_load(const dynamics::Instant& now, dynamics::LoadSink& out) const override {
    out.add_mode(0, surge_ * now.state.time);
    out.add_mode(4, pitch_ * now.state.time);
  }
  void add_jacobian(const dynamics::Instant&, dynamics::JacobianSink&) const override {}
  dynamics::EnergyFlow energy(const dynamics::Instant& now) const override {
    return {.supplied = now.state.time * (surge_ * now.state.velocity[0] + pitch_ * now.state.velocity[4])};
  }

 private:
  double surge_, pitch_;
};

}  // namespace support
