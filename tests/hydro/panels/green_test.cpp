// The Green function against its definition, integrated plainly, and the closed forms of its parts.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/waves/dispersion.hpp"
#include "panels/deep_wave.hpp"
#include "panels/gauss.hpp"
#include "panels/green.hpp"
#include "panels/polygon.hpp"
#include "panels/wave_bessel.hpp"

namespace hydro::panels::green_test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// ∫f over [a, b] by Gauss's rule on many pieces.
template <class F>
double integral(double a, double b, int pieces, const F& f) {
  double sum = 0;
  const double step = (b - a) / pieces;
  for (int i = 0; i < pieces; ++i) sum += gauss_rule().integrate(f, a + step * i, a + step * (i + 1));
  return sum;
}

/// ⨍₀^end f with a simple pole at `pole`: points on either side are taken together, where the pole cancels.
template <class F>
double principal_value(double pole, double end, const F& f) {
  return integral(0, pole, 60, [&](double u) { return f(pole + u) + f(pole - u); }) + integral(2 * pole, end, 400, f);
}

TEST(PanelGreen, BesselFunctionsAreThoseOfTheLibrary) {
  for (double x = 0.013; x < 80; x += 0.171) {
    EXPECT_NEAR(bessel_j(x).order0, std::cyl_bessel_j(0.0, x), 1e-13) << x;
    EXPECT_NEAR(bessel_j(x).order1, std::cyl_bessel_j(1.0, x), 1e-13) << x;
    if (x < 16) continue;
    EXPECT_NEAR(bessel_y_far(x).order0, std::cyl_neumann(0.0, x), 1e-13) << x;
    EXPECT_NEAR(bessel_y_far(x).order1, std::cyl_neumann(1.0, x), 1e-13) << x;
  }
}

TEST(PanelGreen, DeepWavesAreTheirIntegral) {
  for (const double X : {1e-3, 0.4, 3.0, 11.0, 28.0, 45.0})
    for (const double Y : {0.25, 1.0, 4.0, 12.0}) {
      const auto F = principal_value(
          1, 40 / Y, [&](double t) { return std::exp(-t * Y) * std::cyl_bessel_j(0.0, t * X) / (t - 1); });
      const auto F_X = principal_value(
          1, 40 / Y, [&](double t) { return -t * std::exp(-t * Y) * std::cyl_bessel_j(1.0, t * X) / (t - 1); });
      const DeepWave w = deep_wave(X, Y);
      EXPECT_NEAR(w.F, F, 2e-9) << X << ' ' << Y;  // stated: 2e-9 of 1 + |ln ρ|
      EXPECT_NEAR(w.F_X, F_X, 2e-9 / std::min(1.0, std::hypot(X, Y))) << X << ' ' << Y;
    }
}

TEST(PanelGreen, TheTableHoldsWhatTheQuadratureGives) {
  for (double rho = 1e-4; rho < 60; rho *= 1.07)
    for (double t = 1e-3; t < 1; t += 0.0331) {
      const double X = rho * 2 * t / (1 + t * t), Y = rho * (1 - t * t) / (1 + t * t);
      const DeepWave fast = deep_wave(X, Y), slow = deep_wave_by_quadrature(X, Y);
      EXPECT_NEAR(fast.F, slow.F, 2e-9 * (1 + std::abs(std::log(rho)))) << X << ' ' << Y;
      EXPECT_NEAR(fast.F_X, slow.F_X, 2e-9 / std::min(1.0, rho)) << X << ' ' << Y;
    }
}

/// Wehausen & Laitone (1960), (13.18), less 1/r and the images of bed and surface; the whole of it but for
/// ∫e^{−k(2h − V)}J₀ dk of the image in the surface, which is taken off inside.
double plain_wave_part(double K, double h, double R, double z, double zeta) {
  const double k0 = waves::wavenumber(std::sqrt(K), {.density = 1, .gravity = 1, .depth = WaterDepth::from_metres(h)});
  return principal_value(k0, std::max(3 * k0, 60 / (-z - zeta)), [&](double k) {
    const double e = std::exp(-2 * k * h);
    const double D = (k - K) - (k + K) * e;  // 2e^{−kh}(k sinh kh − K cosh kh)
    const double both =
        std::exp(k * (z + zeta)) * (1 + std::exp(-2 * k * (z + h))) * (1 + std::exp(-2 * k * (zeta + h)));
    return ((k + K) / D * both - std::exp(k * (z + zeta))) * std::cyl_bessel_j(0.0, k * R);
  });
}

TEST(PanelGreen, WavesOverABedAreTheirIntegral) {
  constexpr double h = 5;
  for (const double K : {0.02, 0.2, 1.0, 4.0}) {
    const WaveGreen green(K, WaterDepth::from_metres(h), 30);
    for (const double R : {0.01, 1.1, 2.4, 2.6, 9.0, 29.0})  // the two formulas of the table meet at 2.5
      for (const double z : {-0.4, -2.0, -4.7})
        for (const double zeta : {-0.6, -4.9}) {
          const WavePart w = green(R, z, zeta);
          EXPECT_NEAR(w.G.real(), plain_wave_part(K, h, R, z, zeta), 2e-9 * (1 + K))
              << K << ' ' << R << ' ' << z << ' ' << zeta;
          EXPECT_EQ(std::isfinite(w.G.imag()), true);
        }
  }
}

/// Slopes against differences of order four, whose error is that of the function over the step.
void expect_slopes(const WaveGreen& green, double R, double z, double zeta) {
  constexpr double d = 2e-3;
  const auto slope = [&](auto f) { return (8.0 * (f(d) - f(-d)) - (f(2 * d) - f(-2 * d))) / (12 * d); };
  const WavePart w = green(R, z, zeta);
  const auto along = slope([&](double s) { return green(R + s, z, zeta).G; });
  const auto up = slope([&](double s) { return green(R, z, zeta + s).G; });
  EXPECT_LT(std::abs(w.G_R - along), 1e-7) << R << ' ' << z << ' ' << zeta;
  EXPECT_LT(std::abs(w.G_zeta - up), 1e-7) << R << ' ' << z << ' ' << zeta;
}

TEST(PanelGreen, SlopesAreThoseOfTheFunction) {
  for (const auto& depth : {WaterDepth::infinite(), WaterDepth::from_metres(5)})
    for (const double K : {0.1, 1.0, 2.5}) {
      const WaveGreen green(K, depth, 30);
      for (const double R : {0.3, 2.0, 7.0, 25.0}) expect_slopes(green, R, -0.7, -1.3);
      expect_slopes(green, 1.2, -3.1, -0.9);
    }
}

TEST(PanelGreen, MeetsTheConditionsAtSurfaceAndBedAndIsTheSameBothWays) {
  constexpr double h = 5;
  for (const double K : {0.05, 0.7, 3.0}) {
    const WaveGreen green(K, WaterDepth::from_metres(h), 30);
    for (const double R : {0.2, 3.0, 20.0}) {
      const double z = -1.7;
      const WavePart top = green(R, z, 0), bottom = green(R, z, -h);
      const double r = std::hypot(R, z), bed = std::hypot(R, z + 2 * h), image = std::hypot(R, z - h);
      // 1/r and its image in the surface have no slope together; that in the bed has.
      EXPECT_LT(std::abs(K * (top.G + 2 / r + 1 / bed) - top.G_zeta + (z + 2 * h) / (bed * bed * bed)), 1e-8)
          << K << ' ' << R;
      EXPECT_LT(std::abs(bottom.G_zeta - (z - h) / (image * image * image)), 1e-8) << K << ' ' << R;
      EXPECT_LT(std::abs(green(R, z, -3.2).G - green(R, -3.2, z).G), 1e-12);
    }
  }
}

TEST(PanelGreen, AtInfiniteFrequencyThereIsNoPotentialAtTheSurface) {
  constexpr double h = 5;
  const WaveGreen green(infinite, WaterDepth::from_metres(h), 30);
  for (const double R : {0.2, 2.4, 2.6, 20.0})
    for (const double z : {-0.3, -4.0})
      EXPECT_NEAR(green(R, z, 0).G.real() + 1 / std::hypot(R, z + 2 * h), 0, 1e-9) << R;
}

TEST(PanelGreen, WavesGoOutWithoutLoss) {
  // √R G → C e^{−ikR}: with e^{+iωt} the phase falls outwards. Over three wavelengths the modulus of √R G changes by
  // 1/(kR)².
  for (const auto& depth : {WaterDepth::infinite(), WaterDepth::from_metres(5)}) {
    const WaveGreen green(1.3, depth, 400);
    const double k = green.k(), R = 300, step = pi / (2 * k);
    // All of G: its images fall faster than waves, but not the wave part alone.
    const auto at = [&](double r) {
      const double bed = depth.is_infinite() ? 0 : 1 / std::hypot(r, 9.3);
      return std::sqrt(r) * (green(r, -0.5, -0.2).G + 1 / std::hypot(r, 0.3) + 1 / std::hypot(r, 0.7) + bed);
    };
    EXPECT_LT(std::abs(at(R + step) / at(R) - std::complex<double>(0, -1)), 5e-3);
  }
}

TEST(PanelRankine, IsTheSumOfManyPoints) {
  const Polygon q = polygon({{0, 0, 0}, {2, 0, 0}, {1.7, 1.1, 0}, {0.1, 0.9, 0}});
  const Polygon t = polygon({{0, 0, 0}, {2, 0, 0}, {1.7, 1.1, 0}}),
                u = polygon({{0, 0, 0}, {1.7, 1.1, 0}, {0.1, 0.9, 0}});
  for (const Vector3d& P : {Vector3d(0.5, 0.4, 0.8), Vector3d(3, -1, -2), Vector3d(-1, 0.3, 0.5)}) {
    // Over triangles as squares folded up, by Gauss's rule both ways.
    const auto over = [&](const Polygon& p, const auto& f) {
      return integral(0, 1, 4, [&](double a) {
        return integral(0, 1, 4, [&](double b) {
          return 2 * p.area * a *
                 f(p.corners[0] + a * (p.corners[1] - p.corners[0] + b * (p.corners[2] - p.corners[1])));
        });
      });
    };
    const auto both = [&](const auto& f) { return over(t, f) + over(u, f); };
    const Rankine exact = rankine(q, P);
    EXPECT_NEAR(exact.source, both([&](const Vector3d& Q) { return 1 / (P - Q).norm(); }), 1e-10);
    EXPECT_NEAR(exact.dipole, both([&](const Vector3d& Q) { return P.z() / std::pow((P - Q).norm(), 3); }), 1e-10);
  }
}

TEST(PanelRankine, IsFiniteOnThePanelItself) {
  const Polygon square = polygon({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}});
  EXPECT_NEAR(rankine(square, {0, 0, 0}).source, 8 * std::log(1 + std::sqrt(2.0)), 1e-14);  // 8 asinh 1
  EXPECT_NEAR(rankine(square, {1, 1, 0}).source, 4 * std::log(1 + std::sqrt(2.0)),
              1e-14);  // a quarter of a square of twice the side
  EXPECT_NEAR(rankine(square, {0, 0, 1e-9}).dipole, 2 * pi, 1e-8);
  EXPECT_NEAR(rankine(square, {0, 0, -1e-9}).dipole, -2 * pi, 1e-8);
  EXPECT_EQ(rankine(square, {3, 0, 0}).dipole, 0);
}

TEST(PanelRankine, AClosedSurfaceIsSeenWholeFromInside) {
  double inside = 0, outside = 0;
  const double a = 0.5;
  for (const int axis : {0, 1, 2})
    for (const double side : {-a, a}) {
      const auto corner = [&](double p, double q) {
        Vector3d c = Vector3d::Zero();
        c(axis) = side;
        c((axis + 1) % 3) = p * (side > 0 ? 1 : -1);
        c((axis + 2) % 3) = q;
        return c;
      };
      const Polygon face = polygon({corner(-a, -a), corner(a, -a), corner(a, a), corner(-a, a)});
      inside += rankine(face, {0.1, -0.2, 0.3}).dipole;
      outside += rankine(face, {0.1, 2, 0.3}).dipole;
    }
  EXPECT_NEAR(inside, -4 * pi, 1e-12);  // normals point out
  EXPECT_NEAR(outside, 0, 1e-12);
}

}  // namespace
}  // namespace hydro::panels::green_test
