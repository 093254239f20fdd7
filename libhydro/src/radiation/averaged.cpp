#include "averaged.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/interpolation.hpp"
#include "polygon.hpp"

namespace hydro::radiation {
namespace {

/// Largest ωh between neighbouring places. Cut into four straight pieces, as any table is, sinc² is off by
/// (0.1/4)²/48 = 1.3e-5 between them.
constexpr double farthest_apart = 0.1;

}  // namespace

DampingTable averaged_over_steps(const DampingTable& damping, double step) {
  std::vector<double> omega{0};
  omega.insert(omega.end(), damping.omega.begin(), damping.omega.end());
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(damping.B.front().rows(), damping.B.front().cols());
  const auto value = [&](std::size_t k) -> const Eigen::MatrixXd& { return k == 0 ? none : damping.B[k - 1]; };
  DampingTable out;
  for (std::size_t i = 1; i < omega.size(); ++i) {
    const double gap = omega[i] - omega[i - 1], parts = std::max(1.0, std::ceil(gap * step / farthest_apart));
    for (double part = 1; part <= parts; ++part) {
      const double at = part == parts ? omega[i] : omega[i - 1] + gap * part / parts;
      out.omega.push_back(at);
      const double sinc = detail::Bessel(at * step / 2).j0;
      out.B.push_back(sinc * sinc *
                      (part == parts ? damping.B[i - 1] : combined(cubic_stencil(omega, at), omega.size(), value)));
    }
  }
  return out;
}

}  // namespace hydro::radiation
