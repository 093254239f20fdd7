#pragma once
/// \file  Problem of Morison's equation: drag and inertia of a cylinder from raw records of force and motion, run by
/// run,
///        and their law over all runs; (F7)-(F11), (F23)-(F33), docs/theory/fit.md.
#include <optional>
#include <string>
#include <vector>

#include "fit/diagnose.hpp"
#include "fit/morison.hpp"
#include "fit/prepare.hpp"
#include "fit/problem/source.hpp"
#include "fit/report.hpp"
#include "fit/runs.hpp"

namespace fit::morison {

/// Coefficients of all runs against KC, Re or β: one law, or all that the runs can tell.
struct RunLaw {
  std::optional<Law> only;
};

struct Options {
  PrepareOptions prepare;
  std::optional<double> longest_delay;    ///< s; the delay is to be estimated, within this
  MorisonOptions force;                   ///< but for the errors of the force, which each run has of its own
  std::vector<std::string> coefficients;  ///< to tell: among "cd", "cm", "ca"
  std::optional<RunLaw> law;
  bool cycles = false;       ///< each cycle of the window is fitted by itself
  bool sensitivity = false;  ///< the fit is repeated with other cutoffs, and over half of the window
};

struct Run {
  Source source;
  Cylinder cylinder;
  RawRun raw;
  std::optional<double> delay_s = {};  ///< of its force behind its motion, in place of that of the options
};

struct Problem {
  std::vector<Run> runs;
  Options options;
};

/// A fit repeated with one choice made otherwise.
struct Variant {
  std::string what;    ///< "low pass at 2.33 Hz"
  double cd, inertia;  ///< changes
};

struct FittedRun {
  Source source;
  Cylinder cylinder;
  Prepared prepared;  ///< what was fitted, and the steps that led there
  MorisonFit fit;
  ResidualReport left;  ///< in the residuals
  FourierAverages fourier;
  std::vector<CycleFit> cycles;    ///< where asked for
  std::vector<Variant> variants;   ///< where asked for
  std::vector<Coefficient> asked;  ///< in the order of the options
};

/// The law of one coefficient over all runs.
struct CoefficientLaw {
  std::string coefficient;          ///< "cd", "ca", "cm"
  std::vector<RandomEffects> laws;  ///< the one asked for, or all, best first
  std::size_t runs, left_out;       ///< fitted; not identifiable
};

struct Solution {
  Report report;  ///< refused where force and motion have contrary signs (F26): then alone
  std::vector<FittedRun> runs;
  std::vector<CoefficientLaw> laws;  ///< where asked for, one a coefficient
};
/// \throws hydro::InputError as prepare() and fit_morison(), with the file of the run, and as fit_runs()
Solution solve(const Problem& problem);

}  // namespace fit::morison
