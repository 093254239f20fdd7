#pragma once
/// \file  Problem of towing: the drag coefficient of a cylinder towed at steady speeds; (F12)-(F13), (F66),
///        docs/theory/fit.md.
#include <vector>

#include "fit/report.hpp"
#include "fit/towing.hpp"

namespace fit::towing {

struct Options {
  double confidence = 0.95;
  bool accept_residuals = false;  ///< a mean is told though runs differ by more than their deviations allow
};

struct Problem {
  Cylinder cylinder;
  std::vector<TowingRun> runs;
  Options options;
};

struct Solution {
  Report report;  ///< refused where runs have no drag coefficient in common (F66): each is told by itself
  TowingFit fit;
};
/// \throws hydro::InputError as fit_towing()
Solution solve(const Problem& problem);

}  // namespace fit::towing
