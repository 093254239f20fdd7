#pragma once
/// \file  Axial connectors whose stiffness a controller sets between steps.
#include "dynamics/force/connector.hpp"

namespace dynamics {

/// Connectors that have one stiffness. That of their law is the one that they begin with.
using SwitchedConnectors = std::vector<AxialConnector>;

/// The stiffness of each group, and the energy that its springs and dampers have taken since the start.
class SwitchMemory final : public Memory {
 public:
  explicit SwitchMemory(const std::vector<SwitchedConnectors>& groups, const State& start);
  void accept(const State& state) override;
  bool can_be_kept() const override { return true; }
  void keep_state(hydro::StateBytes& bytes) override { bytes.pass(stiffness, switches, dissipated, time_, power_); }
  /// From `now`, the end of a step, on a group has this stiffness, N/m. Loads jump: Integrator::loads_jumped() must
  /// follow. \returns false, and nothing changes, if the group has it already
  bool set(std::size_t group, double stiffness_N_per_m, const State& now);

  std::vector<double> stiffness;      ///< N/m, one a group
  std::vector<std::size_t> switches;  ///< how often each has changed
  double dissipated = 0;              ///< J, by dampers; less what switches have put into springs

 private:
  EnergyFlow flow(const State& state) const;
  const std::vector<SwitchedConnectors>& groups_;
  double time_, power_;
};

/// Loads as those of AxialConnectorKind, with the stiffness that is set; it changes between steps, never within one.
class SwitchedConnectorKind final : public ForceKind {
 public:
  explicit SwitchedConnectorKind(std::vector<SwitchedConnectors> groups) : groups_(std::move(groups)) {}
  std::string effect() const override { return "connector.switched"; }
  std::size_t elements() const override;
  std::string method() const override {
    return "spring and damper along the line between the ends, stiffness set by a controller";
  }
  void couple(BlockPattern& pattern) const override;
  std::unique_ptr<Memory> make_memory(const State& start) const override {
    return std::make_unique<SwitchMemory>(groups_, start);
  }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  /// About rest it has the stiffness that it begins with.
  bool linear_at_rest() const override { return true; }
  std::vector<Signal> signals() const override;
  const std::vector<SwitchedConnectors>& all() const { return groups_; }

 private:
  std::vector<SwitchedConnectors> groups_;
};

}  // namespace dynamics
