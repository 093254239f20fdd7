#pragma once
/// \file  Private to apps: periodic motions of a scene in regular waves, and what is told of each.
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "answers/periodic_scene.hpp"
#include "dynamics/frequency/harmonic_balance.hpp"
#include "froude/result.hpp"

namespace froude {

/// What all cells and branches of a map share.
class PeriodicAnswers {
 public:
  /// All are referred to and must live as long. \throws hydro::InputError at a name that is no signal's
  PeriodicAnswers(const scene::Scene& scene, const compile::Prepared& prepared);

  /// In these waves; the same system as long as they are asked for one time after another, as for a motion, its
  /// multipliers and its deviations, so that joints are closed from where they were.
  std::shared_ptr<PeriodicScene> at(double period, double height) const;
  dynamics::frequency::Family by_height(double period) const;
  dynamics::frequency::Family by_period(double height) const;
  /// Near `start`, whose period may be another.
  dynamics::frequency::Balance balance(PeriodicScene& system, dynamics::frequency::PeriodicMotion start) const;
  /// A motion and how it was come to.
  struct Arrival {
    dynamics::frequency::Balance end;
    StabilityMap::Reached reached;
  };
  /// In waves of this height from two motions in lower ones, by Newton or along the branch.
  Arrival reached(double period, const dynamics::frequency::MotionAt& before, const dynamics::frequency::MotionAt& from,
                  double height) const;
  /// The same from rest, by way of waves of an eighth of this height.
  Arrival from_rest(double period, double height) const;
  /// No waves, no motion.
  dynamics::frequency::MotionAt still(double period) const;
  /// Waves of next to no height, m.
  double lowest_height() const { return 1e-3 * scene_.stability->heights.front(); }
  bool beyond_breaking(double period, double height) const;
  const dynamics::frequency::BalanceOptions& options() const { return options_; }

  /// The signals asked for, without values.
  std::vector<Signal> signals() const;
  /// What becomes of a motion, and its standard deviations, one a signal.
  StabilityMap::Motion told(PeriodicScene& system, const dynamics::frequency::PeriodicMotion& motion) const;
  std::vector<double> deviations(PeriodicScene& system, const dynamics::frequency::PeriodicMotion& motion) const;

 private:
  const scene::Scene& scene_;
  const compile::Prepared& prepared_;
  dynamics::frequency::BalanceOptions options_;
  struct Last {
    double period, height;
    std::shared_ptr<PeriodicScene> system;
  };
  mutable Last last_{};
};

/// One branch that [ask.stability] asks for, from the lowest period or height of the map to the highest, as far as
/// there are such waves.
StabilityMap::Branch followed(const PeriodicAnswers& answers, const scene::AskStability& ask,
                              const scene::AskStability::Branch& branch);

}  // namespace froude
