#pragma once
/// \file  Problem of a static pull: the stiffness of a mooring, a spring or afloat, from loads that were held and where
///        they brought the body; (F80), docs/theory/fit.md.
#include <Eigen/Core>

#include <vector>

#include "fit/parts.hpp"
#include "fit/problem/source.hpp"
#include "fit/report.hpp"

namespace fit::restoring {

struct Options {
  double confidence = 0.95;
  bool cubic = false;  ///< a term with the cube of the motion is fitted as well
};

/// Points of one test, in any order: the load that holds the body where it is, positive along the motion.
struct Run {
  Source source;
  std::vector<double> motion;  ///< m or rad
  std::vector<double> load;    ///< N or N m
};

struct Problem {
  bool turns;  ///< the motion is an angle, the load a moment
  std::vector<Run> runs;
  Options options;
  SlopeError motion_slope = {}, load_slope = {};  ///< of the lines of their channels
};

struct Solution {
  Report report;
  Eigen::VectorXd preload;              ///< of each run, N or N m
  double stiffness = 0, cubic = 0;      ///< best values, also of what is not told
  std::vector<Eigen::VectorXd> fitted;  ///< load of each run at its points
};
/// load = preload + stiffness · motion + cubic · motion³ by least squares over all runs, a preload for each: the zero
/// of a load cell wanders. Errors of single points are taken as independent and alike. (F80) \throws hydro::InputError
/// with the file for lengths that differ and values that are not finite, and where there are not more points, at enough
/// different places, than coefficients
Solution solve(const Problem& problem);

}  // namespace fit::restoring
