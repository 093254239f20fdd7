#pragma once
/// \file  Gauss–Legendre quadrature for smooth integrands. Not installed.
#include <array>
#include <cmath>
#include <numbers>

namespace hydro::waves {

/// Points and weights on [−1, 1]: exact for polynomials up to degree 2N − 1.
template <int N>
struct GaussLegendre {
  std::array<double, N> point, weight;

  GaussLegendre() {
    for (int i = 0; i < N; ++i) {
      double x = std::cos(std::numbers::pi * (i + 0.75) / (N + 0.5));  // near the i-th root of P_N
      double slope = 0;
      for (int step = 0; step < 8; ++step) {
        double p = 1, p_before = 0;
        for (int n = 1; n <= N; ++n) {  // n P_n = (2n − 1) x P_{n−1} − (n − 1) P_{n−2}
          const double next = ((2 * n - 1) * x * p - (n - 1) * p_before) / n;
          p_before = p;
          p = next;
        }
        slope = N * (x * p - p_before) / (x * x - 1);  // P_N′
        x -= p / slope;
      }
      point[static_cast<std::size_t>(i)] = x;
      weight[static_cast<std::size_t>(i)] = 2 / ((1 - x * x) * slope * slope);
    }
  }

  template <class F>
  double integrate(const F& f, double from, double to) const {
    const double middle = (from + to) / 2, half = (to - from) / 2;
    double sum = 0;
    for (std::size_t i = 0; i < N; ++i) sum += weight[i] * f(middle + half * point[i]);
    return half * sum;
  }
};

}  // namespace hydro::waves
