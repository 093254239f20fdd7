#pragma once
/// \file  What remains of a slowly convergent sum beyond its last term, when the form of the terms is known. Not
/// installed.
#include <array>
#include <complex>

namespace hydro::cylinders {

/// Σ_{n>N} f(n) for f(n) = n^{−s}(c₀ + c₁/n + …), from f at four points beyond N: the sum is Σ weight·f(point) (C8).
struct SmoothTail {
  SmoothTail(int last, double decay);
  static std::array<double, 4> points(int last);  ///< real numbers >= last
  std::array<double, 4> weight;
};

/// Σ_{n>N} F(n) e^{iθn} from F at N+1, N+2, N+3, by summation by parts (C8). Needs |1 − e^{iθ}| N ≫ 1.
std::complex<double> oscillating_tail(int last, double theta, const std::array<std::complex<double>, 3>& F);

}  // namespace hydro::cylinders
