#pragma once
/// \file  Connectors between a point of one body and a point of another, or of the ground.
#include <string>
#include <vector>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/force/force_law.hpp"
#include "dynamics/state/point.hpp"

namespace dynamics {

/// The two points that a connector joins.
struct Ends {
  PointOnBody first;
  Point second;
};

/// A pull along the line between the ends: what its law gives for L − L₀ and dL/dt, tension positive (D3).
struct AxialConnector {
  Ends ends;
  LineLaw law;
  double rest_length;  ///< L₀, m
  std::string name = {};
};

/// Springs and dampers along three axes fixed to the first body, and about them (D4). The force acts on both bodies at
/// the second end, so that no net moment arises; the potential is ½ Σ kᵢ εᵢ² + ½ Σ κᵢ ψᵢ², ε the shift of the second
/// end seen from the first body, ψ the rotation vector of the second body seen from the first.
struct BushingConnector {
  Ends ends;
  Eigen::Vector3d stiffness = Eigen::Vector3d::Zero(), damping = Eigen::Vector3d::Zero();  ///< N/m, N s/m
  Eigen::Vector3d rotational_stiffness = Eigen::Vector3d::Zero(),
                  rotational_damping = Eigen::Vector3d::Zero();  ///< N m/rad, N m s/rad
  Eigen::Vector3d rest_offset =
      Eigen::Vector3d::Zero();  ///< of the second end from the first at rest, first body's axes, m
  std::string name = {};
};

/// What an axial connector does at one instant.
struct AxialState {
  double length, tension;  ///< m, N
};
AxialState axial_state(const AxialConnector& connector, const State& state);

/// The second end seen from the first body, less `rest_offset`, along that body's axes: "gap.x" … "gap.z", m.
std::vector<Signal> relative_motion_signals(const std::string& name, const Ends& ends,
                                            const Eigen::Vector3d& rest_offset);

/// Force on the first body, along its own axes, N.
Eigen::Vector3d bushing_force(const BushingConnector& connector, const State& state);

class AxialConnectorKind final : public ForceKind {
 public:
  explicit AxialConnectorKind(std::vector<AxialConnector> elements) : elements_(std::move(elements)) {}
  std::string effect() const override { return "connector.axial"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "spring and damper along the line between the ends"; }
  void couple(BlockPattern& pattern) const override;
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  bool linear_at_rest() const override { return true; }
  std::vector<Signal> signals() const override;
  const std::vector<AxialConnector>& all() const { return elements_; }

 private:
  std::vector<AxialConnector> elements_;
};

class BushingConnectorKind final : public ForceKind {
 public:
  explicit BushingConnectorKind(std::vector<BushingConnector> elements) : elements_(std::move(elements)) {}
  std::string effect() const override { return "connector.bushing"; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "springs and dampers along and about three axes of the first body"; }
  void couple(BlockPattern& pattern) const override;
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  bool linear_at_rest() const override { return true; }
  std::vector<Signal> signals() const override;
  /// The rotation vector ends where one body has turned by half a turn against the other.
  std::string breaks_off(const State& before, const State& after) const override;
  const std::vector<BushingConnector>& all() const { return elements_; }

 private:
  std::vector<BushingConnector> elements_;
};

}  // namespace dynamics
