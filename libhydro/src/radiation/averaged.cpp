#include "averaged.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/interpolation.hpp"

namespace hydro::radiation {
namespace {

/// Largest ωh between neighbouring places. Cut into four straight pieces, as any table is, sinc² is off by
/// (0.1/4)²/48 = 1.3e-5 between them.
constexpr double farthest_apart = 0.1;

double sinc_squared(double x) {
  const double sinc = x == 0 ? 1 : std::sin(x) / x;
  return sinc * sinc;
}

/// B on the cubic of (P6), B(0) = 0.
Eigen::MatrixXd cubic(const DampingTable& damping, const std::vector<double>& omega, double at) {
  const Stencil stencil = cubic_stencil(omega, at);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(damping.B.front().rows(), damping.B.front().cols());
  for (std::size_t k = 0; k < stencil.weight.size(); ++k)
    if (const std::size_t from = stencil.first + k; from > 0 && stencil.weight[k] != 0)
      out += stencil.weight[k] * damping.B[from - 1];
  return out;
}

}  // namespace

DampingTable averaged_over_steps(const DampingTable& damping, double step) {
  std::vector<double> omega{0};
  omega.insert(omega.end(), damping.omega.begin(), damping.omega.end());
  DampingTable out;
  for (std::size_t i = 1; i < omega.size(); ++i) {
    const double gap = omega[i] - omega[i - 1], parts = std::max(1.0, std::ceil(gap * step / farthest_apart));
    for (double part = 1; part <= parts; ++part) {
      const double at = part == parts ? omega[i] : omega[i - 1] + gap * part / parts;
      out.omega.push_back(at);
      out.B.push_back(sinc_squared(at * step / 2) * (part == parts ? damping.B[i - 1] : cubic(damping, omega, at)));
    }
  }
  return out;
}

}  // namespace hydro::radiation
