#pragma once
/// \file  Problem of towing: the drag coefficient of a cylinder towed at steady speeds, from means that are known or
///        from what was recorded; (F12)-(F13), (F66), (F90)-(F93), docs/theory/fit.md.
#include <vector>

#include "fit/box.hpp"
#include "fit/morison.hpp"
#include "fit/parts.hpp"
#include "fit/prepare.hpp"
#include "fit/problem/source.hpp"
#include "fit/report.hpp"
#include "fit/runs.hpp"
#include "fit/steady.hpp"
#include "fit/towing.hpp"

namespace fit::towing {

struct Options {
  double confidence = 0.95;
  bool accept_residuals = false;  ///< a mean is told though runs differ by more than their deviations allow
  SlopeError speed_slope = {};    ///< of the carriage's speed
  SlopeError force_slope = {};    ///< of the force, of means; a record's channels have theirs in a calibration
  // Of records alone:
  PrepareOptions prepare = {};
  double tolerance = 0.02;     ///< of an even speed, relative (F90)
  bool zero_at_rest = false;   ///< the force before the carriage starts is taken off
  CylinderErrors errors = {};  ///< standard uncertainties of diameter, length and density; the mass has no part
};

/// What was recorded of one run.
struct Record {
  Source source;
  RawTow raw;
};

struct Problem {
  Cylinder cylinder;
  std::vector<TowingRun> runs;  ///< means and deviations, or else
  std::vector<Record> records;
  Options options;
};

/// The steady part of one record, and what it tells.
struct RecordedTow {
  PreparedTow prepared;
  Stretch steady;           ///< samples of `prepared`
  SteadyMean speed, force;  ///< there, m/s and N
  SteadyMean samples;       ///< of C_D sample by sample: its deviation is that of the source's tables
  Box box;                  ///< of them
  Coefficient cd;           ///< of the means; `standard_error` counts scatter, zero, hysteresis, and what is the same
                            ///< in all runs, which `systematic_error` is alone
  std::optional<double> re;
};

struct Solution {
  Report report;  ///< refused where runs have no drag coefficient in common (F66): each is told by itself
  TowingFit fit;  ///< of `runs`
  std::vector<RecordedTow> records;  ///< in the order of the problem
  std::optional<RandomEffects> law;  ///< of three records and more: their mean, and what runs differ by
};
/// \throws hydro::InputError as fit_towing(), prepare_towing(), find_tow(), with the file of a record: also for a force
/// that does not settle, or is against the motion's resistance, a window outside the record or without 64 samples, and
/// where the zero is to be taken at rest, for less than a second or 64 samples of it
Solution solve(const Problem& problem);

}  // namespace fit::towing
