#pragma once
/// \file  Single waves in a record, cut at up-crossings of the mean, or of its trend if it drifts, and their
/// statistics; (S11), docs/theory/signal.md.
#include <span>
#include <vector>

namespace hydro::signal {

/// The straight line of least squares through a record.
struct Trend {
  double mean, middle_s, slope;  ///< of the values; of the times; 1/s
  double share;                  ///< of the variance that the line holds

  /// Two waves of one height hold a line of 15 % (S11), so more than a fifth is a drift of the record, no wave.
  bool is_drift() const { return share > 0.2; }
  /// What waves are counted about: the line of a record that drifts, else the mean.
  double level(double t_s) const { return mean + (is_drift() ? slope * (t_s - middle_s) : 0); }
};
/// \throws InputError as single_waves()
Trend trend_of(std::span<const double> time_s, std::span<const double> values);

/// From one up-crossing of the level to the next.
struct SingleWave {
  double start_s;  ///< time of the up-crossing, linearly interpolated: error O(Δt²)
  double period;   ///< s
  double crest;    ///< highest sample above the level, ≥ 0
  double trough;   ///< lowest sample below the level, ≤ 0
  double height() const { return crest - trough; }
};

/// The complete waves of a record, in time order; empty where there are fewer than two up-crossings.
/// Crest and trough are the largest samples: of a sine sampled N times per period a height is low by at most
/// 1 − cos(π/N), which is 1.2 % for N = 20. A sample equal to the level is no crossing by itself. The level is that of
/// trend_of(): about the mean of a record that drifts, most waves would cross nothing.
/// \throws InputError if lengths differ, there are fewer than two samples, time does not increase, or a value is not
/// finite
std::vector<SingleWave> single_waves(std::span<const double> time_s, std::span<const double> values);

/// By what share crests lie higher than the samples beside them, on average: 1 − sin(π/N)/(π/N) for N samples a wave.
/// 0.4 % for N = 20; 0 for fewer than three waves, of which no statement is made. \throws InputError as single_waves()
double missed_of_crests(std::span<const double> time_s, std::span<const double> values);

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
