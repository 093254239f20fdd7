#include "hydro/waves/dispersion.hpp"

#include <cmath>
#include <numbers>

namespace hydro::waves {
namespace {

void require_gravity(const Water& water) {
  require(std::isfinite(water.gravity) && water.gravity > 0, "gravity must be finite and positive, got {} m/s^2",
          water.gravity);
}

// kh from X = ω²h/g by the explicit formula (W2), within 0.8 % (Dispersion.ExplicitStartIsWithinItsStatedError).
double explicit_start(double X) {
  constexpr double beta = 2.4908;
  return X * std::pow(-std::expm1(-std::pow(X, beta / 2)), -1 / beta);
}

// One Newton step on f(y) = y tanh y − X, (W3). Squares the relative error, so three take 0.8 % below rounding.
double newton_step(double y, double X) {
  const double tanh_y = std::tanh(y);
  return y - (y * tanh_y - X) / (tanh_y + y * (1 - tanh_y) * (1 + tanh_y));
}

}  // namespace

double wavenumber(double omega, const Water& water) {
  require(std::isfinite(omega) && omega > 0, "a wave frequency must be finite and positive, got {} rad/s", omega);
  require_gravity(water);
  const double k_deep = omega * omega / water.gravity;
  if (water.depth.is_infinite()) return k_deep;
  const double h = water.depth.metres();
  const double X = k_deep * h;
  double y = explicit_start(X);
  for (int step = 0; step < 3; ++step) y = newton_step(y, X);
  return y / h;
}

double angular_frequency(double k, const Water& water) {
  require(std::isfinite(k) && k > 0, "a wavenumber must be finite and positive, got {} rad/m", k);
  require_gravity(water);
  return std::sqrt(water.gravity * k * std::tanh(k * water.depth.metres()));
}

double phase_velocity(double omega, const Water& water) { return omega / wavenumber(omega, water); }

double group_velocity(double omega, const Water& water) {
  const double k = wavenumber(omega, water);
  if (water.depth.is_infinite()) return omega / (2 * k);
  const double two_kh = 2 * k * water.depth.metres();
  return omega / (2 * k) * (1 + two_kh / std::sinh(two_kh));  // (W4); sinh = ∞ in deep water gives the limit ½
}

DepthRegime depth_regime(double kh) {
  require(kh > 0, "kh must be positive, got {}", kh);
  constexpr double pi = std::numbers::pi;
  return kh >= pi ? DepthRegime::deep : kh <= pi / 10 ? DepthRegime::shallow : DepthRegime::intermediate;
}

std::string_view name(DepthRegime regime) {
  constexpr std::array<std::string_view, 3> names{"shallow", "intermediate", "deep"};
  return names[static_cast<std::size_t>(regime)];
}

}  // namespace hydro::waves
