#pragma once
/// \file  The energy ledger: what each effect supplied, stored and took away, and the residual.
#include <Eigen/Core>

#include <string>
#include <vector>

#include "dynamics/model/model.hpp"

namespace dynamics {

/// One entry for each kind of force, and "joint.prescribed" where joints have a prescribed motion: they work by their
/// multipliers (D31), and in impacts by impulses. Kinetic + stored = initial + ∫(supplied − dissipated) dt + residual
/// (D12). Powers are integrated by the trapezium rule over the steps, so the residual holds the error of the step as
/// well as of the loads.
class EnergyLedger {
 public:
  struct Entry {
    std::string effect;
    double stored = 0, supplied = 0, dissipated = 0;  ///< J; the last two since the start

    void keep_state(hydro::StateBytes& bytes) { bytes.pass(effect, stored, supplied, dissipated); }
  };

  EnergyLedger(const Model& model, Workspace& workspace);
  /// The effects of its entries, in their order.
  static std::vector<std::string> effects(const Model& model);

  /// Adds the step that ended in the state of the workspace.
  void note(Workspace& workspace);

  /// Its sums: taken up, or given back to a ledger of the same model.
  void keep_state(hydro::StateBytes& bytes) {
    bytes.pass(entries_, before_, stored_at_start_, kinetic_, initial_, time_, turnover_, in_impacts_);
  }

  double kinetic() const { return kinetic_; }
  const std::vector<Entry>& entries() const { return entries_; }
  double residual() const;
  /// What a residual is small against: the most that was supplied, taken, or, since the start, moved from where it was
  /// held, at any step so far.
  double turnover() const { return turnover_; }

 private:
  const Model& model_;
  std::vector<Entry> entries_;
  EnergyFlow flow(std::size_t entry, Workspace& workspace) const;

  void note_turnover();

  std::vector<EnergyFlow> before_;
  std::vector<double> stored_at_start_;
  Eigen::VectorXd momentum_;  // room for kinetic energies
  double kinetic_ = 0, initial_ = 0, time_ = 0, turnover_ = 0;
  double in_impacts_ = 0;  // J, that prescribed motions have supplied by impulses, as far as it is noted
};

}  // namespace dynamics
