#pragma once
/// \file  Private: harmonics of a period at one angle.
#include <Eigen/Core>

#include <cmath>

namespace dynamics::frequency {

/// 1, cos θ, sin θ, cos 2θ, …, (2H + 1), each from the one before: rounding grows as H.
inline Eigen::VectorXd harmonics_at(Eigen::Index H, double theta) {
  Eigen::VectorXd out(2 * H + 1);
  const double c = std::cos(theta), s = std::sin(theta);
  double x = 1, y = 0;
  out[0] = 1;
  for (Eigen::Index h = 1; h <= H; ++h) {
    const double turned = x * c - y * s;
    y = x * s + y * c;
    x = turned;
    out.segment<2>(2 * h - 1) << x, y;
  }
  return out;
}

}  // namespace dynamics::frequency
