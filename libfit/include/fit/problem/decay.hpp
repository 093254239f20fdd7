#pragma once
/// \file  Problem of decays: period and damping of a body let go, each record by itself and all together, and what they
///        tell of added mass and of the water's memory; (F34)-(F37), (F54), (F59)-(F61), (F63), docs/theory/fit.md.
#include <optional>
#include <string>
#include <vector>

#include "fit/decay.hpp"
#include "fit/decay_memory.hpp"
#include "fit/diagnose.hpp"
#include "fit/forced_radiation.hpp"
#include "fit/parts.hpp"
#include "fit/prepare.hpp"
#include "fit/problem/source.hpp"
#include "fit/report.hpp"

namespace fit::decay {

struct Options {
  PrepareOptions prepare;
  DecayOptions motion;
  std::optional<DecayMemoryOptions> memory;  ///< where asked for
  bool profile = false;                      ///< intervals of the damping by profile likelihood
  bool sensitivity = false;                  ///< each half of a record is fitted by itself
  bool accept_residuals = false;             ///< values are told though the motion is not explained (F67), (F78)
  bool together = false;                     ///< one set of coefficients for all runs beside those of each (F63)
};

struct Run {
  Source source;
  std::vector<double> time;    ///< s
  std::vector<double> motion;  ///< m, or rad of a turn
};

struct Problem {
  bool turns;  ///< the motion is an angle
  std::vector<Run> runs;
  std::optional<RestoredBody> body;  ///< where it is to tell added mass
  SlopeError motion_slope = {};      ///< of the channel of the motion
  Options options;
};

struct Record {
  std::string name;  ///< of its run
  std::vector<double> time, values;
  std::vector<std::string> steps, cautions;  ///< of its preparation
};

/// A fit of part of a record: what changes, in standard errors of the whole.
struct Variant {
  std::string what;             ///< "the first half of the record"
  std::vector<double> changes;  ///< period, then the terms; empty where it cannot be fitted
  std::string why_not;
};

/// One run, or several fitted together.
struct FittedRun {
  Source source;  ///< of one run; none of several
  std::vector<Record> records;
  Decrement decrement;  ///< of the first record
  DecayFit fit;
  std::optional<ResidualReport> left = {};  ///< in the residuals of one record of 64 samples and more
  std::vector<Variant> variants = {};       ///< where asked for
  std::vector<Interval> profiles = {};      ///< of the terms, where asked for
  /// The largest difference of a coefficient between the halves of one record, over what chance allows (F78); none
  /// where a half tells nothing by itself, of several records, and of a memory.
  std::optional<double> halves = {};
  std::vector<std::string> by_likelihood = {};  ///< coefficients whose interval is that of the likelihood (F76)
  std::optional<AddedMass> water = {};          ///< where the body is known
  std::optional<DecayMemoryFit> memory = {};    ///< where asked for
  std::optional<DecayRadiation> swing = {};     ///< of the memory, at the frequency of the swing
  std::optional<DecayRadiation> limit = {};     ///< at infinite frequency
  std::vector<DecayRadiation> curve = {};       ///< about the swing

  bool alone() const { return records.size() == 1; }
  std::string name() const { return alone() ? source.name() : "together"; }
};

/// Units of what a decay fits: of "period", "quadratic", "memory_strength" …
const char* unit_of(const std::string& coefficient, bool turns);
/// The same with the body's mass in them: of "added_mass", "damping", "quadratic" …
const char* unit_with_mass(const std::string& coefficient, bool turns);

struct Solution {
  /// Refused where a search has no end (F65), a motion is not explained (F67) or halves of a record contradict each
  /// other (F78): then alone.
  Report report;
  std::vector<FittedRun> runs;
  std::optional<FittedRun> together;
};
/// \throws hydro::InputError as fit_decay() and prepare_motion(), with the file of the run
Solution solve(const Problem& problem);

}  // namespace fit::decay
