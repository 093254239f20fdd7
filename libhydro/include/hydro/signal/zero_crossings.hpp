#pragma once
/// \file  Single waves in a record, cut at up-crossings of the mean, and their statistics; (S11),
/// docs/theory/signal.md.
#include <span>
#include <vector>

namespace hydro::signal {

/// From one up-crossing of the mean to the next.
struct SingleWave {
  double start_s;  ///< time of the up-crossing, linearly interpolated: error O(Δt²)
  double period;   ///< s
  double crest;    ///< highest sample above the mean, ≥ 0
  double trough;   ///< lowest sample below the mean, ≤ 0
  double height() const { return crest - trough; }
};

/// The complete waves of a record, in time order; empty where there are fewer than two up-crossings.
/// Crest and trough are the largest samples: of a sine sampled N times per period a height is low by at most
/// 1 − cos(π/N), which is 1.2 % for N = 20. A sample equal to the mean is no crossing by itself.
/// \throws InputError if lengths differ, there are fewer than two samples, time does not increase, or a value is not
/// finite
std::vector<SingleWave> single_waves(std::span<const double> time_s, std::span<const double> values);

struct WaveStatistics {
  std::size_t count;  ///< complete waves
  double mean_height;
  double h13;  ///< mean height of the highest third (count/3 waves, rounded down)
  double highest;
  double mean_period;  ///< Tz, s
  double t13;          ///< mean period of the highest third, s
};
/// \throws InputError for fewer than three waves: they have no highest third
WaveStatistics wave_statistics(std::span<const SingleWave> waves);

}  // namespace hydro::signal
