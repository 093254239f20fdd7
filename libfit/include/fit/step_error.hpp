#pragma once
/// \file  What the steps of a simulation do to the parameters that were fitted with it; (F117), docs/theory/fit.md.
#include <Eigen/Core>

#include <optional>
#include <string>

#include "fit/simulated.hpp"

namespace fit {

/// An error of steps below this share of an interval's half-width is small: it costs 95 % of coverage less than 1 %.
constexpr double small_step_error = 0.2;

struct StepError {
  /// By how much each parameter would move if the steps were infinitely short, to first order; zero for one that stands
  /// at a bound or that the data do not see.
  Eigen::VectorXd shift;
  Eigen::VectorXd falls;  ///< by what half the step divides that shift, 2 … 16
  double motion = 0;      ///< rms of what half the step changes in the samples, over their deviations
  std::string unknown;    ///< why there is no error: a run of shorter steps has no end. Empty: there is one
};

/// By runs of half and a quarter of the step from where `fit` ended, whose steps were those of the simulation divided
/// by `divided`, as they are again afterwards. None: the simulation has no steps of its own. `fit` is that of this
/// problem, and its search the last that `simulation` went through in windows. Cost: one run of the record, one of half
/// and one of a quarter of the step.
std::optional<StepError> step_error(Simulation& simulation, const SimulationProblem& problem, const SimulationFit& fit,
                                    int divided);

/// |shift| of a parameter over the half-width of its interval; zero for one without a value or an error.
double share_of_half_width(const StepError& error, const SimulationFit& fit, std::size_t parameter);
/// The least power of two by which steps must be divided for all shares to fall to three quarters of
/// `small_step_error`, or for what half the step changes in the motion of a refused fit, as often of its deviations.
int division_needed(const StepError& error, const SimulationFit& fit);
/// Intervals then reach from where they are to where infinitely short steps would have them.
void count_steps(const StepError& error, SimulationFit& fit);
Interval with_steps(const StepError& error, std::size_t parameter, const Interval& interval);

}  // namespace fit
