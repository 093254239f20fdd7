#include "hydro/waves/kinematics/impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/base/error.hpp"
#include "waves/gauss_legendre.hpp"

namespace hydro::waves {
namespace {

using std::numbers::pi;

void require_circle(double elevation, double centre, double diameter) {
  require(std::isfinite(diameter) && diameter > 0, "the diameter of a cylinder must be finite and positive, got {} m",
          diameter);
  require(std::isfinite(elevation) && std::isfinite(centre),
          "the surface at {} m and the centre of the cylinder at {} m must be finite", elevation, centre);
}

// Below, τ = Vt/R and forces are in units of ρRV².
constexpr double switch_time = 1.0 / 8, shift = 1.0 / 32, end_time = 13.0 / 32;

// artanh √(1 − x), 0 < x <= 1; 1 − x itself would lose a small x.
double artanh_root(double x) { return std::log((1 + std::sqrt(1 - x)) / std::sqrt(x)); }

// (W84): √τ artanh √(1 − τ/4) → 0 as τ → 0, which the formula itself only says as 0·∞.
double first_branch(double tau) {
  if (tau == 0) return 2 * pi;
  return 2 * pi - 2 * std::sqrt(tau) * artanh_root(tau / 4);
}

double second_branch(double tau) {
  const double s = tau - shift;
  return pi / std::sqrt(6 * s) - std::pow(8 * s / 3, 0.25) * artanh_root(s * std::sqrt(6 * s));  // (W85)
}

// ∫ of the first branch from contact, by parts and with τ = 4 sin²θ, (W86).
double first_impulse(double tau) {
  if (tau == 0) return 0;
  const double theta = std::asin(std::sqrt(tau) / 2);
  return 2 * pi * tau - 4.0 / 3 * tau * std::sqrt(tau) * artanh_root(tau / 4) -
         16.0 / 3 * (theta - std::sin(theta) * std::cos(theta));
}

double wienke_impulse(double tau) {
  if (tau <= switch_time) return first_impulse(tau);
  static const GaussLegendre<24> quadrature;
  return first_impulse(switch_time) + quadrature.integrate(second_branch, switch_time, std::min(tau, end_time));
}

}  // namespace

double wetness_by_height(double elevation, double centre, double diameter) {
  require_circle(elevation, centre, diameter);
  return std::clamp((elevation - (centre - diameter / 2)) / diameter, 0.0, 1.0);  // (W80)
}

WetCircle wet_circle(double elevation, double centre, double diameter) {
  require_circle(elevation, centre, diameter);
  // (W81): α is half the angle under which the wet arc is seen from the centre.
  const double s = std::clamp(2 * (elevation - centre) / diameter, -1.0, 1.0);
  const double alpha = std::acos(-s), root = std::sqrt((1 - s) * (1 + s));
  return {.area_share = (alpha + s * root) / pi, .arc_share = alpha / pi, .chord = diameter * root};
}

CylinderImpact::CylinderImpact(ImpactTheory theory, double radius, double speed, double density)
    : theory_(theory), radius_(radius), speed_(speed), density_(density) {
  require(std::isfinite(radius) && radius > 0, "the radius of a cylinder must be finite and positive, got {} m",
          radius);
  require(std::isfinite(speed) && speed >= 0, "the speed of an impact must be finite and not negative, got {} m/s",
          speed);
  require(std::isfinite(density) && density > 0, "the density of water must be finite and positive, got {} kg/m^3",
          density);
}

double CylinderImpact::scaled_time(double t) const {
  require(std::isfinite(t), "the time since contact must be finite, got {} s", t);
  return speed_ * t / radius_;
}

double CylinderImpact::force(double t) const {
  const double tau = scaled_time(t), unit = density_ * radius_ * speed_ * speed_;
  if (tau < 0) return 0;
  switch (theory_) {
    case ImpactTheory::von_karman:
    case ImpactTheory::goda:
      return unit * pi * std::max(0.0, 1 - tau);
    case ImpactTheory::wienke_oumeraci:
      break;
  }
  if (tau >= end_time) return 0;
  return unit * (tau <= switch_time ? first_branch(tau) : second_branch(tau));
}

double CylinderImpact::impulse(double t) const {
  const double tau = std::max(0.0, scaled_time(t)), unit = density_ * radius_ * radius_ * speed_;
  if (theory_ == ImpactTheory::wienke_oumeraci) return unit * wienke_impulse(tau);
  const double end = std::min(tau, 1.0);
  return unit * pi * end * (1 - end / 2);
}

double CylinderImpact::half_width(double t) const {
  const double tau = std::max(0.0, scaled_time(t));
  if (theory_ != ImpactTheory::wienke_oumeraci) {
    const double depth = std::min(tau, 1.0);
    return radius_ * std::sqrt(depth * (2 - depth));  // (W82): the circle where the surface cuts it
  }
  if (tau <= switch_time) return 2 * radius_ * std::sqrt(tau);
  return 2 * radius_ * std::pow((std::min(tau, end_time) - shift) / 6, 0.25);
}

double CylinderImpact::duration() const {
  if (speed_ == 0) return std::numeric_limits<double>::infinity();
  return radius_ / speed_ * (theory_ == ImpactTheory::wienke_oumeraci ? end_time : 1.0);
}

}  // namespace hydro::waves
