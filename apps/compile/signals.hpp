#pragma once
/// \file  Private to compile/: signals that a sea drives, on the grid of steps.
#include <Eigen/Core>

#include "dynamics/force/wave_signals.hpp"
#include "hydro/waves/kinematics/sea.hpp"

namespace froude::compile {

/// The steps of a run.
struct StepGrid {
  double step;          ///< s
  std::size_t samples;  ///< with the first, at t = 0
};

/// One row of complex amplitudes a signal, one column a component of the sea.
dynamics::WaveSignals signals(const hydro::waves::Sea& sea, const Eigen::MatrixXcd& amplitudes, const StepGrid& grid,
                              double ramp_s);

}  // namespace froude::compile
