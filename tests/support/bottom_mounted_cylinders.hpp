#pragma once
/// \file  Waves on vertical cylinders that stand on the sea bed, in full depth: multiple scattering of the propagating
/// wave alone, after Linton & Evans (1990), "The interaction of waves with arrays of vertical circular cylinders",
/// Journal of Fluid Mechanics 215; written out with signed orders and the standard library's Bessel functions. Plain.
#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace froude_test {

using Complex = std::complex<double>;

inline double J(int m, double x) {
  const double value = std::cyl_bessel_j(std::abs(m), x);
  return m < 0 && m % 2 != 0 ? -value : value;
}
inline Complex H2(int m, double x) {
  const Complex value(std::cyl_bessel_j(std::abs(m), x), -std::cyl_neumann(std::abs(m), x));
  return m < 0 && m % 2 != 0 ? -value : value;
}
inline Complex slope_H2(int m, double x) { return (H2(m - 1, x) - H2(m + 1, x)) / 2.0; }
inline double slope_J(int m, double x) { return (J(m - 1, x) - J(m + 1, x)) / 2; }

/// Force along x and y on each cylinder of radius a for a wave of unit amplitude towards `beta`, Re(F e^{iωt}):
/// φ = (ig/ω) cosh k(z+h)/cosh kh [e^{−ik(x cos β + y sin β)} + Σ_j Σ_m A_jm Z_m H_m(kr_j) e^{imθ_j}], Z = J′/H′.
inline std::vector<Eigen::Vector2cd> forces_on_bottom_mounted(const std::vector<Eigen::Vector2d>& centre, double a,
                                                              double k, double h, double beta, double rho, double g,
                                                              int M = 14) {
  const int per = 2 * M + 1, N = static_cast<int>(centre.size());
  Eigen::MatrixXcd S = Eigen::MatrixXcd::Identity(N * per, N * per);
  Eigen::VectorXcd rhs(N * per);
  const Eigen::Vector2d towards(std::cos(beta), std::sin(beta));
  for (int c = 0; c < N; ++c)
    for (int m = -M; m <= M; ++m) {
      const auto& here = centre[static_cast<std::size_t>(c)];
      rhs(c * per + m + M) = -std::polar(1.0, -k * here.dot(towards) - m * (beta + std::numbers::pi / 2));
      for (int j = 0; j < N; ++j) {
        if (j == c) continue;
        const Eigen::Vector2d way = here - centre[static_cast<std::size_t>(j)];
        const double R = way.norm(), alpha = std::atan2(way.y(), way.x());
        for (int n = -M; n <= M; ++n)
          S(c * per + m + M, j * per + n + M) =
              slope_J(n, k * a) / slope_H2(n, k * a) * H2(n - m, k * R) * std::polar(1.0, (n - m) * alpha);
      }
    }
  const Eigen::VectorXcd A = S.partialPivLu().solve(rhs);
  std::vector<Eigen::Vector2cd> force;
  for (int c = 0; c < N; ++c) {
    // At the wall the potential of order m is A_m (Z_m H_m − J_m) = A_m 2i/(π ka H_m′).
    const auto wall = [&](int m) {
      return A(c * per + m + M) * Complex(0, 2 / (std::numbers::pi * k * a)) / slope_H2(m, k * a);
    };
    const double unit = -rho * g * std::numbers::pi * a * std::tanh(k * h) / k;  // iωρ · ig/ω = −ρg
    force.emplace_back(unit * (wall(1) + wall(-1)), unit * Complex(0, 1) * (wall(1) - wall(-1)));
  }
  return force;
}

}  // namespace froude_test
