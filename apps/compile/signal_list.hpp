#pragma once
/// \file  The one list of a scene's signals, which runs, responses and whatever else reads numbers take: motions of
/// bodies' origins, what forces, joints and lines tell, waves, energies.
#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compile/compile.hpp"
#include "dynamics/integrate/ledger.hpp"
#include "dynamics/state/signal.hpp"

namespace froude::compile {

/// What signals are read off: one instant of a run.
struct Moment {
  const dynamics::Model& model;
  const dynamics::Workspace& workspace;
  const dynamics::EnergyLedger& ledger;
  const std::vector<std::unique_ptr<LineRun>>& lines;
};

/// A signal of a scene, in a run and per metre of wave amplitude.
struct Signal {
  std::string name, unit, meaning;
  std::function<double(const Moment&)> value;  ///< empty where there is no run
  std::function<dynamics::Variation(const dynamics::Still&)> variation = {};
  std::string no_variation = {};  ///< why it has no response, where it has none
};

/// Of a run; for as long as the model stays where it is. Motions are of the body's origin from its place at rest;
/// rotations are the yaw–pitch–roll angles of the attitude (about z, then the new y, then the new x).
std::vector<Signal> signal_list(const scene::Scene& scene, const TimeModel& model);
/// Of small motions of `model`, which frequency_model() made: the same signals, of which some have no response.
std::vector<Signal> signal_list(const scene::Scene& scene, const Prepared& prepared, const dynamics::Model& model);

/// True if one of the patterns matches, or there are none.
inline bool is_chosen(const std::string& name, const std::vector<std::string>& patterns) {
  return patterns.empty() || std::any_of(patterns.begin(), patterns.end(),
                                         [&](const auto& pattern) { return scene::matches(pattern, name); });
}

/// Those whose names match one of the patterns (`*` stands for anything); all if there are no patterns. Keeps their
/// order. \throws hydro::InputError at a pattern that matches none of them, with the nearest name
std::vector<Signal> chosen(const std::vector<Signal>& all, const std::vector<std::string>& patterns,
                           const std::vector<scene::Place>& places);

/// The same, of those that have a response; `notes` are told which that are asked for have none, and why.
/// \throws hydro::InputError at a pattern that matches none that has one
std::vector<Signal> chosen_responses(const std::vector<Signal>& all, const std::vector<std::string>& patterns,
                                     const std::vector<scene::Place>& places, std::vector<std::string>& notes);

/// What one [[probe]] of a scene tells: names, units, and how each is read off the water's kinematics.
struct ProbeSignal {
  std::string name, unit, long_name;
  std::function<double(const hydro::waves::Kinematics&)> take;
  bool of_surface = false;  ///< whatever the height of the point
};
std::vector<ProbeSignal> probe_signals(const scene::Probe& probe);

}  // namespace froude::compile
