#pragma once
/// \file  Which theory holds for a regular wave, and whether such a wave can exist. Equations (W60)-(W62),
///        docs/theory/waves-nonlinear.md.
#include <string>
#include <string_view>
#include <vector>

#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/kinematics/steady.hpp"

namespace hydro::waves {

/// The regions of Le Méhauté's chart (1976), by what is left out when the theory is used (W61).
enum class WaveRegion { linear, stokes_second, stokes_third, stokes_fifth, cnoidal, near_breaking, breaking };
std::string_view name(WaveRegion region);

struct WaveLimits {
  WaveRegion region;
  DepthRegime depth_regime;
  double wavelength;                  ///< λ, of linear theory where the frequency was given, m
  double steepness;                   ///< H/λ
  double relative_height;             ///< H/h; 0 in infinite depth
  double relative_depth;              ///< h/λ; +∞ in infinite depth
  double ursell;                      ///< Hλ²/h³; 0 in infinite depth
  double highest;                     ///< height of the highest wave of this length (W60), m
  double miche;                       ///< 0.142 λ tanh kh, m
  std::vector<std::string> warnings;  ///< one sentence for each limit that is passed, with its numbers
};

/// Warns for Hλ²/h³ > 26, H/h > 0.78, H/λ > 0.142, H > 0.142 λ tanh kh, and H above the highest wave.
/// \throws InputError as stokes_second()
WaveLimits wave_limits(const SteadyWaveInput& input);

/// Height of the highest steady wave, m, from its length: the fit of Fenton (1990) to the computations of Williams
/// (1981); 0.1411 λ in deep water, 0.8332 h for the solitary wave. \throws InputError unless wavelength is > 0
double highest_wave(double wavelength_m, const WaterDepth& depth);

}  // namespace hydro::waves
