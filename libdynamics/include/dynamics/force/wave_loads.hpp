#pragma once
/// \file  Loads from potential theory: wave excitation, and the memory of radiated waves.
#include "dynamics/force/force_kind.hpp"
#include "dynamics/force/wave_signals.hpp"
#include "hydro/radiation/memory.hpp"

namespace dynamics {

/// First-order excitation on bodies about their centres of gravity; the six signals of body bodies[i] are rows 6i …
/// 6i+5.
struct Excitation {
  std::vector<int> bodies;
  WaveSignals load;
};

class ExcitationKind final : public ForceKind {
 public:
  explicit ExcitationKind(std::vector<Excitation> elements) : elements_(std::move(elements)) {}
  std::string effect() const override { return "excitation"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override;
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant&, JacobianSink&) const override {}
  EnergyFlow energy(const Instant& now) const override;

 private:
  std::vector<Excitation> elements_;
};

/// Radiation memory of modes that feel each other's waves: F = −∫K(t−τ) v(τ) dτ about the centres of gravity. The added
/// mass at infinite frequency is in the model's mass matrix, not here. Modes that are not free have no
/// velocity.
struct RadiationMemory {
  std::vector<int> modes;                                        ///< of the model, 6 · body + mode, increasing
  std::shared_ptr<const hydro::radiation::MemoryMethod> method;  ///< with as many modes
};

class RadiationKind final : public ForceKind {
 public:
  explicit RadiationKind(std::vector<RadiationMemory> elements) : elements_(std::move(elements)) {}
  std::string effect() const override { return "radiation"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override;
  bool remembers_whole_steps() const override;
  void couple(BlockPattern& pattern) const override;
  std::unique_ptr<Memory> make_memory(const State& start) const override;
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;

 private:
  std::vector<RadiationMemory> elements_;
};

}  // namespace dynamics
