#pragma once
/// \file  Problem of a friction ramp: static and dynamic friction of a joint from tests whose load grows until it
///        slips; (F52), docs/theory/fit.md.
#include <vector>

#include "fit/friction_ramp.hpp"
#include "fit/parts.hpp"
#include "fit/problem/source.hpp"
#include "fit/report.hpp"

namespace fit::friction {

using Options = FrictionRampOptions;

struct Run {
  Source source;
  std::vector<double> time;  ///< s
  std::vector<double> load;  ///< N m of a hinge, N of a slider
};

struct Problem {
  bool slides;  ///< a slider, whose load is a force; else a hinge, whose load is a torque
  std::vector<Run> runs;
  Options options;
  SlopeError load_slope = {};  ///< of the line of the load's channel
};
const char* unit_of_load(const Problem& problem);  ///< "N", "N m"

struct Solution {
  Report report;
  std::vector<FrictionRamp> fits;  ///< in the order of the runs
};
/// Each test by itself, and of three and more each level of all together, which may differ by more than their own
/// errors. \throws hydro::InputError as fit_friction_ramp(), with the file of the run
Solution solve(const Problem& problem);

}  // namespace fit::friction
