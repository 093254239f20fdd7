#pragma once
/// \file  Problem of irregular waves: transfer functions from the surface to motions and forces, of all runs together;
///        (S5)-(S10), (S21), docs/theory/signal.md, and (F105), (F107), docs/theory/fit.md.
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "fit/parts.hpp"
#include "fit/prepare.hpp"
#include "fit/problem/wave_run.hpp"
#include "fit/report.hpp"
#include "hydro/signal/welch.hpp"

namespace fit::irregular_waves {

struct Options {
  double confidence = 0.95;
  std::optional<double> segment_s = {};  ///< none: eight side by side in the shortest run, fifteen with half overlap
  std::optional<WaveTank> tank = {};     ///< phases are those against the wave at its body; none: at the gauge
  PrepareOptions prepare = {};           ///< of surface and responses alike; a window of kind span
};

struct Problem {
  std::vector<WaveRun> runs;       ///< the same responses in all, of one sampling rate
  std::vector<std::string> units;  ///< SI, of the responses: "m", "rad", "N"
  Options options;
  SlopeError elevation_slope = {};
  std::vector<SlopeError> response_slopes = {};  ///< one a response; empty: exact
};

/// What one channel does for each metre of the waves, along frequency.
struct Response {
  std::string name;
  hydro::signal::TransferEstimate transfer;  ///< phases before the wave at the body, where there is a tank
  /// By how much |H₁| would move if segments were endlessly long, along frequency; empty: they are too short to tell
  std::vector<double> resolution;
  std::vector<double> half_width;  ///< of the intervals of |H₁| without that; NaN where no value is told
  /// |H₁|, with that in its interval (F118); without a value where the two may be unrelated, or filters leave less than
  /// half of both
  std::vector<Coefficient> gain;
};

struct Solution {
  Report report;
  std::vector<WaveRecord> records;
  hydro::signal::SpectrumPerHz waves;  ///< of the segments of all runs
  std::size_t segments, segment_samples;
  std::vector<Response> responses;
};
/// \throws hydro::InputError as prepare_motion() and transfer(), with the file, for runs of different rates, for a
/// segment that is longer than a run, and for a problem without runs
Solution solve(const Problem& problem);

}  // namespace fit::irregular_waves
