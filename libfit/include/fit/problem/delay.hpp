#pragma once
/// \file  Problem of a delay: how late one channel is behind another, of one record or of two whose clocks differ;
///        (F106), docs/theory/fit.md.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/offset.hpp"
#include "fit/problem/source.hpp"
#include "fit/report.hpp"
#include "fit/runs.hpp"

namespace fit::delay {

struct Options {
  OffsetOptions search = {};
  bool one_source = false;  ///< they are known to have something in common: chance is not asked
  std::string unit = {};    ///< of the first channel; "": a number, or not known
  std::optional<std::pair<double, double>> window = {};  ///< s: of the first channel; the second is taken whole
};

struct Run {
  Source source;
  std::vector<double> time, first;          ///< s, and whatever it measures
  std::vector<double> second_time, second;  ///< on its own clock, which may be the same
};

struct Problem {
  std::vector<Run> runs;
  Options options;
};

/// What was compared, and how late the second is.
struct FittedRun {
  std::vector<double> time, first;  ///< within the window
  Offset offset;
};

struct Solution {
  Report report;
  std::vector<FittedRun> runs;
  std::optional<RandomEffects> together;  ///< of three runs and more: the delay of all
};
/// The delay is that of the second behind the first: positive where it comes later. \throws hydro::InputError as
/// offset_between(), with the file, where the two are no more alike than records without anything in common are by
/// chance in one case of a hundred (unless `one_source`), and for a problem without runs
Solution solve(const Problem& problem);

}  // namespace fit::delay
