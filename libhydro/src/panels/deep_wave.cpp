#include "deep_wave.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "gauss.hpp"
#include "patches.hpp"
#include "wave_bessel.hpp"

namespace hydro::panels {
namespace {

using std::numbers::pi;

/// H₀ and H₁ of Struve by their power series (Abramowitz & Stegun 1964, 12.1.3); x <= 12.
BesselPair struve_near(double x) {
  const double q = x * x / 4;
  double term0 = 2 * x / pi, term1 = 2 * x * x / (3 * pi), H0 = term0, H1 = term1;
  for (int k = 1; k < 60; ++k) {
    term0 *= -q / ((k + 0.5) * (k + 0.5));
    term1 *= -q / ((k + 0.5) * (k + 1.5));
    H0 += term0;
    H1 += term1;
  }
  return {H0, H1};
}

/// H − Y of both orders as integrals (12.1.8): (2/π)∫e^{−xt}(1 + t²)^{∓½} dt, the second with a factor x.
BesselPair struve_less_neumann(double x) {
  const auto& rule = gauss_rule();
  double a = 0, b = 0;
  for (int i = 0; i < 10; ++i)  // e^{−40} is left out
    for (std::size_t n = 0; n < rule.point.size(); ++n) {
      const double s = rule.point[n], w = rule.weight[n];
      const double u = 4 * i + 2 * (s + 1), t = u / x, f = 2 * w * std::exp(-u);
      a += f / (x * std::sqrt(1 + t * t));
      b += f * std::sqrt(1 + t * t);
    }
  return {2 / pi * a, 2 / pi * b};
}

/// H + Y.
BesselPair struve_and_neumann(double x) {
  const double Y0 = std::cyl_neumann(0.0, x), Y1 = std::cyl_neumann(1.0, x);
  if (x < 12) {
    const BesselPair H = struve_near(x);
    return {H.order0 + Y0, H.order1 + Y1};
  }
  const BesselPair d = struve_less_neumann(x);
  return {d.order0 + 2 * Y0, d.order1 + 2 * Y1};
}

/// F and G₁ = ⨍e^{−tY}J₁(tX)/(t − 1)dt.
struct Pair {
  double F, G;
};

Pair by_quadrature(double X, double Y) {
  const BesselPair S = struve_and_neumann(X);
  const double end = std::asinh(Y / X);
  const int pieces = 1 + static_cast<int>(end);
  const auto& rule = gauss_rule();
  double f = 0, g = 0;
  for (int i = 0; i < pieces; ++i)
    for (std::size_t n = 0; n < rule.point.size(); ++n) {
      const double s = rule.point[n], w = rule.weight[n];
      const double u = end * (i + (s + 1) / 2) / pieces, e = w * std::exp(X * std::sinh(u) - Y);
      f += e;
      g += e * std::exp(-u);
    }
  const double step = end / pieces / 2, decay = std::exp(-Y);
  return {-decay * pi / 2 * S.order0 - step * f, decay * (1 - pi / 2 * S.order1 - 1 / X) - step * g};
}

DeepWave with_slopes(double X, double Y, double rho, const Pair& p) {
  return {p.F, -X / (rho * (rho + Y)) - p.G, -p.F - 1 / rho};
}

constexpr double far = 30;             // e^{−far} is what an asymptotic series can give
constexpr int bands = 20;              // of ρ up to there
constexpr double width = far / bands;  // half of it is the phase of a wave across half a patch: (0.375)^10/10! = 2e-11

int patches_in_band(int band) { return 2 + static_cast<int>(0.9 * (band + 1) * width); }

/// F + e^{−Y}J₀(X) ln(ρ + Y) and G₁ + e^{−Y}J₁(X) ln(ρ + Y), which are analytic in ρ and t = X/(ρ + Y), on
/// rectangles of (ρ, t).
class Table {
 public:
  Table() {
    for (int band = 0; band < bands; ++band)
      for (int i = 0; i < patches_in_band(band); ++i) patch_[static_cast<std::size_t>(band)].push_back(patch(band, i));
  }
  std::array<double, 2> at(double rho, double t) const {
    const int band = std::min(static_cast<int>(rho / width), bands - 1);
    const int count = patches_in_band(band);
    const int i = std::min(static_cast<int>(t * count), count - 1);
    return patch_[static_cast<std::size_t>(band)][static_cast<std::size_t>(i)](2 * (rho / width - band) - 1,
                                                                               2 * (t * count - i) - 1);
  }

 private:
  static Patch<2> patch(int band, int i) {
    std::array<Eigen::MatrixXd, 2> values;
    values.fill(Eigen::MatrixXd(patch_nodes, patch_nodes));
    for (int a = 0; a < patch_nodes; ++a)
      for (int b = 0; b < patch_nodes; ++b) {
        const double rho = width * (band + (patch_node(a) + 1) / 2);
        const double t = (i + (patch_node(b) + 1) / 2) / patches_in_band(band);
        const double X = rho * 2 * t / (1 + t * t), Y = rho * (1 - t * t) / (1 + t * t);
        const Pair p = by_quadrature(X, Y);
        const BesselPair J = bessel_j(X);
        const double L = std::exp(-Y) * std::log(rho + Y);
        values[0](a, b) = p.F + J.order0 * L;
        values[1](a, b) = p.G + J.order1 * L;
      }
    return Patch<2>(values);
  }
  std::array<std::vector<Patch<2>>, bands> patch_;
};

/// −Σ n! P_n/ρ^{n+1} and the like of G₁, with the wave (G5).
Pair far_away(double X, double Y, double rho) {
  const double c = Y / rho, s = X / rho;
  double before = 1, P = c, slope_before = 0, slope = 1;  // Legendre's P₀, P₁ and slopes
  double factor = 1 / rho, F = -factor, G = -s / (rho * (1 + c));
  for (int n = 1; n <= 16; ++n) {
    G -= factor / rho * s * slope;  // (n − 1)!/ρ^{n+1}
    factor *= n / rho;
    F -= factor * P;
    const double next = ((2 * n + 1) * c * P - n * before) / (n + 1);
    const double slope_next = slope_before + (2 * n + 1) * P;
    before = P;
    P = next;
    slope_before = slope;
    slope = slope_next;
  }
  if (Y > 25) return {F, G};  // e^{−25} = 1e-11; nearer, X > 16
  const BesselPair N = bessel_y_far(X);
  const double e = pi * std::exp(-Y);
  return {F - e * N.order0, G - e * N.order1};
}

}  // namespace

DeepWave deep_wave_by_quadrature(double X, double Y) {
  return with_slopes(X, Y, std::hypot(X, Y), by_quadrature(X, Y));
}

DeepWave deep_wave(double X, double Y) { return deep_wave(X, Y, std::exp(-Y), bessel_j(X)); }

DeepWave deep_wave(double X, double Y, double decay, const BesselPair& J) {
  static const Table table;
  const double rho = std::sqrt(X * X + Y * Y);
  if (rho > far) return with_slopes(X, Y, rho, far_away(X, Y, rho));
  const std::array<double, 2> smooth = table.at(rho, X / (rho + Y));
  const double L = decay * std::log(rho + Y);
  return with_slopes(X, Y, rho, {smooth[0] - J.order0 * L, smooth[1] - J.order1 * L});
}

}  // namespace hydro::panels
