#pragma once
/// \file  Private: a force against the coordinate of a joint, as load on both bodies and with its derivatives. (D53)
#include "dynamics/force/force_kind.hpp"
#include "dynamics/joint/coordinate.hpp"

namespace dynamics::detail {

/// Coordinate with its rate, gradient and curvature, and the velocities of both bodies; counted backwards where sign is
/// −1.
struct CoordinateMotion {
  double sign, x, rate;
  Vector12 gradient, velocity;
};

inline CoordinateMotion motion_of(const JointCoordinate& coordinate, const State& state, double sign) {
  CoordinateMotion m;
  m.sign = sign;
  const Gradient g = coordinate.gradient(state);
  m.gradient = sign * joined(g);
  m.velocity.head<6>() = state.twist(coordinate.first());
  m.velocity.tail<6>().setZero();
  if (coordinate.second()) m.velocity.tail<6>() = state.twist(*coordinate.second());
  m.x = sign * coordinate.value(state);
  m.rate = m.gradient.dot(m.velocity);
  return m;
}

/// A force T(x, ẋ) against the coordinate and its derivatives.
struct CoordinateForce {
  double force, by_x, by_rate;
};

inline void add_load(const JointCoordinate& coordinate, const CoordinateMotion& m, double force, LoadSink& out) {
  const Vector12 load = -force * m.gradient;
  out.add(coordinate.first(), load.head<6>());
  if (coordinate.second()) out.add(*coordinate.second(), load.tail<6>());
}

// F = −T(x, ẋ) ∇x, and ẋ = ∇x·v changes with q by Hᵀv, H = ∂∇x/∂q.
inline void add_jacobian(const JointCoordinate& coordinate, const CoordinateMotion& m, const State& state,
                         const CoordinateForce& law, JacobianSink& out) {
  const Matrix12 H = m.sign * coordinate.curvature(state);
  const Vector12 force_by_q = law.by_x * m.gradient + law.by_rate * H.transpose() * m.velocity;
  const Matrix12 by_q = -law.force * H - m.gradient * force_by_q.transpose();
  const Matrix12 by_v = -law.by_rate * m.gradient * m.gradient.transpose();
  out.add_pair(coordinate.first(), coordinate.second(), by_q, by_v);
}

}  // namespace dynamics::detail
