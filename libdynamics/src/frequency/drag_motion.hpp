#pragma once
/// \file  Private: how pieces of members move with their bodies and in waves, for linear drag. (Q5), (D143)
#include <Eigen/Core>

#include <vector>

#include "dynamics/force/drag.hpp"
#include "dynamics/spatial/rotation.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/kinematics/kinematics.hpp"

namespace dynamics::frequency {

/// Arm and axis along global axes, where bodies are still.
inline DragPiece turned(DragPiece piece, const State& still) {
  const Eigen::Quaterniond& attitude = still.pose[static_cast<std::size_t>(piece.body)].attitude;
  piece.arm = attitude * piece.arm;
  piece.axis = attitude * piece.axis;
  return piece;
}
inline std::vector<DragPiece> turned(std::vector<DragPiece> pieces, const State& still) {
  for (DragPiece& piece : pieces) piece = turned(piece, still);
  return pieces;
}

/// A wave of one metre amplitude without phase.
inline hydro::waves::Component unit_wave(const hydro::Water& water, double omega, double heading) {
  return {.omega = omega,
          .k = hydro::waves::wavenumber(omega, water),
          .sigma = omega,
          .amplitude = 1,
          .phase = 0,
          .heading = heading};
}

/// P: onto the plane across the axis of a piece, or onto the axis.
inline Eigen::Matrix3d projection(const DragPiece& piece) {
  const Eigen::Matrix3d onto_axis = piece.axis * piece.axis.transpose();
  return piece.along ? onto_axis : Eigen::Matrix3d::Identity() - onto_axis;
}

/// PJ, the part that a piece feels of its own velocity, by the velocity of its body.
inline Eigen::Matrix<double, 3, 6> projected_velocity(const DragPiece& piece) {
  Eigen::Matrix<double, 3, 6> J;
  J << Eigen::Matrix3d::Identity(), -cross_matrix(piece.arm);
  return projection(piece) * J;
}

/// Of the undisturbed water at pieces where they are as placed, m/s per metre of wave, (3 pieces).
inline Eigen::VectorXcd water_velocity(const std::vector<DragPiece>& pieces, const std::vector<RigidBody>& bodies,
                                       const hydro::Water& water, double omega, double heading) {
  const hydro::waves::Component wave = unit_wave(water, omega, heading);
  Eigen::VectorXcd out(3 * static_cast<Eigen::Index>(pieces.size()));
  for (std::size_t i = 0; i < pieces.size(); ++i)
    out.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        hydro::waves::velocity_transfer(wave, water, rest_position(pieces[i], bodies));
  return out;
}

}  // namespace dynamics::frequency
