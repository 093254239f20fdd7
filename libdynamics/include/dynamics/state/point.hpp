#pragma once
/// \file  Points of bodies and of the ground: where they are and how they move.
///
/// What moves with a body is given in the body's frame: from its centre of gravity, along axes fixed to it. What stays
/// is given in the global frame. Which of the two a point is in, its type says; a constraint or contact, which holds
/// shapes and directions too, has them in the frames of its first and second, and the frame of the ground is the global
/// one.
#include <Eigen/Core>

#include <optional>
#include <variant>

#include "dynamics/state/body.hpp"

namespace dynamics {

/// A point that moves with a body.
struct PointOnBody {
  int body;
  Eigen::Vector3d arm;  ///< from the centre of gravity, body axes, m
};

/// A point that stays.
struct PointOnGround {
  Eigen::Vector3d place;  ///< global, m
};

using Point = std::variant<PointOnBody, PointOnGround>;

/// The body that a point moves with; empty: it stays.
std::optional<int> body_of(const Point& point);

/// From the centre of gravity to the point, global axes, m.
Eigen::Vector3d arm_of(const PointOnBody& point, const State& state);
Eigen::Vector3d place_of(const PointOnBody& point, const State& state);
Eigen::Vector3d velocity_of(const PointOnBody& point, const State& state);
/// Where bodies have `acceleration`, (6N), of their centres of gravity: a + α × r + ω × (ω × r).
Eigen::Vector3d acceleration_of(const PointOnBody& point, const State& state, const Eigen::VectorXd& acceleration);
/// How its place varies with displacement of its body (translation and small global rotation), and its velocity with
/// the body's: (1, −[r]×) for the arm r.
Eigen::Matrix<double, 3, 6> place_by_displacement(const Eigen::Vector3d& arm);

/// A frame as it stands: of a body, or the global one.
struct Frame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();    ///< global, m
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns; turns what is given along them to global axes
};
/// That of the ground where there is no body.
Frame frame_of(const std::optional<int>& body, const State& state);

}  // namespace dynamics
