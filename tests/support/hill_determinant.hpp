#pragma once
/// \file  Where the motions of a damped Mathieu equation begin to grow, by Hill's determinants: a plain reference.
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>

namespace support {

/// q̈ + 2c q̇ + (δ + ε cos t) q = 0.
struct Mathieu {
  double delta, epsilon, c;
};

/// Hill's determinant of q = Σ q_n e^{i s_n t}, s_n = n or, `doubled`, n + ½, rows over s² + 1: real, since rows of ±s
/// are conjugate. Its zeros are where a multiplier is +1 or −1. Rows from 24 up are left out: in a product that
/// converges they change its factors by ε²/(4 s⁴), 1e-5 and less, and its zeros, which stand in the middle rows, by far
/// less than 1e-9.
inline double hill_determinant(const Mathieu& m, bool doubled) {
  constexpr int most = 24;
  std::complex<double> before = 1, now = 1;
  double scale_before = 1;
  const int least = doubled ? -most - 1 : -most;
  for (int n = least; n <= most; ++n) {  // by the three-term recursion of tridiagonal determinants
    const double s = n + (doubled ? 0.5 : 0), scale = s * s + 1;
    const std::complex<double> diagonal = std::complex(m.delta - s * s, 2 * m.c * s) / scale;
    const double off = n == least ? 0 : m.epsilon * m.epsilon / 4 / (scale * scale_before);
    const std::complex<double> next = diagonal * now - off * before;
    before = now;
    now = next;
    scale_before = scale;
  }
  return now.real();
}

/// The least ε in 0 … 4 at which a function of it changes its sign; +∞ where none does.
template <class F>
double first_zero(F f) {
  constexpr double step = 0.01;
  for (double at = step; at < 4; at += step) {
    if (f(at) * f(at + step) > 0) continue;
    std::uintmax_t most = 100;
    const auto [low, high] =
        boost::math::tools::toms748_solve(f, at, at + step, boost::math::tools::eps_tolerance<double>(45), most);
    return (low + high) / 2;
  }
  return std::numeric_limits<double>::infinity();
}

/// The least ε at which motions grow.
inline double hill_boundary(double delta, double c) {
  const auto zero = [&](bool doubled) {
    return first_zero([&](double epsilon) { return hill_determinant({delta, epsilon, c}, doubled); });
  };
  return std::min(zero(false), zero(true));
}

}  // namespace support
