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

/// Unit quaternion of the rotation vector φ, any length.
Eigen::Quaterniond rotation_exp(const Eigen::Vector3d& phi);

/// Rotation vector of a unit quaternion, |φ| <= π.
Eigen::Vector3d rotation_log(const Eigen::Quaterniond& q);

/// J(φ) of (D1).
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& phi);

/// J(φ)⁻¹, for |φ| < 2π.
Eigen::Matrix3d left_jacobian_inverse(const Eigen::Vector3d& phi);

/// ∂(J(φ)⁻ᵀ m)/∂φ for a constant m, for |φ| < 2π.
Eigen::Matrix3d left_jacobian_inverse_transpose_derivative(const Eigen::Vector3d& phi, const Eigen::Vector3d& m);

}  // namespace dynamics
