#include "dynamics/force/pto.hpp"

#include <fmt/format.h>

#include "coordinate_force.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

PtoKind::PtoKind(std::vector<Pto> elements) : elements_(std::move(elements)) {
  for (const Pto& e : elements_)
    hydro::ensure(e.coordinate.is_continuous(),
                  "a take-off on a hinge whose turns are not counted: it would jump at ±π");
}

PtoState pto_state(const Pto& pto, const State& state) {
  const detail::CoordinateMotion m = detail::motion_of(pto.coordinate, state, pto.sign);
  return {m.x, m.rate, pto.law.at(m.x, m.rate).force};
}

namespace {

/// How the force against the coordinate varies where the joint is still.
Variation force_variation(const Pto& pto, const State& still) {
  const detail::CoordinateMotion m = detail::motion_of(pto.coordinate, still, pto.sign);
  const PtoLaw::Working law = pto.law.at(m.x, m.rate);
  return variation_of_two(pto.coordinate.first(), pto.coordinate.second(), law.by_x * m.gradient.transpose(),
                          law.by_rate * m.gradient.transpose());
}

}  // namespace

std::vector<Signal> PtoKind::signals() const {
  std::vector<Signal> out;
  for (const Pto& e : elements_) {
    const bool turns = e.coordinate.turns();
    out.push_back({.name = e.name + (turns ? ".pto_moment" : ".pto_force"),
                   .unit = turns ? "N m" : "N",
                   .meaning = fmt::format("{} of the power take-off against the coordinate of {}",
                                          turns ? "moment" : "force", e.name),
                   .value = [e](const Reading& r) { return pto_state(e, r.state).force; },
                   .variation = [e](const Still& still) { return force_variation(e, still.state); }});
    out.push_back({.name = e.name + ".pto_power",
                   .unit = "W",
                   .meaning = fmt::format("power that the power take-off takes from {}, springs included", e.name),
                   .value =
                       [e](const Reading& r) {
                         const PtoState s = pto_state(e, r.state);
                         return s.force * s.rate;
                       },
                   .no_variation = "power is of second order in the motions"});
  }
  return out;
}

void PtoKind::couple(BlockPattern& pattern) const {
  for (const Pto& e : elements_)
    if (e.coordinate.second()) pattern.couple(e.coordinate.first(), *e.coordinate.second());
}

void PtoKind::add_load(const Instant& now, LoadSink& out) const {
  for (const Pto& e : elements_) {
    const auto m = detail::motion_of(e.coordinate, now.state, e.sign);
    detail::add_load(e.coordinate, m, e.law.at(m.x, m.rate).force, out);
  }
}

void PtoKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for (const Pto& e : elements_) {
    const auto m = detail::motion_of(e.coordinate, now.state, e.sign);
    const auto law = e.law.at(m.x, m.rate);
    detail::add_jacobian(e.coordinate, m, now.state, {law.force, law.by_x, law.by_rate}, out);
  }
}

EnergyFlow PtoKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (const Pto& e : elements_) {
    const auto m = detail::motion_of(e.coordinate, now.state, e.sign);
    const auto law = e.law.at(m.x, m.rate);
    flow.stored += law.stored;
    flow.dissipated += law.dissipated;
    flow.supplied += law.supplied;
  }
  return flow;
}

}  // namespace dynamics
