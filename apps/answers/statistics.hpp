#pragma once
/// \file  What is told of a series at a glance. Private to apps.
#include <span>

namespace froude {

struct Statistics {
  double mean = 0, deviation = 0, rms = 0;
  double lowest = 0, highest = 0;

  /// Whichever of lowest and highest is farther from 0, as a size.
  double extreme() const;
};

/// Of one value a sample; all 0 where there is none.
Statistics statistics(std::span<const double> values);

}  // namespace froude
