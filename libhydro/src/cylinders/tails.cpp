#include "tails.hpp"

#include <Eigen/LU>

#include <cmath>

namespace hydro::cylinders {
namespace {

/// Σ_{n>N} (n/N)^{−s}, by Euler and Maclaurin; N of some tens gives rounding.
double relative_zeta_tail(double s, double N) {
  const double q = N + 1, first = std::pow(q / N, -s);
  return first * (q / (s - 1) + 0.5 + s / (12 * q) - s * (s + 1) * (s + 2) / (720 * q * q * q));
}

}  // namespace

std::array<double, 4> SmoothTail::points(int last) {
  const double N = last;
  return {N, 1.5 * N, 2.5 * N, 5 * N};
}

SmoothTail::SmoothTail(int last, double decay) {
  const double N = last;
  const auto at = points(last);
  Eigen::Matrix4d powers;
  Eigen::Vector4d sums;
  for (int c = 0; c < 4; ++c) {
    for (int i = 0; i < 4; ++i) powers(c, i) = std::pow(at[static_cast<std::size_t>(i)] / N, -decay - c);
    sums(c) = relative_zeta_tail(decay + c, N);
  }
  const Eigen::Vector4d w = powers.partialPivLu().solve(sums);
  for (int i = 0; i < 4; ++i) weight[static_cast<std::size_t>(i)] = w(i);
}

std::complex<double> oscillating_tail(int last, double theta, const std::array<std::complex<double>, 3>& F) {
  const std::complex<double> z = std::polar(1.0, theta), r = 1.0 / (1.0 - z);
  const std::complex<double> first = F[1] - F[0], second = F[2] - 2.0 * F[1] + F[0];
  return std::polar(1.0, theta * (last + 1)) * r * (F[0] + z * r * (first + z * r * second));
}

}  // namespace hydro::cylinders
