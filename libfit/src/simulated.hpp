#pragma once
/// \file  The parts of a fit by simulation: the search, and what is told of its end; (F41)-(F43), docs/theory/fit.md.
///        Private to libfit.
#include <Eigen/Core>

#include <vector>

#include "fit/simulated.hpp"

namespace fit {

/// One window of the problem with the directions of its start that the data see.
struct WindowOfSearch {
  Eigen::MatrixXd seen;  // shape (coordinates, directions): orthonormal columns
  Eigen::Index row, column;
};

/// A direction counts as not seen below this singular value relative to the largest: central differences are off by
/// about the square of their step, 1e-8.
constexpr double not_seen_by_differences = 1e-6;

/// Where a search came to, with all that can be told from there.
struct EndOfSearch {
  SearchReport search;
  Eigen::VectorXd x;  ///< parameters, then the starts of the windows along the directions seen
  Eigen::VectorXd r;  ///< residuals over deviations: windows one after the other, in each one channel after the other
  Eigen::MatrixXd jacobian;
  std::vector<WindowOfSearch> windows;
  Eigen::Index starts_all;                   ///< numbers of all windows' starts, seen or not
  long followed;                             ///< windows that it took
  std::vector<Eigen::MatrixXd> motion = {};  ///< as measured; only of problems with `whitening`

  Eigen::VectorXd start(std::size_t w) const {
    return windows[w].seen * x.segment(windows[w].column, windows[w].seen.cols());
  }
};

/// Makes the residuals of a window, each over its deviation, independent; those that were not measured become zero.
/// (F101)
void whiten(const SimulationProblem& problem, std::size_t window, Eigen::MatrixXd& residuals);
/// Rows of residuals that were measured: windows one after the other, in each one channel after the other.
std::vector<Eigen::Index> measured_rows(const SimulationProblem& problem);

/// \throws as fit_simulation()
EndOfSearch search_simulation(Simulation& simulation, const SimulationProblem& problem);
/// Residuals over deviations of all windows where the search of `fit` ended, by the simulation as it is now.
Eigen::VectorXd residuals_at_end(Simulation& simulation, const SimulationProblem& problem, const SimulationFit& fit);
/// The least cost alone, of any number of parameters. \throws as fit_simulation(), and SearchFailed
double least_cost(Simulation& simulation, const SimulationProblem& problem);
/// The cost from `problem.begin` after two steps by its Jacobian: the least, as far as the residuals are straight
/// there. \throws as fit_simulation()
double cost_nearby(Simulation& simulation, const SimulationProblem& problem);
/// (F76) Rise of the cost at both ends of each interval against what the second derivative says. Where they differ the
/// interval becomes that of the likelihood, and where that has no ends either, there is no value.
void compare_with_likelihood(Simulation& simulation, const SimulationProblem& problem, SimulationFit& fit);
/// Values, intervals and bands at that end, or why there are none.
SimulationFit told(const SimulationProblem& problem, EndOfSearch end);

}  // namespace fit
