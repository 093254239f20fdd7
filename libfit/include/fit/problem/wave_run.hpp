#pragma once
/// \file  A run in waves: the surface at a gauge and the channels of what answers to it.
#include <vector>

#include "fit/problem/source.hpp"
#include "fit/regular_waves.hpp"

namespace fit {

struct WaveRun {
  Source source;
  std::vector<double> time, elevation;  ///< s, m
  std::vector<WaveChannel> responses;
};

/// The same on an even grid, outliers bridged.
struct WaveRecord {
  std::vector<double> time, elevation;
  std::vector<std::vector<double>> responses;
};

}  // namespace fit
