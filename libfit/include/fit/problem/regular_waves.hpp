#pragma once
/// \file  Problem of regular waves: response amplitudes, force amplitudes and harmonics of runs in a tank, and what
///        repeated runs differ by; (F94)-(F97), docs/theory/fit.md.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/parts.hpp"
#include "fit/prepare.hpp"
#include "fit/problem/wave_run.hpp"
#include "fit/regular_waves.hpp"
#include "fit/report.hpp"

namespace fit::regular_waves {

struct Options : RegularWaveOptions {
  PrepareOptions prepare =
      {};  ///< of surface and responses alike; a window of kind span in place of the times of the tank
};

struct Problem {
  std::vector<WaveRun> runs;       ///< the same responses in all
  std::vector<std::string> units;  ///< SI, of the responses: "m", "rad", "N"
  Options options;
  SlopeError elevation_slope = {};
  std::vector<SlopeError> response_slopes = {};  ///< one a response; empty: exact
};

/// What was fitted to one run, and the record that it was fitted to.
struct FittedRun : WaveRecord {
  RegularWaveFit fit;
};

/// Runs of one period and one height, and one response in them; (F97).
struct Repeats {
  std::string name;
  double period, wave_amplitude;  ///< means
  std::vector<std::size_t> runs;
  double mean, deviation;  ///< of the RAO over runs
  Interval interval;       ///< of the mean, Student with one less than there are runs, and of the slopes of channels
  double lower_quartile, median, upper_quartile;
};

struct Solution {
  Report report;
  std::vector<FittedRun> runs;
  std::vector<Repeats> repeats;  ///< of two runs and more
};
/// \throws hydro::InputError as fit_regular_waves() and prepare_motion(), with the file, and for a problem without runs
Solution solve(const Problem& problem);

}  // namespace fit::regular_waves
