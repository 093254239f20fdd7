#pragma once
/// \file  Regular waves that take turns: trains, each of which fades into the next, as one sum of linear waves. (W102)
///
///   ζ(t) = Σ_i e_i(t) a_i cos(ω_i t + φ_i)   at one place,   e_i rising and falling by half a cosine,
///
/// is cut into Fourier components over a span at whose ends the water is still; each of them goes on from there by
/// linear dispersion. The sum is a solution of the linear equations everywhere: a change travels as waves do, and
/// elevation, velocities and accelerations are smooth. Loads by frequency hold for each component.
#include <limits>
#include <span>
#include <vector>

#include "hydro/waves/kinematics/sea.hpp"

namespace hydro::waves {

/// One train, as it is where trains are given.
struct WaveTrain {
  WaveAmplitude amplitude;
  AngularFrequency omega;
  double phase;  ///< φ of cos(ωt + φ), rad
  Angle heading;
  double from_s;  ///< when it begins to come, and the one before to go
  double fade_s;  ///< over which it does, > 0
};

/// What is kept of trains.
struct TrainCut {
  double begin_s, end_s;  ///< the span, on which the sum repeats: still at both ends
  double tolerance;       ///< of the amplitude of each train: higher components that are less together are left out
  double lowest = 0, highest = std::numeric_limits<double>::infinity();  ///< rad/s; none is outside
};

struct TrainComponents {
  std::vector<GivenWave> waves;  ///< phases are those at the place where trains are given
  double left_out;               ///< bound of what the worst train is off, anywhere and ever, over its amplitude
};

/// Train i comes at from_s of its own over fade_s of its own, and goes when the next comes. The last goes at end_s less
/// the longest fade. Cost: O(trains × span × band).
/// \throws InputError for no train, a fade that is not positive, a train that comes before the one before it is whole,
/// or a span that has no room for the last fade
TrainComponents components_of(std::span<const WaveTrain> trains, const TrainCut& cut);

/// Half of the width of the band that components_of() keeps about the frequency of a train with these fades, rad/s.
double half_band(double shortest_fade_s, double tolerance);

}  // namespace hydro::waves
