#pragma once
/// \file  What remains of a slowly convergent sum beyond its last term, when the form of the terms is known. Not
/// installed.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace hydro::cylinders {

/// Of a sum over the depth; 100 MB at 48 gap functions. Beyond, a scene has a radius, draught or wave thousands of
/// times shorter than the water is deep.
inline constexpr int most_terms = 300'000;

/// The whole number of terms that reaches `reach` and a few beyond; more than most_terms for any reach beyond that, so
/// that no number is too large for an int.
inline int count_of_terms(double reach) { return static_cast<int>(std::ceil(std::min(reach, 2.0 * most_terms))) + 4; }

/// Σ_{n>N} f(n) for f(n) = n^{−s}(c₀ + c₁/n + …), from f at four points beyond N: the sum is Σ weight·f(point) (C8).
struct SmoothTail {
  SmoothTail(int last, double decay);
  static std::array<double, 4> points(int last);  ///< real numbers >= last
  std::array<double, 4> weight;
};

/// Σ_{n>N} F(n) e^{iθn} from F at N+1, N+2, N+3, by summation by parts (C8). Needs |1 − e^{iθ}| N ≫ 1.
std::complex<double> oscillating_tail(int last, double theta, const std::array<std::complex<double>, 3>& F);

}  // namespace hydro::cylinders
