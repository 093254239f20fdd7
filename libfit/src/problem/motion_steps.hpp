#pragma once
/// \file  Fits of a motion whose simulation has steps: how short they must be, and what their error does; (F117),
///        docs/theory/fit.md. Private to libfit.
#include <optional>

#include "fit/problem/motion.hpp"
#include "fit/step_error.hpp"

namespace fit::motion {

/// Searches, by steps that were divided until their error is small where that is allowed.
struct SteppedSearch {
  SeveralStarts several;           ///< the best of them is the one by the last steps
  bool last_in_windows = false;    ///< the simulation's windows are those of the best
  std::optional<StepError> error;  ///< of the best; none: the simulation has no steps
  int divided = 1;                 ///< by what its steps were
};
/// The simulation keeps its divided steps.
SteppedSearch search_with_steps(const Problem& problem, const SimulationProblem& search);

/// Facts, remarks and cautions of the steps; `found` has its intervals as they were without them.
void tell_steps(const Problem& problem, const SteppedSearch& found, Report& report);
/// "half the step moves the motion by 1.2 deviations rms": what speaks against a refused fit. Empty where it is little.
std::string trouble_of_steps(const SteppedSearch& found);

/// The search of the best anew where another one came after it: windows are then as it handed them on.
SimulationFit searched_again(const Problem& problem, SimulationProblem search, const SeveralStarts& several);

}  // namespace fit::motion
