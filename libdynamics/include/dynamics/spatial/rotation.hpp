#pragma once
/// \file  Rotations in space without angles that lock: quaternions and their exponential coordinates.
///
/// A rotation vector φ stands for a turn by |φ| about φ/|φ|, global axes. With R(t) = exp([φ]×): the angular velocity
/// in global axes is ω = J(φ) φ̇, J the left Jacobian (D1). Formulas as in Solà, Deray & Atchuthan 2018 ("A micro Lie
/// theory for state estimation in robotics"), section on SO(3); derived in docs/theory/dynamics.md.
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace dynamics {

/// [v]× with [v]× w = v × w.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

/// A matrix between motions and loads (translation, rotation) of one body along axes that R turns into other ones, as
/// it is along those.
Eigen::Matrix<double, 6, 6> turned(const Eigen::Matrix<double, 6, 6>& m, const Eigen::Matrix3d& R);

/// Unit quaternion of the rotation vector φ, any length.
Eigen::Quaterniond rotation_exp(const Eigen::Vector3d& phi);

/// Rotation vector of a unit quaternion, |φ| <= π.
Eigen::Vector3d rotation_log(const Eigen::Quaterniond& q);

/// J(φ) of (D1).
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& phi);

/// J(φ)⁻¹, for |φ| < 2π.
Eigen::Matrix3d left_jacobian_inverse(const Eigen::Vector3d& phi);

/// Rz(ψ) Ry(θ) Rx(φ) of roll, pitch and yaw (φ, θ, ψ): yaw about z, pitch about the new y, roll about the newest x.
Eigen::Quaterniond attitude_of(const Eigen::Vector3d& roll_pitch_yaw);

/// Turned round: of all triples that stand for the attitude q, which are (φ, θ, ψ), (φ + π, π − θ, ψ + π) and both with
/// whole turns added to each angle, the one nearest to `near` (D133). So angles that are followed run on through half
/// and whole turns. Where θ is within 1e-7 of ±π/2, φ ∓ ψ alone is told by q, and what it differs by from `near` is
/// shared between both.
Eigen::Vector3d roll_pitch_yaw(const Eigen::Quaterniond& q, const Eigen::Vector3d& near);

/// True if the rotation vectors of two attitudes that follow each other lie on either side of half a turn.
inline bool jumps(const Eigen::Vector3d& before, const Eigen::Vector3d& after) {
  return before.dot(after) < 0 && (after - before).norm() > 3;  // 2π, less what a step turns by
}

/// The angle less or more whole turns that is nearest to `near`, rad.
double nearest_turn(double angle, double near);

/// ∂(J(φ)⁻ᵀ m)/∂φ for a constant m, for |φ| < 2π.
Eigen::Matrix3d left_jacobian_inverse_transpose_derivative(const Eigen::Vector3d& phi, const Eigen::Vector3d& m);

}  // namespace dynamics
