#include "dynamics/force/switched_connector.hpp"

#include "axial.hpp"
#include "pair.hpp"

namespace dynamics {
namespace {

/// Calls use(connector, its stiffness now) for all of all groups; at rest, without memory, as they begin.
template <class Use>
void for_each(const std::vector<SwitchedConnectors>& groups, const std::vector<double>* stiffness, Use use) {
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const AxialConnector& c : groups[g]) use(c, stiffness != nullptr ? (*stiffness)[g] : c.law.stiffness);
}

const std::vector<double>* set_in(const Instant& now) {
  return now.memory == nullptr ? nullptr : &static_cast<const SwitchMemory*>(now.memory)->stiffness;
}

}  // namespace

SwitchMemory::SwitchMemory(const std::vector<SwitchedConnectors>& groups, const State& start)
    : switches(groups.size(), 0), groups_(groups), time_(start.time) {
  for (const SwitchedConnectors& group : groups) stiffness.push_back(group.front().law.stiffness);
  power_ = flow(start).dissipated;
}

EnergyFlow SwitchMemory::flow(const State& state) const {
  EnergyFlow out;
  for_each(groups_, &stiffness, [&](const AxialConnector& c, double k) { detail::add_axial_energy(c, k, state, out); });
  return out;
}

void SwitchMemory::accept(const State& state) {
  const double power = flow(state).dissipated;
  dissipated += (state.time - time_) * (power_ + power) / 2;
  time_ = state.time;
  power_ = power;
}

// A switch changes what the springs hold at once: the controller pays for it or takes it.
bool SwitchMemory::set(std::size_t group, double stiffness_N_per_m, const State& now) {
  if (stiffness[group] == stiffness_N_per_m) return false;
  const EnergyFlow before = flow(now);
  stiffness[group] = stiffness_N_per_m;
  ++switches[group];
  const EnergyFlow after = flow(now);
  dissipated -= after.stored - before.stored;
  power_ = after.dissipated;
  return true;
}

std::vector<Signal> SwitchedConnectorKind::signals() const {
  std::vector<Signal> out;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const auto stiffness = [g](const Memory* memory) { return static_cast<const SwitchMemory*>(memory)->stiffness[g]; };
    for (const AxialConnector& c : groups_[g]) {
      const auto now = [first = c.law.stiffness, stiffness](const Memory* memory) {
        return memory == nullptr ? first : stiffness(memory);
      };
      for (Signal& s : detail::axial_signals(c, now)) out.push_back(std::move(s));
      out.push_back({.name = c.name + ".stiffness",
                     .unit = "N/m",
                     .meaning = "stiffness of " + c.name + " as its controller has set it",
                     .value = [stiffness](const Reading& r) { return stiffness(r.memory); },
                     .no_variation = "small motions have the stiffness that connectors begin with"});
    }
  }
  return out;
}

std::size_t SwitchedConnectorKind::elements() const {
  std::size_t count = 0;
  for (const auto& group : groups_) count += group.size();
  return count;
}

void SwitchedConnectorKind::couple(BlockPattern& pattern) const {
  for_each(groups_, nullptr, [&](const AxialConnector& c, double) { detail::couple(c.ends, pattern); });
}

void SwitchedConnectorKind::add_load(const Instant& now, LoadSink& out) const {
  for_each(groups_, set_in(now),
           [&](const AxialConnector& c, double k) { detail::add_axial_load(c, k, now.state, out); });
}

void SwitchedConnectorKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for_each(groups_, set_in(now),
           [&](const AxialConnector& c, double k) { detail::add_axial_jacobian(c, k, now.state, out); });
}

EnergyFlow SwitchedConnectorKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for_each(groups_, set_in(now),
           [&](const AxialConnector& c, double k) { detail::add_axial_energy(c, k, now.state, flow); });
  if (now.memory != nullptr) flow.dissipated_so_far = static_cast<const SwitchMemory*>(now.memory)->dissipated;
  return flow;
}

}  // namespace dynamics
