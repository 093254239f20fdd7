#include "hydro/waves/spectra/spreading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/signal/distributions.hpp"
#include "spectrum_shapes.hpp"
#include "spreading_checks.hpp"

namespace hydro::waves {
namespace {

using std::numbers::pi;

// (W41): 1/∫ cos^m φ dφ over −π/2 … π/2, which is √π Γ((m+1)/2)/Γ(m/2+1).
double cosine_power_scale(double m) {
  return std::exp(std::lgamma(m / 2 + 1) - std::lgamma((m + 1) / 2)) / std::sqrt(pi);
}

// The limits of s and n are those of lgamma's rounding: 3e-11 in the factor of the incomplete beta function.
// (W41): ∫_{−π/2}^φ cos^m over the whole: with t = (1 + sin φ)/2 it is the incomplete beta function of t.
double cosine_power_share(double m, double phi) {
  if (phi > 0) return 1 - cosine_power_share(m, -phi);
  const double root = std::sin((pi / 2 + phi) / 2);  // t = root², without 1 − 1
  return signal::incomplete_beta((m + 1) / 2, (m + 1) / 2, root * root);
}

}  // namespace

void require_frequency(double omega) {
  require(std::isfinite(omega) && omega > 0,
          "a spreading function needs a frequency that is finite and positive, got {} rad/s", omega);
}

double angle_in_turn(Angle from_mean) {
  require(std::abs(from_mean.radians()) <= pi * (1 + 1e-15),
          "an angle from the mean heading must lie within ±π, got {} rad", from_mean.radians());
  return std::clamp(from_mean.radians(), -pi, pi);
}

double wrapped(Angle from_mean) {
  require(std::isfinite(from_mean.radians()), "an angle from the mean heading must be finite, got {}",
          from_mean.radians());
  return std::remainder(from_mean.radians(), 2 * pi);
}

Angle Spreading::quantile(double share, double omega) const {
  require(share >= 0 && share <= 1, "a share of the energy lies between 0 and 1, got {}", share);
  return Angle::from_radians(
      increasing_root([&](double theta) { return share_below(Angle::from_radians(theta), omega) - share; },
                      [&](double theta) { return density(Angle::from_radians(theta), omega); }, -pi, pi));
}

Angle Spreading::width(double omega) const {
  return Angle::from_radians(std::sqrt(2 * std::max(0.0, 1 - first_harmonic(omega))));
}

SpreadingExponent SpreadingExponent::constant(double s) {
  require(s >= 0 && s <= 5000, "the exponent s of cos^2s spreading must be between 0 and 5000, got {}", s);
  return {s, {}};
}

SpreadingExponent SpreadingExponent::goda(double s_max, double omega_p) {
  require(s_max > 0 && s_max <= 5000, "the exponent s_max of cos^2s spreading must be above 0 and at most 5000, got {}",
          s_max);
  require_frequency(omega_p);
  return {s_max, omega_p};
}

SpreadingExponent SpreadingExponent::mitsuyasu(double u_10, double omega_p, double gravity) {
  require(std::isfinite(u_10) && u_10 > 0, "wind speed must be finite and positive, got {} m/s", u_10);
  require(std::isfinite(gravity) && gravity > 0, "gravity must be finite and positive, got {} m/s^2", gravity);
  require_frequency(omega_p);
  return goda(11.5 * std::pow(omega_p * u_10 / gravity, -2.5), omega_p);
}

// (W42)
double SpreadingExponent::at(double omega) const {
  require_frequency(omega);
  if (!omega_p_) return s_;
  return s_ * std::pow(omega / *omega_p_, omega <= *omega_p_ ? 5.0 : -2.5);
}

// cos^{2s}(θ/2) is cos^m φ with m = 2s and φ = θ/2, dθ = 2dφ.
double Cos2sSpreading::density(Angle from_mean, double omega) const {
  const double m = 2 * s_.at(omega);
  return 0.5 * cosine_power_scale(m) * std::pow(std::abs(std::cos(wrapped(from_mean) / 2)), m);
}

double Cos2sSpreading::share_below(Angle from_mean, double omega) const {
  return cosine_power_share(2 * s_.at(omega), angle_in_turn(from_mean) / 2);
}

double Cos2sSpreading::first_harmonic(double omega) const {
  const double s = s_.at(omega);
  return s / (s + 1);
}

CosNSpreading::CosNSpreading(double n) : n_(n) {
  require(n >= 0 && n <= 1e4, "the exponent n of cos^n spreading must be between 0 and 1e4, got {}", n);
  scale_ = cosine_power_scale(n);
}

double CosNSpreading::density(Angle from_mean, double omega) const {
  require_frequency(omega);
  const double theta = wrapped(from_mean);
  return std::abs(theta) < pi / 2 ? scale_ * std::pow(std::cos(theta), n_) : 0;
}

double CosNSpreading::share_below(Angle from_mean, double omega) const {
  require_frequency(omega);
  return cosine_power_share(n_, std::clamp(angle_in_turn(from_mean), -pi / 2, pi / 2));
}

double CosNSpreading::first_harmonic(double omega) const {
  require_frequency(omega);
  return scale_ / cosine_power_scale(n_ + 1);
}

}  // namespace hydro::waves
