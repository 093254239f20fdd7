#pragma once
/// \file  Runs in waves on even grids. Private to libfit.
#include "fit/parts.hpp"
#include "fit/prepare.hpp"
#include "fit/problem/wave_run.hpp"
#include "fit/report.hpp"

namespace fit {

/// All channels of a run on one even grid; what was done to them goes to the report.
WaveRecord prepared(const WaveRun& run, const PrepareOptions& options, Report& report);

/// Steps whose band about the waves is one about the frequency of this run's surface. (F108)
PrepareOptions with_band(const WaveRun& run, PrepareOptions options);

/// Of the ratio of response number `response` to the elevation; without errors of responses these are exact.
SlopeError slope_error_of(const SlopeError& elevation, const std::vector<SlopeError>& responses, std::size_t response);

}  // namespace fit
