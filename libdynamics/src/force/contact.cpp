#include "dynamics/force/contact.hpp"

#include <cmath>

#include "hydro/base/error.hpp"

namespace dynamics {

ContactKind::ContactKind(std::vector<Contact> elements) : elements_(std::move(elements)) {
  for (const Contact& c : elements_) {
    hydro::require(c.restitution >= 0 && c.restitution <= 1, "contact \"{}\": restitution must lie between 0 and 1",
                   c.name);
    hydro::require(std::isfinite(c.friction) && c.friction >= 0, "contact \"{}\": friction must not be negative",
                   c.name);
    meet(c.shapes.first, c.shapes.second);  // has no law: throws
  }
}

void ContactKind::couple(BlockPattern& pattern) const {
  for (const Contact& c : elements_)
    if (c.second) pattern.couple(c.first, *c.second);
}

EnergyFlow ContactKind::energy(const Instant& now) const {
  double done = 0;
  for (const ContactState& c : static_cast<const ContactMemory&>(*now.memory).contact) done += c.dissipated;
  EnergyFlow flow;
  flow.dissipated_so_far = done;
  return flow;
}

Condition ContactKind::closed(std::size_t element) const {
  constexpr int of_no_joint = -1;
  const Contact& c = elements_[element];
  return {of_no_joint, c.first, c.second, c.shapes};
}

Meeting ContactKind::meeting(std::size_t element, const State& state) const {
  return dynamics::meeting(elements_[element].shapes, ends_of(closed(element), state));
}

ContactKind::Motion ContactKind::motion(std::size_t element, const State& state) const {
  const Contact& c = elements_[element];
  const ConditionEnds at = ends_of(closed(element), state);
  const Meeting m = dynamics::meeting(c.shapes, at);
  const auto of_point = [&](int body, const Eigen::Vector3d& centre, const Eigen::Vector3d& point) {
    const auto twist = state.twist(body);
    return Eigen::Vector3d(twist.head<3>() + twist.tail<3>().cross(point - centre));
  };
  Eigen::Vector3d v = -of_point(c.first, at.first_centre, m.on_first);
  if (c.second) v += of_point(*c.second, at.second_centre, m.on_second);
  const double parting = v.dot(m.normal);
  return {m, parting, v - parting * m.normal};
}

std::array<Condition, 2> ContactKind::sticking(std::size_t element, const State& state) const {
  const Condition c = closed(element);
  const Eigen::Vector3d n = meeting(element, state).normal, t = n.unitOrthogonal();
  std::array<Condition, 2> out{c, c};
  out[0].what = StickCondition{elements_[element].shapes, t};
  out[1].what = StickCondition{elements_[element].shapes, n.cross(t)};
  return out;
}

Gradient ContactKind::along(std::size_t element, const Eigen::Vector3d& direction, const State& state) const {
  const ConditionEnds at = ends_of(closed(element), state);
  const Meeting m = dynamics::meeting(elements_[element].shapes, at);
  return apart(direction, m.on_first, m.on_second, at);
}

double ContactKind::load(std::size_t element, const Memory* memory, const Eigen::VectorXd& multipliers) const {
  const Eigen::Index row = static_cast<const ContactMemory*>(memory)->contact[element].row;
  return row < 0 ? 0 : -multipliers[row];
}

}  // namespace dynamics
