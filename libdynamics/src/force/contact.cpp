#include "dynamics/force/contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

/// How a centre goes through a step: the cubic by its places and velocities at both ends.
struct Course {
  Eigen::Vector3d from, to, start, end;  // places; velocities times the step

  Eigen::Vector3d at(double s) const {
    const Eigen::Vector3d way = to - from, c = 3 * way - 2 * start - end, d = start + end - 2 * way;
    return from + s * (start + s * (c + s * d));
  }
  /// Its length at most: the rate of a cubic lies between the three numbers that make it.
  double length() const {
    return std::max({start.norm(), end.norm(), Eigen::Vector3d(3 * (to - from) - start - end).norm()});
  }
};

/// Of the centre of a body, or of the ground, which stays.
Course course_of(std::optional<int> body, const State& before, const State& after) {
  if (!body) return {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  const auto i = static_cast<std::size_t>(*body);
  const double h = after.time - before.time;
  return {before.pose[i].centre, after.pose[i].centre, h * before.twist(*body).head<3>(),
          h * after.twist(*body).head<3>()};
}

Eigen::Quaterniond turn_of(std::optional<int> body, const State& state) {
  return body ? state.pose[static_cast<std::size_t>(*body)].attitude : Eigen::Quaterniond::Identity();
}

}  // namespace

ContactKind::ContactKind(std::vector<Contact> elements) : elements_(std::move(elements)) {
  for (const Contact& c : elements_) {
    hydro::require(c.restitution >= 0 && c.restitution <= 1, "contact \"{}\": restitution must lie between 0 and 1",
                   c.name);
    hydro::require(std::isfinite(c.friction) && c.friction >= 0, "contact \"{}\": friction must not be negative",
                   c.name);
    dynamics::closest_points(c.shapes.first, c.shapes.second);  // has no law: throws
    hydro::require(half_thickness(c.shapes.first) + half_thickness(c.shapes.second) > 0,
                   "contact \"{}\": neither of its shapes has a thickness, so they would never be seen to meet",
                   c.name);
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

Constraint ContactKind::closed(std::size_t element) const {
  constexpr int of_no_joint = -1;
  const Contact& c = elements_[element];
  return {of_no_joint, c.first, c.second, c.shapes};
}

std::vector<Signal> ContactKind::signals() const {
  const std::string apart = "contacts are left out of small motions: bodies are taken not to touch";
  std::vector<Signal> out;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Contact& c = elements_[i];
    out.push_back({.name = c.name + ".gap",
                   .unit = "m",
                   .meaning = "shortest way between the shapes of " + c.name,
                   .value = [this, i](const Reading& r) { return gap(i, r.state); },
                   .variation =
                       [c](const Still& still) {
                         const Gradient g = gradient(c.shapes, ends_of({-1, c.first, c.second, c.shapes}, still.state));
                         return variation_of_two(c.first, c.second, joined(g).transpose());
                       }});
    out.push_back({.name = c.name + ".force",
                   .unit = "N",
                   .meaning = "load along the normal of " + c.name + " while it is closed",
                   .value = [this, i](const Reading& r) { return load(i, r.memory, r.multipliers); },
                   .no_variation = apart});
    out.push_back({.name = c.name + ".impacts",
                   .unit = "1",
                   .meaning = "impacts of " + c.name + " since the start",
                   .value =
                       [i](const Reading& r) {
                         return static_cast<double>(static_cast<const ContactMemory*>(r.memory)->contact[i].impacts);
                       },
                   .no_variation = apart});
  }
  return out;
}

ClosestPoints ContactKind::closest_points(std::size_t element, const State& state) const {
  return dynamics::closest_points(elements_[element].shapes, ends_of(closed(element), state));
}

ContactKind::Motion ContactKind::motion(std::size_t element, const State& state) const {
  const Contact& c = elements_[element];
  const ConstraintEnds at = ends_of(closed(element), state);
  const ClosestPoints m = dynamics::closest_points(c.shapes, at);
  const auto of_point = [&](int body, const Eigen::Vector3d& centre, const Eigen::Vector3d& point) {
    const auto twist = state.twist(body);
    return Eigen::Vector3d(twist.head<3>() + twist.tail<3>().cross(point - centre));
  };
  Eigen::Vector3d v = -of_point(c.first, at.first.origin, m.on_first);
  if (c.second) v += of_point(*c.second, at.second.origin, m.on_second);
  const double parting = v.dot(m.normal);
  return {m, parting, v - parting * m.normal};
}

// (D131) The gap changes by no more than points move, so as long as it is large the next look may be far away; a
// quarter of what is thinnest is close enough not to miss what goes through its middle.
std::optional<double> ContactKind::passing(std::size_t element, const State& before, const State& after) const {
  const Contact& c = elements_[element];
  const double thick = half_thickness(c.shapes.first) + half_thickness(c.shapes.second);
  if (std::isinf(thick)) return {};  // out of a half-space nothing comes on the other side
  const Course one = course_of(c.first, before, after), other = course_of(c.second, before, after);
  const Course against{other.from - one.from, other.to - one.to, other.start - one.start, other.end - one.end};
  const auto turned = [&](std::optional<int> body, const Shape& shape) {
    return body ? turn_of(body, before).angularDistance(turn_of(body, after)) * reach(shape) : 0.0;
  };
  const double way = against.length() + turned(c.first, c.shapes.first) + turned(c.second, c.shapes.second);
  const double apart_before = gap(element, before);
  if (way <= thick || apart_before + gap(element, after) >= way) return {};
  for (double s = std::max(apart_before, thick / 4) / way; s < 1;) {
    const auto attitude = [&](std::optional<int> body) {
      return turn_of(body, before).slerp(s, turn_of(body, after)).toRotationMatrix();
    };
    const ConstraintEnds there{{one.at(s), attitude(c.first)},
                               {other.at(s), attitude(c.second)},
                               before.time + s * (after.time - before.time)};
    const double apart = dynamics::closest_points(c.shapes, there).gap;
    if (apart < 0) return s;
    s += std::max(apart, thick / 4) / way;
  }
  return {};
}

std::array<Constraint, 2> ContactKind::sticking(std::size_t element, const State& state) const {
  const Constraint c = closed(element);
  const Eigen::Vector3d n = closest_points(element, state).normal, t = n.unitOrthogonal();
  std::array<Constraint, 2> out{c, c};
  out[0].what = StickConstraint{elements_[element].shapes, t};
  out[1].what = StickConstraint{elements_[element].shapes, n.cross(t)};
  return out;
}

Gradient ContactKind::along(std::size_t element, const Eigen::Vector3d& direction, const State& state) const {
  const ConstraintEnds at = ends_of(closed(element), state);
  const ClosestPoints m = dynamics::closest_points(elements_[element].shapes, at);
  return apart(direction, m.on_first, m.on_second, at);
}

double ContactKind::load(std::size_t element, const Memory* memory, const Eigen::VectorXd& multipliers) const {
  const Eigen::Index row = static_cast<const ContactMemory*>(memory)->contact[element].row;
  return row < 0 ? 0 : -multipliers[row];
}

}  // namespace dynamics
