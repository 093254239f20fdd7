#pragma once
/// \file  Private: a force against the travel of a joint, as load on both bodies and with its derivatives. (D53)
#include "dynamics/force/force_kind.hpp"
#include "dynamics/joint/travel.hpp"

namespace dynamics::detail {

/// Travel with its rate, gradient and curvature, and the velocities of both bodies; counted backwards where sign is −1.
struct TravelMotion {
  using Vector12 = Eigen::Matrix<double, 12, 1>;
  double sign, x, rate;
  Vector12 gradient, velocity;
};

inline TravelMotion motion_of(const Travel& travel, const State& state, double sign) {
  TravelMotion m;
  m.sign = sign;
  const Gradient g = travel.gradient(state);
  m.gradient << g.first, g.second;
  m.gradient *= sign;
  m.velocity.head<6>() = state.twist(travel.first());
  m.velocity.tail<6>().setZero();
  if (travel.second()) m.velocity.tail<6>() = state.twist(*travel.second());
  m.x = sign * travel.value(state);
  m.rate = m.gradient.dot(m.velocity);
  return m;
}

/// The variation of a number that changes by these with the displacements and velocities of the travel's two bodies.
inline Variation variation_of(const Travel& travel, const TravelMotion::Vector12& by_q,
                              const TravelMotion::Vector12& by_v) {
  Variation out{.parts = {{.body = travel.first(),
                           .by_motion = by_q.head<6>().transpose(),
                           .by_velocity = by_v.head<6>().transpose()}}};
  if (travel.second())
    out.parts.push_back(
        {.body = *travel.second(), .by_motion = by_q.tail<6>().transpose(), .by_velocity = by_v.tail<6>().transpose()});
  return out;
}

/// A force T(x, ẋ) against the travel and its derivatives.
struct TravelForce {
  double force, by_x, by_rate;
};

inline void add_load(const Travel& travel, const TravelMotion& m, double force, LoadSink& out) {
  const TravelMotion::Vector12 load = -force * m.gradient;
  out.add(travel.first(), load.head<6>());
  if (travel.second()) out.add(*travel.second(), load.tail<6>());
}

// F = −T(x, ẋ) ∇x, and ẋ = ∇x·v changes with q by Hᵀv, H = ∂∇x/∂q.
inline void add_jacobian(const Travel& travel, const TravelMotion& m, const State& state, const TravelForce& law,
                         JacobianSink& out) {
  const Matrix12 H = m.sign * travel.curvature(state);
  const TravelMotion::Vector12 force_by_q = law.by_x * m.gradient + law.by_rate * H.transpose() * m.velocity;
  const Matrix12 by_q = -law.force * H - m.gradient * force_by_q.transpose();
  const Matrix12 by_v = -law.by_rate * m.gradient * m.gradient.transpose();
  const int count = travel.second() ? 2 : 1;
  const int body[2] = {travel.first(), travel.second().value_or(-1)};
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      out.add(body[i], body[j], by_q.block<6, 6>(6 * i, 6 * j), by_v.block<6, 6>(6 * i, 6 * j));
}

}  // namespace dynamics::detail
