#pragma once
/// \file  A run of a model by generalised-α that keeps its ledger and what changed.
#include "dynamics/integrate/generalized_alpha.hpp"
#include "dynamics/integrate/ledger.hpp"

namespace support {

struct Motion {
  dynamics::Workspace workspace;
  dynamics::GeneralizedAlpha integrator;
  dynamics::EnergyLedger ledger;
  std::vector<dynamics::Event> events;

  Motion(const dynamics::Model& model, dynamics::State start, double rho = 0.8)
      : workspace(model, std::move(start)), integrator(started(model, workspace, rho)), ledger(model, workspace) {}
  void go(double h, int steps) {
    for (int i = 0; i < steps; ++i) {
      const auto report = integrator.step(workspace, h);
      events.insert(events.end(), report.events.begin(), report.events.end());
      ledger.note(workspace);
    }
  }
  int changes() const { return static_cast<int>(events.size()); }

 private:
  static dynamics::GeneralizedAlpha started(const dynamics::Model& model, dynamics::Workspace& w, double rho) {
    dynamics::GeneralizedAlpha out(model, {.rho_infinity = rho});
    out.start(w);
    return out;
  }
};

}  // namespace support
