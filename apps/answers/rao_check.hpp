#pragma once
/// \file  Responses held against runs in time: for `froude rao --check time`. Private to apps.
#include <complex>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "froude/result.hpp"
#include "scene/scene.hpp"

namespace froude {

/// One signal in one regular wave.
struct CheckedCell {
  std::string signal, units;
  double omega, heading, height;     ///< rad/s, rad, m
  std::complex<double> linear, run;  ///< per metre of amplitude, of the same phase convention
  double peak;       ///< of the linear response in this heading; at least a thousandth of the largest of its unit
  double unsettled;  ///< by how much `run` still changes from one half of what is looked at to the other
  double rest;       ///< rms of what the run has beside this frequency, per metre of amplitude

  /// |run − linear| over the peak: the terms that a linear answer ignores, at this height, and the errors of the run.
  double difference() const { return peak > 0 ? std::abs(run - linear) / peak : 0; }
};

/// Runs the scene in a regular wave of the first heading at each of three frequencies of `linear`, a quarter, half and
/// three quarters of the way, of a height of `steepness` times its length; left out: as [ask.rao.drag] has it, or
/// 0.002. Waves grow over ten periods; of the last forty of eighty the amplitudes are taken, of each signal but those
/// that the wave alone tells. `done` is told the share of the runs completed. \throws hydro::InputError where the scene
/// cannot run, hydro::NumericsError where a run stops
std::vector<CheckedCell> check_in_time(const scene::Scene& scene, const Responses& linear,
                                       std::optional<double> steepness = {},
                                       const std::function<void(double)>& done = {});

}  // namespace froude
