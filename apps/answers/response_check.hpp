#pragma once
/// \file  Responses in a sea held against runs in time: for `froude response --check`.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "answers/response_spectra.hpp"
#include "compile/kept.hpp"
#include "scene/scene.hpp"

namespace froude {

/// What several runs come to: the mean of a number, and the standard error of that mean.
struct OfRuns {
  double mean, error;
};

/// One signal in runs of the sea with other random phases; about the mean of each run, in the signal's unit and s.
struct CheckedStatistics {
  std::string signal, units;
  OfRuns mean, deviation, tz, largest;
};

/// Runs the scene in its sea with `runs` seeds, the scene's own and those that follow it, each for `duration` seconds
/// after forty peak periods in which waves grow and motions settle, on `threads` threads: the numbers are the same for
/// any number of them. Of the signals of `linear` that respond, with all that the scene has: quadratic drag, loads of
/// second order, springs, friction, contact. `done` is told the share of the runs completed, from any thread.
/// \throws hydro::InputError where the scene cannot run, hydro::NumericsError where a run stops or a signal swings less
/// than three times
std::vector<CheckedStatistics> check_by_runs(const scene::Scene& scene, const ResponseSpectra& linear, double duration,
                                             int runs, int threads, const std::shared_ptr<compile::Kept>& kept,
                                             const std::function<void(double)>& done = {});

}  // namespace froude
