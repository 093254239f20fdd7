#pragma once
/// \file  Problem of forced radiation: added mass and damping from forced oscillations, and of five frequencies and
/// more
///        the poles of the memory that belongs to them; (F55), (F56), docs/theory/fit.md.
#include <optional>
#include <vector>

#include "fit/forced_radiation.hpp"
#include "fit/parts.hpp"
#include "fit/problem/source.hpp"
#include "fit/report.hpp"

namespace fit::radiation {

struct Options {
  double confidence = 0.95;
};

struct Run {
  Source source;
  std::vector<double> time;    ///< s
  std::vector<double> motion;  ///< m, or rad of a turn
  std::vector<double> force;   ///< N, or N m of a turn: what the load cells carry
};

struct Problem {
  bool turns;  ///< the motion is an angle
  std::vector<Run> runs;
  RestoredBody body;
  Options options;
  SlopeError motion_slope = {}, force_slope = {};  ///< of the lines of their channels
};

/// Units of what is told, of a translation or a turn.
struct Units {
  const char *motion, *force, *added_mass, *damping;
};
Units units_of(bool turns);

struct Point {
  Source source;
  RadiationPoint point;
};
struct Solution {
  Report report;                          ///< refused where damping is negative (F79): then alone
  std::vector<Point> points;              ///< in the order of their frequencies
  std::optional<RadiationMemory> memory;  ///< of five points and more
};
/// \throws hydro::InputError as fit_radiation(), with the file of the run, and as fit_radiation_memory()
Solution solve(const Problem& problem);

}  // namespace fit::radiation
