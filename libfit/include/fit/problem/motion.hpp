#pragma once
/// \file  Problem of a motion: parameters of any simulation from a record of what its run should tell; (F41)-(F43),
///        (F46), (F58), docs/theory/fit.md.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fit/parts.hpp"
#include "fit/problem/source.hpp"
#include "fit/report.hpp"
#include "fit/simulated.hpp"

namespace fit::motion {

constexpr int starts_after_failure = 4;

struct Options {
  double confidence = 0.95;
  /// Of the search; they need bounds of every parameter. None: one, and where it is refused `starts_after_failure`
  /// more.
  std::optional<int> starts = {};
  int iterations_reach = 60;
  bool profile = false;           ///< intervals by profile likelihood
  bool accept_residuals = false;  ///< values are told though residuals exceed what the deviations allow (F66)
  /// Nobody gave the simulation's steps: they are divided until their error is small against the intervals (F117).
  bool own_steps = false;
};

struct Parameter {
  SimulationParameter number;
  std::string unit;  ///< that its values are in
  /// Of a parameter of one record alone: the record, and what it is called there. Empty: all records share it.
  std::string record = {}, path = {};
};

struct Signal {
  std::string name, unit;
  double deviation;       ///< of the noise, in that unit
  double period = 0;      ///< as SimulationProblem's
  SlopeError slope = {};  ///< of the line of its channel
};

/// What was measured in one go. Records share parameters; each begins with the start of its own simulation.
struct Record {
  Source source;
  std::vector<double> time;  ///< s, of all samples: for those who look at them
  std::size_t windows = 1;   ///< among the problem's, after those of the records before
  std::string name = {};     ///< where that is not its file's
  std::string title() const { return name.empty() ? source.name() : source.name() + " (" + name + ")"; }
};

struct Problem {
  std::vector<Record> records;
  std::shared_ptr<Simulation> simulation;  ///< follows the signals with trial parameters
  std::vector<Parameter> parameters;
  std::vector<Signal> signals;
  std::vector<Eigen::MatrixXd> measured;                     ///< one a window, shape (samples, signals)
  std::vector<std::vector<Eigen::MatrixXd>> whitening = {};  ///< as SimulationProblem's
  Options options;
};

struct Solution {
  Report report;  ///< refused where the search has no end (F65), residuals contradict what was stated of the noise
                  ///< (F66), or an interval by likelihood has no end
  SimulationFit fit;
  std::string trouble;  ///< what is wrong with the channels, where that explains why values are refused (F77)
};
/// \throws hydro::InputError as fit_simulation() and fit_simulation_from()
Solution solve(const Problem& problem);

/// What the simulation tells with given parameters, against what was measured; nothing is fitted.
struct Prediction {
  /// Of each signal, in all records and in each: rms of the residuals, the deviation stated, and the part of the
  /// measured squares about their mean that is explained, 1 − Σ(x − x̂)²/Σ(x − x̄)², which may be negative. (F104)
  Report report;
  std::vector<Eigen::MatrixXd> motion;  ///< as measured
};
/// `from` says of each parameter where its value is from: "fit.toml". \throws hydro::InputError as follow_all()
Prediction predict(const Problem& problem, const Eigen::VectorXd& at, const std::vector<std::string>& from);

}  // namespace fit::motion
