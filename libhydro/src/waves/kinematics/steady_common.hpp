#pragma once
/// \file  What the theories of steady waves share. Not installed.
#include "hydro/waves/kinematics/steady.hpp"

namespace hydro::waves {

/// A wave as seen from its own frame, all that a theory has to find.
struct WaveFrame {
  double k;                       ///< rad/m
  double U;                       ///< Ū, mean speed at which the water runs against the wave, m/s
  double flux;                    ///< q = Q − Ūh, m²/s
  double bernoulli;               ///< K = R − Ū²/2, m²/s²
  std::vector<double> elevation;  ///< E_j
  std::vector<double> potential;  ///< B_j
};

/// \throws InputError for numbers that no wave can have
void check(const SteadyWaveInput& input);

/// The wavenumber by linear theory, as a start, rad/m.
double linear_wavenumber(const SteadyWaveInput& input);

/// c of a wave frame under the mean flow that is asked for, (W52), m/s.
double phase_velocity(const WaveFrame& frame, const SteadyWaveInput& input);

/// Puts the wave into the fixed frame and measures its residuals.
SteadyWave finish(WaveFrame frame, const SteadyWaveInput& input);

}  // namespace hydro::waves
