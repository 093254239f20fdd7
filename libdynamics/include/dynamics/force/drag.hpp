#pragma once
/// \file  Quadratic drag on slender members in moving water.
#include <optional>

#include "dynamics/force/force_kind.hpp"
#include "dynamics/force/wave_signals.hpp"

namespace dynamics {

/// One piece of a member, small enough for one velocity: F = c |w| w, c = ½ ρ C_D D ℓ and w the part of u − v across
/// the axis (D7); or along it, in linear responses, of its skin (D43) or of an end (D171).
struct DragPiece {
  int body;
  Eigen::Vector3d arm;                                ///< from the centre of gravity, body axes, m
  Eigen::Vector3d axis;                               ///< unit vector, body axes
  double factor;                                      ///< c, kg/m
  Eigen::Vector3d current = Eigen::Vector3d::Zero();  ///< steady part of u, global, m/s
  bool along = false;                                 ///< w is the part along the axis
};

/// Cuts the part of a straight member that is wet at rest into Gauss–Legendre points. `from`, `to`: body axes from the
/// body's origin. Empty if the member is dry at rest.
std::vector<DragPiece> drag_pieces(const std::vector<RigidBody>& bodies, int body, const Eigen::Vector3d& from,
                                   const Eigen::Vector3d& to, double diameter, double cd, double density);

/// Global position of a piece at rest, where its water velocity is taken.
Eigen::Vector3d rest_position(const DragPiece& piece, const std::vector<RigidBody>& bodies);

class DragKind final : public ForceKind {
 public:
  /// `water`: 3 signals a piece, the undisturbed water velocity at its rest position; absent in still water. Pieces are
  /// across their axes.
  DragKind(std::vector<DragPiece> pieces, std::optional<WaveSignals> water)
      : pieces_(std::move(pieces)), water_(std::move(water)) {}
  std::string effect() const override { return "drag"; }
  std::size_t elements() const override { return pieces_.size(); }
  std::string method() const override { return "quadratic, relative velocity, water velocity at the rest position"; }
  void add_load(const Instant& now, LoadSink& out) const override;
  void add_jacobian(const Instant& now, JacobianSink& out) const override;
  EnergyFlow energy(const Instant& now) const override;

 private:
  std::vector<DragPiece> pieces_;
  std::optional<WaveSignals> water_;
};

}  // namespace dynamics
