#pragma once
/// \file  What fits of runs in waves have alike, regular and irregular ones. Private to apps.
#include <string>
#include <vector>

#include "answers/fit_measurements.hpp"
#include "fit/problem/wave_run.hpp"
#include "hydro/base/error.hpp"

namespace froude::scene {

/// [model.tank] without its end: in fit_regular_waves.cpp.
Binding<::fit::WaveTank> wave_tank();
/// The columns of [data.channels] response: in fit_regular_waves.cpp. \throws hydro::InputError for none, or one twice
std::vector<std::string> responses_of(const FitTables& tables);

/// Steps of [prepare] that act on surface and responses alike.
inline const std::vector<std::string> steps_of_waves{"longest_gap", "outliers",       "resample",  "detrend", "notch",
                                                     "low_pass",    "moving_average", "band_pass", "window"};

/// Runs, units and errors of slopes of a problem of waves. \throws hydro::InputError where units differ between files
template <class Problem>
void read_wave_runs(const FitScene& scene, const std::vector<std::string>& responses, Problem& out) {
  for (const auto& [source, row] : runs_of(scene)) {
    const Measurements measured(scene, source.file);
    ::fit::WaveRun run{source, measured.time(), measured.of_role("elevation", hydro::dim::length), {}};
    std::vector<std::string> units;
    for (const std::string& column : responses) {
      run.responses.push_back({column, measured.column(column)});
      units.push_back(measured.unit(column));
    }
    if (!out.units.empty() && out.units != units)
      throw hydro::InputError("the responses have other units than in the first file", {.file = source.file.string()},
                              "write the same kind of quantity in all files");
    out.units = std::move(units);
    out.runs.push_back(std::move(run));
  }
  out.elevation_slope = slope_error_of(scene, {"elevation"});
  for (const std::string& column : responses) out.response_slopes.push_back(slope_error(scene, column));
}

}  // namespace froude::scene
