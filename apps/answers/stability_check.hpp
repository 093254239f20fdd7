#pragma once
/// \file  Periodic motions held against runs in time: for `froude stability --check time`. Private to apps.
#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "dynamics/state/signal.hpp"
#include "froude/result.hpp"
#include "scene/scene.hpp"

namespace dynamics {
class Model;
}

namespace froude {

/// Signals of the model by the names asked for; those of energies, waves and lines are not the model's.
/// \throws hydro::InputError at a name that is no signal's
std::vector<dynamics::Signal> signals_of_map(const scene::AskStability& ask, const dynamics::Model& model);

/// About the mean.
double standard_deviation(const Eigen::Ref<const Eigen::VectorXd>& x);

/// A cell of a map, stepped in time from rest.
struct SteppedCell {
  std::size_t cell;
  double apart = 0;     ///< rms of what the run is off the periodic motion, over both, in the worst signal
  bool decided = true;  ///< a disturbance of a thousandth would have grown to the size of the motion, or died to it
  std::string stopped;  ///< why the run ended early; empty: it did not

  /// The run is elsewhere: runs of the accuracy that they have by themselves are some per cent off.
  bool left() const { return !stopped.empty() || apart > 0.1; }
  bool agrees(const StabilityMap::Cell& of) const { return left() != (of.fate == dynamics::frequency::Fate::stable); }
};

struct MapCheck {
  std::vector<SteppedCell> cells;
  double processor_s = 0;  ///< of the runs
};

/// Which cells are stepped: `count`, spread over both periods and heights among those that have a motion, in the
/// map's order.
std::vector<std::size_t> cells_to_step(const StabilityMap& map, std::size_t count);

/// Steps cells of a map for `duration`, s, with the step and memory of runs that harmonic balance has, and compares the
/// last fifth. `done` is told the share of the runs completed. \throws hydro::InputError where the scene cannot run
MapCheck check_in_time(const scene::Scene& scene, const StabilityMap& map, std::size_t count, double duration,
                       const std::function<void(double)>& done = {});

}  // namespace froude
