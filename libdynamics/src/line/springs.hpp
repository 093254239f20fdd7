#pragma once
/// \file  Laws of segments and bed over one step, so that what they store is exactly what they took. (D72), (D75),
/// (D79)
#include <algorithm>
#include <cmath>

#include "dynamics/line/line.hpp"

namespace dynamics::line {

/// A force and its derivatives.
struct SpringDamperForce {
  double force, by_stretch, by_damper;
};

/// Mean force of a tension-only spring over a step between the stretches e₀ and e₁: ΔU/Δe, U = ½k max(e, 0)². (D79)
/// With e₀ = e₁ it is the spring's law.
inline SpringDamperForce one_sided_spring(double k, double e0, double e1) {
  if (e0 >= 0 && e1 >= 0) return {k * (e0 + e1) / 2, e0 == e1 ? k : k / 2, 0};
  if (e0 <= 0 && e1 <= 0) return {0, 0, 0};
  const double taut = std::max(e0, e1), change = e1 - e0;
  const double mean = k * taut * taut / (2 * std::abs(change));
  return {mean, e1 > e0 ? k * taut / change - mean / change : -mean / change, 0};
}

/// With a damper d beside it that never makes it push: S + S d/(S + |d|) (D51).
inline SpringDamperForce with_damper(const SpringDamperForce& spring, double d) {
  const double S = spring.force, sum = S + std::abs(d);
  if (!(S > 0)) return {0, 0, 0};
  return {S + S * d / sum, spring.by_stretch * (1 + d * std::abs(d) / (sum * sum)), S * S / (sum * sum)};
}

/// With a damper c beside it, at this rate of stretch; and what the damper takes, W.
struct DampedSpring {
  SpringDamperForce both;
  double lost;
};
inline DampedSpring damped_one_sided_spring(double k, double c, double e0, double e1, double rate) {
  const SpringDamperForce spring = one_sided_spring(k, e0, e1), both = with_damper(spring, c * rate);
  return {both, (both.force - spring.force) * rate};
}

/// What pulls in a segment that stretches, without its sag: the mean over a step between the stretches e₀ and e₁, of
/// whose change the mean follows the share `own`; with e₀ = e₁ and 1 its law. (D72)
inline DampedSpring axial_spring(const Segment& s, double e0, double e1, double own, double rate) {
  const double k = s.axial_stiffness / s.length, c = s.axial_damping / s.length;
  if (s.tension_only) return damped_one_sided_spring(k, c, e0, e1, rate);
  return {{k * (e0 + e1) / 2 + c * rate, own * k, 1}, c * rate * rate};
}

}  // namespace dynamics::line
