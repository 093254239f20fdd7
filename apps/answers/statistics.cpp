#include "answers/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace froude {

double Statistics::extreme() const { return std::max(std::abs(lowest), std::abs(highest)); }

Statistics statistics(std::span<const double> values) {
  if (values.empty()) return {};
  const auto count = static_cast<double>(values.size());
  Statistics s{.lowest = values.front(), .highest = values.front()};
  double squares = 0, about_mean = 0;
  for (const double x : values) {
    s.mean += x / count;
    squares += x * x;
    s.lowest = std::min(s.lowest, x);
    s.highest = std::max(s.highest, x);
  }
  for (const double x : values) about_mean += (x - s.mean) * (x - s.mean);
  s.deviation = std::sqrt(about_mean / count);
  s.rms = std::sqrt(squares / count);
  return s;
}

}  // namespace froude
