#pragma once
/// \file  A scene run in time, kept in memory: what `froude run` writes and what validation compares.
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "compile/control.hpp"
#include "compile/restart.hpp"
#include "froude/result_file.hpp"
#include "scene/scene.hpp"

namespace froude {

/// Slack and snaps of a line over a run.
struct Snaps {
  std::string line;
  double slack_share;  ///< of the time, in which a link is slack
  int snaps;
  double largest_tension, at;  ///< N; s
  int link;                    ///< counted from 1
};

/// The largest Lyapunov exponent of a line over a run.
struct LineExponent {
  std::string line;
  dynamics::Exponent exponent;
};

/// What a run leaves behind, whole or up to where it stopped.
struct Record {
  std::vector<double> time;     ///< s
  std::vector<Signal> signals;  ///< those that the scene asks for
  double step = 0;              ///< s
  std::size_t steps = 0;        ///< completed
  std::size_t parts = 0;        ///< into which a tolerance has cut them
  int newton_iterations = 0, halvings = 0, events = 0;
  double preparation_s = 0, stepping_s = 0;                      ///< wall time
  std::vector<std::pair<std::string, std::size_t>> evaluations;  ///< of the load, by effect
  std::vector<std::pair<std::string, double>> energy;            ///< J, by effect, at the end; residual and turnover
  struct Unexplained {
    double energy = 0, time = 0;  ///< J, s
  };
  Unexplained worst_residual;           ///< the energy residual when it was largest
  std::vector<Snaps> snaps;             ///< of lines whose scene asks for them
  std::vector<LineExponent> exponents;  ///< likewise
  std::vector<std::string> notes;
  std::string stopped;  ///< why it ended before its time; empty if it did not

  /// \throws hydro::InputError if there is no such signal
  const std::vector<double>& signal(const std::string& name) const;
};

/// Runs a model that is compiled already, from its start and for its steps; the start may be later than 0. `end`, if it
/// is not null, is told the last state. \throws hydro::InputError at a signal that there is not
Record run_model(const scene::Scene& scene, const compile::TimeModel& model,
                 const std::function<void(double)>& done = {}, compile::MovingState* end = nullptr);

/// Compiles and runs a scene that asks for a run. `done` is told the share of the steps completed; `controls` rule
/// connectors.
/// \throws hydro::InputError; numerics that give up end the record early with a reason instead
Record simulate(const scene::Scene& scene, const std::function<void(double)>& done = {},
                const std::vector<compile::Control>& controls = {});

}  // namespace froude
