#pragma once
/// \file  How water moved at a body, from the surface that a probe recorded; (F40), docs/theory/fit.md.
#include <cstddef>
#include <span>
#include <vector>

#include "hydro/base/types.hpp"

namespace fit {

/// Where the body is, seen from the probe.
struct ProbeToBody {
  hydro::Water water;  ///< gravity and depth act
  double level;        ///< z of the body's axis, m, below still water: negative
  double ahead = 0;    ///< of the body in front of the probe in the direction waves go, m
  double highest_hz =
      0;  ///< waves above are left out; 0: those whose motion at the body is above 1/1000 of the surface's
  bool regular = false;  ///< the surface is one sinusoid, fitted to the record (F57)
  bool follow = false;   ///< the water is taken where the body is, not where it was at rest (F62)
};

struct WaterMotion {
  std::size_t first;                 ///< sample that the first values belong to; as many are given up at the end
  std::vector<double> velocity;      ///< along the waves, m/s
  std::vector<double> rise;          ///< upward, m/s
  std::vector<double> acceleration;  ///< along the waves, m/s²
  double main_period_s;
  double main_wavenumber;  ///< rad/m, of the main period
  double highest_hz;       ///< of the waves that were taken
  double left = 0;  ///< of a regular wave: rms of the surface that is not in its sinusoid, over that of the sinusoid
};

/// Linear waves of one direction: each frequency's motion at the body, summed (Fourier). The record is not periodic, so
/// one and a half main periods are given up at each end, where the transform would join both ends. Of a regular wave
/// nothing is given up, and noise of the probe averages out; its harmonics, which are bound, are left out.
/// With `follow`, `excursion_m` is how far the body is along the waves from where `ahead` puts it, at each sample of
/// the surface; else it is not read. Between places in the water 0.3/k apart, k of the highest frequency, the motion is
/// interpolated by cubics: 2e-4 of the highest waves, less of longer ones.
/// \throws hydro::InputError for `follow` without as many excursions as samples, a level not between the surface and
/// the bottom, fewer than 64 samples, or a record of fewer than five main periods, or a regular wave of which more than
/// three tenths are not in one sinusoid
WaterMotion water_motion(std::span<const double> elevation_m, double step_s, const ProbeToBody& probe,
                         std::span<const double> excursion_m = {});

}  // namespace fit
