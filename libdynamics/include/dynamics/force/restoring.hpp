#pragma once
/// \file  Linear stiffness and damping of single bodies about their rest positions: moorings as a matrix.
#include <array>
#include <string>

#include "dynamics/force/force_kind.hpp"

namespace dynamics {

/// F = −Gᵀ C δ − D v with the displacement δ = (p − p₀, φ) of a point of the body and δ̇ = G v (D2): derived from the
/// potential ½ δᵀCδ, so it conserves energy at any rotation below a full turn and is C δ for small ones. Forces act at
/// that point.
struct Restoring {
  int body;
  Matrix6 stiffness = Matrix6::Zero();              ///< C about the point, symmetric
  Matrix6 damping = Matrix6::Zero();                ///< D about the point
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< from the centre of gravity, body axes, m
  /// Where the load is a signal of a mooring's: its name, and the modes that it tells.
  std::string name = {};
  std::array<bool, 6> told = {};
};

class RestoringKind final : public ForceKind {
 public:
  /// `effect`: "mooring", or what else is such a matrix.
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
    Eigen::Vector3d rest;    ///< of the point, global, m
    Eigen::Vector3d centre;  ///< of gravity from the origin, body axes, m
  };

 private:
  std::string effect_;
  std::vector<Restoring> elements_;
  std::vector<Held> held_;  // one an element
};

}  // namespace dynamics
