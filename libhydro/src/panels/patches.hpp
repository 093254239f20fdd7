#pragma once
/// \file  A function of two variables kept as polynomials on rectangles. (G6) in docs/theory/panels.md. Not installed.
#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "hydro/base/dense.hpp"

namespace hydro::panels {

/// Nodes along one side of a rectangle; polynomials are of degree nodes − 1.
constexpr int patch_nodes = 10;

/// Chebyshev's points of [−1, 1].
inline double patch_node(int i) { return -std::cos(std::numbers::pi * (2 * i + 1) / (2 * patch_nodes)); }

/// Coefficients of powers from values at the nodes: the inverse of Vandermonde's matrix, whose condition is 3e3.
inline Eigen::MatrixXd powers_from_nodes() {
  Eigen::MatrixXd V(patch_nodes, patch_nodes);
  for (int i = 0; i < patch_nodes; ++i)
    for (int n = 0; n < patch_nodes; ++n) V(i, n) = std::pow(patch_node(i), n);
  return dense::inverse(V);
}

/// Horner's scheme in v for all powers of u, of two and of three functions: rows of `at` are as long as `in_u`.
void sum_rows(const double* at, double v, std::array<double, 2 * patch_nodes>& in_u);
void sum_rows(const double* at, double v, std::array<double, 3 * patch_nodes>& in_u);

/// C functions on one rectangle.
template <int C>
class Patch {
 public:
  /// values[c](i, j) at node i of the first variable and j of the second.
  explicit Patch(const std::array<Eigen::MatrixXd, C>& values) {
    static const Eigen::MatrixXd powers = powers_from_nodes();
    for (int c = 0; c < C; ++c) {
      const Eigen::MatrixXd a = powers * values[static_cast<std::size_t>(c)] * powers.transpose();
      for (int j = 0; j < patch_nodes; ++j)
        for (int i = 0; i < patch_nodes; ++i) at_[static_cast<std::size_t>((j * patch_nodes + i) * C + c)] = a(i, j);
    }
  }
  /// At (u, v) in [−1, 1]², by Horner's scheme: first in v for all powers of u at once.
  std::array<double, C> operator()(double u, double v) const {
    std::array<double, static_cast<std::size_t>(patch_nodes * C)> in_u;
    sum_rows(at_.data(), v, in_u);
    // Even and odd powers of u apart, which do not wait for each other.
    static_assert(patch_nodes % 2 == 0);
    std::array<double, C> out;
    const double u2 = u * u;
    for (std::size_t c = 0; c < C; ++c) {
      double odd = in_u[(patch_nodes - 1) * C + c], even = in_u[(patch_nodes - 2) * C + c];
      for (std::size_t i = patch_nodes - 2; i >= 2; i -= 2) {
        odd = odd * u2 + in_u[(i - 1) * C + c];
        even = even * u2 + in_u[(i - 2) * C + c];
      }
      out[c] = even + u * odd;
    }
    return out;
  }

 private:
  std::array<double, static_cast<std::size_t>(patch_nodes* patch_nodes* C)> at_;
};

}  // namespace hydro::panels
