#pragma once
/// \file  Healing of coefficients: what theory demands and the numbers miss is put right, and told.
/// Each step changes as little as it can; (P74)-(P76) in docs/theory/doctor.md say how.
#include <string>
#include <vector>

#include "hydro/potential/coefficients.hpp"

namespace hydro::potential {

/// Which steps are taken, in this order.
struct HealOptions {
  bool symmetry = true;   ///< A, B and limits become the mean of themselves and their transposes
  bool spikes = true;     ///< A and B at irregular frequencies and wrong numbers are put between their neighbours
  bool tail = true;       ///< frequencies beyond the end, with the damping that the added mass tells; A(∞) if absent
  bool passivity = true;  ///< B becomes the nearest matrix without negative eigenvalues
};

/// What one step did.
struct HealStep {
  std::string name;       ///< "symmetry", "spikes", "tail", "passivity"
  std::string what;       ///< one sentence for people
  double largest_change;  ///< of an entry that was there before, relative to the two modes it couples (P11)
};

struct Healed {
  Coefficients coefficients;  ///< with one note a step that changed anything
  std::vector<HealStep> steps;
};

/// Excitation and restoring are left as they are. At frequencies that are added, the excitation keeps its last phase
/// and follows the damping in size as Haskind's relation has it: an estimate, which the step says.
/// \throws InputError if the coefficients are not valid, or have fewer than ten frequencies and a tail is asked for
Healed heal(Coefficients coefficients, const HealOptions& options = {});

}  // namespace hydro::potential
