#include "dynamics/time/ramp.hpp"

#include <cmath>
#include <numbers>

namespace dynamics {

Ramp ramp(double t, double over) {
  if (t >= over) return {1, 0, 0};
  if (t <= 0) return {0, 0, 0};
  const double angle = std::numbers::pi * t / over, w = std::numbers::pi / over;
  return {0.5 * (1 - std::cos(angle)), 0.5 * w * std::sin(angle), 0.5 * w * w * std::cos(angle)};
}

}  // namespace dynamics
