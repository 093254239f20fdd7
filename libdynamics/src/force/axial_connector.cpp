#include "axial.hpp"
#include "pair.hpp"

namespace dynamics {
namespace {

using detail::EndPoint;

struct Stretch {
  EndPoint a, b;
  Eigen::Vector3d direction, relative_velocity;  // from the first end to the second
  double length, rate;
  SpringDamperForce law;  // tension
};

Stretch stretch(const AxialConnector& c, double stiffness, const State& state) {
  Stretch s;
  s.a = detail::end_point(c.ends.first, state);
  s.b = detail::end_point(c.ends.second, state);
  const Eigen::Vector3d d = s.b.position - s.a.position;
  s.length = d.norm();
  // Ends that meet have no direction between them; the pull passes through zero there whatever it is called.
  s.direction = s.length > 0 ? Eigen::Vector3d(d / s.length) : Eigen::Vector3d::Zero();
  s.relative_velocity = s.b.velocity - s.a.velocity;
  s.rate = s.direction.dot(s.relative_velocity);
  s.law = c.law.at(s.length - c.rest_length, s.rate, stiffness);
  return s;
}

detail::PairLoad pair_load(const Stretch& s) {
  detail::PairLoad p;
  p.force = s.law.force * s.direction;
  p.first_arm = s.a.arm;
  p.second_arm = s.b.arm;
  return p;
}

void differentiate(const Stretch& s, detail::PairLoad& p) {
  if (s.length == 0) return;
  const Eigen::Matrix3d along = s.direction * s.direction.transpose();
  const Eigen::Matrix3d across = (Eigen::Matrix3d::Identity() - along) / s.length;  // ∂direction/∂d
  const Eigen::Matrix3d by_distance = s.law.by_x * along + s.law.force * across +
                                      s.law.by_rate * s.direction * (across * s.relative_velocity).transpose();
  const auto d_position = detail::relative_position_derivative(s.a, s.b);
  p.force_by_q = by_distance * d_position + s.law.by_rate * along * detail::relative_velocity_derivative(s.a, s.b);
  p.force_by_v = s.law.by_rate * along * d_position;
  p.first_arm_by_q = detail::arm_derivative(0, s.a.arm);
  p.second_arm_by_q = detail::arm_derivative(1, s.b.arm);
}

/// How the tension varies where the ends are still.
Variation tension_variation(const AxialConnector& c, double stiffness, const State& still) {
  const Stretch s = stretch(c, stiffness, still);
  const RowOfTwo by_q = s.direction.transpose() * detail::relative_position_derivative(s.a, s.b);
  return detail::variation_of(c.ends, s.law.by_x * by_q, s.law.by_rate * by_q);
}

}  // namespace

AxialState axial_state(const AxialConnector& connector, const State& state) {
  const Stretch s = stretch(connector, connector.law.stiffness, state);
  return {s.length, s.law.force};
}

std::vector<Signal> AxialConnectorKind::signals() const {
  std::vector<Signal> out;
  for (const AxialConnector& e : elements_)
    for (Signal& s : detail::axial_signals(e, [k = e.law.stiffness](const Memory*) { return k; }))
      out.push_back(std::move(s));
  return out;
}

void AxialConnectorKind::couple(BlockPattern& pattern) const {
  for (const auto& e : elements_) detail::couple(e.ends, pattern);
}

void AxialConnectorKind::add_load(const Instant& now, LoadSink& out) const {
  for (const auto& e : elements_) detail::add_axial_load(e, e.law.stiffness, now.state, out);
}

void AxialConnectorKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for (const auto& e : elements_) detail::add_axial_jacobian(e, e.law.stiffness, now.state, out);
}

EnergyFlow AxialConnectorKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (const auto& e : elements_) detail::add_axial_energy(e, e.law.stiffness, now.state, flow);
  return flow;
}

namespace detail {

void add_axial_load(const AxialConnector& connector, double stiffness, const State& state, LoadSink& out) {
  add_load(connector.ends, pair_load(stretch(connector, stiffness, state)), out);
}

void add_axial_jacobian(const AxialConnector& connector, double stiffness, const State& state, JacobianSink& out) {
  const Stretch s = stretch(connector, stiffness, state);
  PairLoad p = pair_load(s);
  differentiate(s, p);
  add_jacobian(connector.ends, p, out);
}

void add_axial_energy(const AxialConnector& connector, double stiffness, const State& state, EnergyFlow& flow) {
  const SpringDamperForce law = stretch(connector, stiffness, state).law;
  flow.stored += law.stored;
  flow.dissipated += law.dissipated;
}

std::vector<Signal> axial_signals(const AxialConnector& connector, std::function<double(const Memory*)> stiffness) {
  return {{.name = connector.name + ".force",
           .unit = "N",
           .meaning = "tension of " + connector.name,
           .value = [c = connector,
                     stiffness](const Reading& r) { return stretch(c, stiffness(r.memory), r.state).law.force; },
           .variation = [c = connector, stiffness](
                            const Still& still) { return tension_variation(c, stiffness(nullptr), still.state); }}};
}

}  // namespace detail

}  // namespace dynamics
