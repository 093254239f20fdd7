#include "regular_waves.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "cylinders/bessel.hpp"

namespace hydro::panels {
namespace {

using Complex = std::complex<double>;
using cylinders::VerticalModes;
using Eigen::Index;

/// How a mode varies over the depth: Z_n and its slope (C2).
struct OverDepth {
  double Z, slope;
};

OverDepth over_depth(const VerticalModes& modes, int n, double z) {
  const double up = z + modes.depth;
  if (n == 0) {
    if (!modes.has_wave()) return {0, 0};
    const double grown = std::exp(modes.k * z), norm = 2 * std::sqrt(modes.wave_norm_scaled());
    const double image = std::exp(-2 * modes.k * up);
    return {grown * (1 + image) / norm, modes.k * grown * (1 - image) / norm};
  }
  const double kappa = modes.kappa[static_cast<std::size_t>(n - 1)], norm = std::sqrt(modes.norm(kappa));
  return {std::cos(kappa * up) / norm, -kappa * std::sin(kappa * up) / norm};
}

/// S_n at one distance from the axis, its slope, and m S_n/r, by m = 0, 1, …
struct Radial {
  std::vector<double> S, slope, over_r;
};

/// From C_0 … C_{M+1} of J (sign −1) or I (sign 1): C′ = ½(C_{m−1} + sign C_{m+1}), m C/x = ½(C_{m−1} − sign C_{m+1}).
Radial radial(const std::vector<double>& C, double sign, double wavenumber, const std::vector<double>& scale) {
  Radial out;
  for (std::size_t m = 0; m + 1 < C.size(); ++m) {
    const double before = m > 0 ? C[m - 1] : sign * C[1];
    out.S.push_back(scale[m] * C[m]);
    out.slope.push_back(scale[m] * wavenumber * (before + sign * C[m + 1]) / 2);
    out.over_r.push_back(m > 0 ? scale[m] * wavenumber * (before - sign * C[m + 1]) / 2 : 0);
  }
  return out;
}

Radial radial_of(const VerticalModes& modes, int n, int orders, double r, double radius, std::vector<double> scale) {
  std::vector<double> C(static_cast<std::size_t>(orders + 2));
  if (n == 0) {
    if (modes.has_wave()) cylinders::bessel_j_sequence(0, modes.k * r, C);
    return radial(C, -1, modes.k, scale);
  }
  const double kappa = modes.kappa[static_cast<std::size_t>(n - 1)], weaker = std::exp(kappa * (r - radius));
  cylinders::bessel_i_scaled_sequence(0, kappa * r, C);
  for (double& s : scale) s *= weaker;
  return radial(C, 1, kappa, scale);
}

}  // namespace

RegularWaves regular_waves(const Eigen::MatrixXd& point, const Eigen::MatrixXd& normal, const VerticalModes& modes,
                           double radius, const cylinders::Channels& channels) {
  constexpr double on_axis = 1e-9;  // of the radius: there θ is taken to be 0, and recurrences need no division
  const cylinders::RadialScales scale = cylinders::radial_scales(modes, radius, channels);
  const cylinders::WaveIndex at(channels);
  RegularWaves out{Eigen::MatrixXcd(point.rows(), channels.count()), Eigen::MatrixXcd(point.rows(), channels.count())};
  for (Index p = 0; p < point.rows(); ++p) {
    const double x = point(p, 0), y = point(p, 1), r = std::max(std::hypot(x, y), on_axis * radius);
    const double theta = std::atan2(y, x), c = std::cos(theta), s = std::sin(theta);
    const double outward = normal(p, 0) * c + normal(p, 1) * s, around = normal(p, 1) * c - normal(p, 0) * s;
    for (int n = 0; n < channels.vertical(); ++n) {
      const int M = channels.order[static_cast<std::size_t>(n)];
      const Radial f = radial_of(modes, n, M, r, radius, scale[static_cast<std::size_t>(n)]);
      const OverDepth d = over_depth(modes, n, point(p, 2));
      for (int m = -M; m <= M; ++m) {
        const auto order = static_cast<std::size_t>(std::abs(m));
        const Complex turn = std::polar(1.0, m * theta), turning(0, m < 0 ? -1 : 1);
        out.value(p, at(0, n, m)) = f.S[order] * d.Z * turn;
        out.slope(p, at(0, n, m)) = turn * ((outward * f.slope[order] + around * turning * f.over_r[order]) * d.Z +
                                            normal(p, 2) * f.S[order] * d.slope);
      }
    }
  }
  return out;
}

}  // namespace hydro::panels
