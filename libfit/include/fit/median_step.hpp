#pragma once
/// \file  The step of a record whose times need not be even.
#include <algorithm>
#include <span>
#include <vector>

namespace fit {

/// The middle one of the steps between neighbours, s (the upper one of an even number). Two times at least, which
/// ascend.
inline double median_step(std::span<const double> time) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  std::nth_element(steps.begin(), steps.begin() + std::ssize(steps) / 2, steps.end());
  return steps[steps.size() / 2];
}

}  // namespace fit
