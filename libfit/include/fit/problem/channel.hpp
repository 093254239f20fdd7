#pragma once
/// \file  Problem of a calibration: the line of a channel from readings at known references, one series or several;
///        (F100), docs/theory/fit.md.
#include <string>
#include <vector>

#include "fit/channel_line.hpp"
#include "fit/problem/source.hpp"
#include "fit/report.hpp"

namespace fit::channel {

struct Options {
  double confidence = 0.95;
};

/// One series of points: before a campaign, or after it.
struct Run {
  Source source;
  LinePoints points;
};

struct Problem {
  std::string reading_unit, reference_unit;  ///< SI: "V", "m"
  std::vector<Run> runs;
  Options options;
};

struct Solution {
  Report report;
  std::vector<ChannelLine> lines;  ///< of each series
};
/// Each series by itself, and where there are several what their lines differ by. \throws hydro::InputError as
/// fit_channel_line(), with the file, and for a problem without series
Solution solve(const Problem& problem);

}  // namespace fit::channel
