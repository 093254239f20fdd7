#include "dynamics/force/pto.hpp"

namespace dynamics {
namespace {

using Vector12 = Eigen::Matrix<double, 12, 1>;

/// Travel and gradient as the law counts them, and the velocities of both bodies.
struct Motion {
  double x, rate;
  Vector12 gradient, velocity;
};

Motion motion_of(const Pto& e, const State& state) {
  Motion m;
  const Gradient g = e.travel.gradient(state);
  m.gradient << g.first, g.second;
  m.gradient *= e.sign;
  m.velocity.head<6>() = state.twist(e.travel.first());
  m.velocity.tail<6>().setZero();
  if (e.travel.second()) m.velocity.tail<6>() = state.twist(*e.travel.second());
  m.x = e.sign * e.travel.value(state);
  m.rate = m.gradient.dot(m.velocity);
  return m;
}

}  // namespace

PtoState pto_state(const Pto& pto, const State& state) {
  const Motion m = motion_of(pto, state);
  return {m.x, m.rate, pto.law.at(m.x, m.rate).force};
}

void PtoKind::couple(BlockPattern& pattern) const {
  for (const Pto& e : elements_)
    if (e.travel.second()) pattern.couple(e.travel.first(), *e.travel.second());
}

void PtoKind::add_load(const Instant& now, LoadSink& out) const {
  for (const Pto& e : elements_) {
    const Motion m = motion_of(e, now.state);
    const Vector12 load = -e.law.at(m.x, m.rate).force * m.gradient;
    out.add(e.travel.first(), load.head<6>());
    if (e.travel.second()) out.add(*e.travel.second(), load.tail<6>());
  }
}

// F = −T(x, ẋ) ∇x, and ẋ = ∇x·v changes with q by Hᵀv, H = ∂∇x/∂q (D53).
void PtoKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for (const Pto& e : elements_) {
    const Motion m = motion_of(e, now.state);
    const auto law = e.law.at(m.x, m.rate);
    const Matrix12 H = e.sign * e.travel.curvature(now.state);
    const Vector12 force_by_q = law.by_x * m.gradient + law.by_rate * H.transpose() * m.velocity;
    const Matrix12 by_q = -law.force * H - m.gradient * force_by_q.transpose();
    const Matrix12 by_v = -law.by_rate * m.gradient * m.gradient.transpose();
    const int count = e.travel.second() ? 2 : 1;
    const int body[2] = {e.travel.first(), e.travel.second().value_or(-1)};
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j)
        out.add(body[i], body[j], by_q.block<6, 6>(6 * i, 6 * j), by_v.block<6, 6>(6 * i, 6 * j));
  }
}

EnergyFlow PtoKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (const Pto& e : elements_) {
    const Motion m = motion_of(e, now.state);
    const auto law = e.law.at(m.x, m.rate);
    flow.stored += law.stored;
    flow.dissipated += law.dissipated;
    flow.supplied += law.supplied;
  }
  return flow;
}

}  // namespace dynamics
