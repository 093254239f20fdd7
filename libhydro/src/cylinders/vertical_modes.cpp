#include "hydro/cylinders/vertical_modes.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/waves/dispersion.hpp"

namespace hydro::cylinders {
namespace {

using std::numbers::pi;

double finite_depth(const WaterDepth& depth) {
  if (depth.is_infinite()) throw InputError("vertical modes need a finite depth", {}, "state the depth of the water");
  return depth.metres();
}

std::vector<double> roots(double K, double depth, int count) {
  std::vector<double> kappa;
  kappa.reserve(static_cast<std::size_t>(count));
  for (int n = 1; n <= count; ++n) kappa.push_back(evanescent_root(n, K, depth));
  return kappa;
}

}  // namespace

// y = κh solves y + atan(Kh/y) = nπ, whose left side increases for y > π/2; Newton from its first iterate.
double evanescent_root(double n, double K, double depth) {
  const double X = K * depth;
  if (std::isinf(X)) return (n - 0.5) * pi / depth;
  double y = n * pi - std::atan(X / (n * pi));
  for (int step = 0; step < 50; ++step) {
    const double change = (y + std::atan(X / y) - n * pi) / (1 - X / (y * y + X * X));
    y -= change;
    if (std::abs(change) < 1e-16 * y) break;
  }
  return y / depth;
}

VerticalModes VerticalModes::at(double omega, const Water& water, int evanescent) {
  const double h = finite_depth(water.depth);
  const double k = waves::wavenumber(omega, water);
  const double K = omega * omega / water.gravity;
  return {.depth = h, .K = K, .k = k, .kappa = roots(K, h, evanescent)};
}

VerticalModes VerticalModes::at_infinite_frequency(const WaterDepth& depth, int evanescent) {
  const double h = finite_depth(depth);
  const double K = std::numeric_limits<double>::infinity();
  return {.depth = h, .K = K, .k = 0, .kappa = roots(K, h, evanescent)};
}

// By (C1) sin 2κh = −2Kκ/(κ² + K²), cos κh and sin κh likewise: no trigonometric function of a large argument.
double VerticalModes::norm(double kappa_n) const {
  return std::isinf(K) ? 0.5 : 0.5 - K / (2 * depth * (kappa_n * kappa_n + K * K));
}

double VerticalModes::cos_at_surface(int n) const {
  if (std::isinf(K)) return 0;
  const double kappa_n = kappa[static_cast<std::size_t>(n - 1)];
  return (n % 2 == 0 ? 1 : -1) * kappa_n / std::hypot(kappa_n, K);
}

double VerticalModes::sin_at_surface(int n) const {
  const double sign = n % 2 == 0 ? -1 : 1;
  return std::isinf(K) ? sign : sign * K / std::hypot(kappa[static_cast<std::size_t>(n - 1)], K);
}

double VerticalModes::wave_norm_scaled() const {
  const double two_kh = 2 * k * depth;
  return (std::exp(-two_kh) - std::expm1(-2 * two_kh) / (2 * two_kh)) / 2;
}

double VerticalModes::wave_at_surface() const {
  return (1 + std::exp(-2 * k * depth)) / 2 / std::sqrt(wave_norm_scaled());
}

}  // namespace hydro::cylinders
