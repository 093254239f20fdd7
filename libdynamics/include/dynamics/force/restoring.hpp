#pragma once
/// \file  Linear stiffness and damping of single bodies about their rest positions: hydrostatics, moorings as a matrix.
#include <array>
#include <string>

#include "dynamics/force/force_kind.hpp"

namespace dynamics {

/// F = −Gᵀ C δ − D v with the displacement δ = (x − x₀, φ) and δ̇ = G v (D2): derived from the potential ½ δᵀCδ, so it
/// conserves energy at any rotation below a full turn and is C δ for small ones.
struct Restoring {
  int body;
  Matrix6 stiffness = Matrix6::Zero();  ///< C about the centre of gravity, symmetric
  Matrix6 damping = Matrix6::Zero();    ///< D about the centre of gravity
  double lift = 0;  ///< N, a constant force upwards at the centre of gravity: buoyancy less weight of a body that
                    ///< others hold at its draught
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< N m at rest about the centre of gravity, of a constant force
                                                     ///< that acts beside it; its potential is −moment·φ
  /// Where the load is a signal of a mooring's: its name, and the modes that it tells.
  std::string name = {};
  std::array<bool, 6> told = {};
};

/// Load of one element. Rotations: |φ| < π.
Vector6 restoring_load(const Restoring& element, const Vector6& displacement, const Vector6& velocity);

class RestoringKind final : public ForceKind {
 public:
  /// `effect`: "hydrostatics" or "mooring".
  RestoringKind(std::string effect, const std::vector<RigidBody>& bodies, std::vector<Restoring> elements);

  std::string effect() const override { return effect_; }
  std::size_t elements() const override { return elements_.size(); }
  std::string method() const override { return "6 x 6 matrix about the rest position"; }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;
  bool linear_at_rest() const override { return true; }
  std::vector<Signal> signals() const override;
  /// The rotation vector ends at half a turn from rest: beyond it the moment would act the other way.
  std::string breaks_off(const State& before, const State& after) const override;

  /// What an element needs of its body.
  struct Held {
    std::string name;
    Eigen::Vector3d rest_centre;  ///< of gravity, global, m
    Eigen::Vector3d centre;       ///< of gravity from the origin, body axes, m
  };

 private:
  std::string effect_;
  std::vector<Restoring> elements_;
  std::vector<Held> held_;  // one an element
};

}  // namespace dynamics
