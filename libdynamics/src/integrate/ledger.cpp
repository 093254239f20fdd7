#include "dynamics/integrate/ledger.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/force/contact_law.hpp"

namespace dynamics {
namespace {

double supplied_in_impacts(const Workspace& workspace) {
  const auto* contacts = workspace.find_memory<ContactMemory>();
  return contacts != nullptr ? contacts->supplied_by_joints : 0;
}

}  // namespace

EnergyLedger::EnergyLedger(const Model& model, Workspace& workspace) : model_(model), time_(workspace.state.time) {
  kinetic_ = model.kinetic_energy(workspace.state);
  initial_ = kinetic_;
  for (std::string& effect : effects(model)) {
    before_.push_back(flow(entries_.size(), workspace));
    entries_.push_back({std::move(effect), before_.back().stored, 0, 0});
    stored_at_start_.push_back(before_.back().stored);
    initial_ += before_.back().stored;
  }
  in_impacts_ = supplied_in_impacts(workspace);
  note_turnover();
}

std::vector<std::string> EnergyLedger::effects(const Model& model) {
  std::vector<std::string> out;
  for (const auto& kind : model.forces()) out.push_back(kind->effect());
  if (model.joints().are_prescribed()) out.emplace_back("joint.prescribed");
  return out;
}

// The load of a prescribed motion on the bodies is −Gᵀλ, and G v = ṡ.
EnergyFlow EnergyLedger::flow(std::size_t entry, Workspace& workspace) const {
  const State& now = workspace.state;
  if (entry < model_.forces().size()) return model_.forces()[entry]->energy(workspace.instant(now, entry));
  return {.supplied = -model_.joints().prescribed_power(workspace.multipliers, now.time)};
}

void EnergyLedger::note(Workspace& workspace) {
  const double h = workspace.state.time - time_;
  time_ = workspace.state.time;
  kinetic_ = model_.kinetic_energy(workspace.state, momentum_);
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const EnergyFlow now = flow(k, workspace);
    entries_[k].stored = now.stored;
    entries_[k].supplied += h / 2 * (before_[k].supplied + now.supplied);
    entries_[k].dissipated += now.dissipated_so_far ? *now.dissipated_so_far - *before_[k].dissipated_so_far
                                                    : h / 2 * (before_[k].dissipated + now.dissipated);
    before_[k] = now;
  }
  if (model_.joints().are_prescribed()) {  // whose entry is the last
    const double so_far = supplied_in_impacts(workspace);
    entries_.back().supplied += so_far - in_impacts_;
    in_impacts_ = so_far;
  }
  note_turnover();
}

double EnergyLedger::residual() const {
  double r = kinetic_ - initial_;
  for (const Entry& e : entries_) r += e.stored - e.supplied + e.dissipated;
  return r;
}

// Stored energy has no zero of its own: weight is as heavy anywhere. What counts is how much of it has moved.
void EnergyLedger::note_turnover() {
  double supplied = 0, dissipated = 0, moved = kinetic_;
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    supplied += std::abs(entries_[k].supplied);
    dissipated += std::abs(entries_[k].dissipated);
    moved += std::abs(entries_[k].stored - stored_at_start_[k]);
  }
  turnover_ = std::max({turnover_, supplied, dissipated, moved});
}

}  // namespace dynamics
