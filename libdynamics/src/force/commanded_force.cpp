#include "dynamics/force/commanded_force.hpp"

#include <cmath>

namespace dynamics {
namespace {

Pto bounds_of(Pto pto) {
  pto.law.line = {};
  pto.law.preload = 0;
  return pto;
}

const CommandMemory& memory_of(const Memory* memory) { return *static_cast<const CommandMemory*>(memory); }

}  // namespace

CommandMemory::CommandMemory(const std::vector<Pto>& elements) {
  for (const Pto& pto : elements) elements_.push_back({pto, PtoKind({pto}), bounds_of(pto)});
}

// A controller that sets a spring and a damper says the same law again and again, to rounding: nothing jumps then.
bool CommandMemory::set(std::size_t element, const Command& command, const State& now) {
  constexpr double rounding = 1e-12;
  Element& e = elements_[element];
  const PtoState before = pto_state(e.pto, now);
  if (!e.is_set)
    e.held =
        e.pto.law.at(before.coordinate, before.rate).stored - e.bounds.law.at(before.coordinate, before.rate).stored;
  e.is_set = true;
  const double spring = command.stiffness * before.coordinate, damper = command.damping * before.rate;
  e.pto.law.line = {.stiffness = command.stiffness, .damping = command.damping};
  e.pto.law.preload = command.force - spring - damper;
  e.kind = PtoKind({e.pto});
  return std::abs(pto_state(e.pto, now).force - before.force) >
         rounding * (std::abs(command.force) + std::abs(spring) + std::abs(damper));
}

EnergyFlow CommandMemory::energy(std::size_t element, const State& now) const {
  const Element& e = elements_[element];
  if (!e.is_set) return e.kind.energy({now, nullptr});
  const PtoState all = pto_state(e.pto, now), stops = pto_state(e.bounds, now);
  const PtoLaw::Working of_stops = e.bounds.law.at(stops.coordinate, stops.rate);
  return {.stored = of_stops.stored + e.held,
          .supplied = -(all.force - stops.force) * all.rate,
          .dissipated = of_stops.dissipated};
}

CommandedForceKind::CommandedForceKind(const std::vector<Pto>& elements) : elements_(elements), own_(elements) {}

void CommandedForceKind::add_load(const Instant& now, LoadSink& out) const {
  if (now.memory == nullptr) return own_.add_load(now, out);
  for (std::size_t i = 0; i < elements_.size(); ++i) memory_of(now.memory).kind(i).add_load({now.state, nullptr}, out);
}

void CommandedForceKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  if (now.memory == nullptr) return own_.add_jacobian(now, out);
  for (std::size_t i = 0; i < elements_.size(); ++i)
    memory_of(now.memory).kind(i).add_jacobian({now.state, nullptr}, out);
}

EnergyFlow CommandedForceKind::energy(const Instant& now) const {
  if (now.memory == nullptr) return own_.energy(now);
  EnergyFlow out;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const EnergyFlow one = memory_of(now.memory).energy(i, now.state);
    out.stored += one.stored;
    out.supplied += one.supplied;
    out.dissipated += one.dissipated;
  }
  return out;
}

std::vector<Signal> CommandedForceKind::signals() const {
  std::vector<Signal> out;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const auto now = [i, own = elements_[i]](const Reading& r) {
      return pto_state(r.memory == nullptr ? own : memory_of(r.memory).acting(i), r.state);
    };
    std::vector<Signal> of_pto = PtoKind({elements_[i]}).signals();  // force, then power
    of_pto[0].value = [now](const Reading& r) { return now(r).force; };
    of_pto[1].value = [now](const Reading& r) {
      const PtoState at = now(r);
      return at.force * at.rate;
    };
    for (Signal& s : of_pto) out.push_back(std::move(s));
  }
  return out;
}

}  // namespace dynamics
