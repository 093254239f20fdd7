#pragma once
/// \file  Gauss's rule of twenty points on [−1, 1]. Not installed.
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace hydro::panels {

struct GaussPoint {
  double at, weight;
};

/// Roots of Legendre's P₂₀ by Newton's method, weights 2/((1 − x²)P′²).
inline std::array<GaussPoint, 20> gauss_rule() {
  constexpr int n = 20;
  std::array<GaussPoint, n> rule;
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 0;
    for (int step = 0; step < 6; ++step) {
      double before = 1, P = x;
      for (int k = 1; k < n; ++k) {
        const double next = ((2 * k + 1) * x * P - k * before) / (k + 1);
        before = P;
        P = next;
      }
      slope = n * (before - x * P) / (1 - x * x);
      x -= P / slope;
    }
    rule[static_cast<std::size_t>(i)] = {x, 2 / ((1 - x * x) * slope * slope)};
  }
  return rule;
}
inline const std::array<GaussPoint, 20> gauss_points = gauss_rule();

}  // namespace hydro::panels
