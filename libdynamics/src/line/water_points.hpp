#pragma once
/// \file  What the water does to a point of a segment, by Morison's equation. (D74)
#include <Eigen/Core>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "loads.hpp"
#include "triple.hpp"

namespace dynamics::line {

/// One point of a segment: where, what length of wet line it stands for, and what flows past.
struct WaterPoint {
  double s, length;
  Triple axis, water, relative, inertial;  // t, u, u − w, and y = (1 + C_A)ρA u̇ − C_A ρA ẇ
};

/// The share of a segment that is under water, its surface straight between heights g₀, g₁ above the ends.
inline std::array<double, 2> wet_interval(double g0, double g1) {
  if (g0 >= 0 && g1 >= 0) return {0, 1};
  if (g0 < 0 && g1 < 0) return {0, 0};
  const double at = g0 / (g0 - g1);
  return g0 < 0 ? std::array{at, 1.0} : std::array{0.0, at};
}

/// Both Gauss points of the wet part of segment j, along `axis`: exact for the added mass of a rod, of third order in
/// the drag.
FROUDE_INLINE std::array<WaterPoint, 2> points(const Line& line, int j, const Triple& axis, const PerLength& c,
                                               const Motion& now, const std::vector<Flow>& water) {
  const int first = line.first(j), second = first + 1;
  const Flow &k0 = water[static_cast<std::size_t>(first)], &k1 = water[static_cast<std::size_t>(second)];
  std::array<double, 2> wet{0, 1};
  if (line.description().water.wet == Wet::below_surface)
    wet = wet_interval(k0.elevation - now.x(2, first), k1.elevation - now.x(2, second));
  const double middle = (wet[0] + wet[1]) / 2, half = (wet[1] - wet[0]) / 2;
  const Triple u0 = Triple::of(k0.velocity), u1 = Triple::of(k1.velocity);
  const Triple w0 = column(now.v, first), w1 = column(now.v, second);
  const double moved = c.displaced + c.added;
  const Triple y0 = moved * Triple::of(k0.acceleration) - c.added * column(now.a, first),
               y1 = moved * Triple::of(k1.acceleration) - c.added * column(now.a, second);
  std::array<WaterPoint, 2> out;
  for (std::size_t g = 0; g < 2; ++g) {
    const double s = middle + (g == 0 ? -half : half) / std::numbers::sqrt3, r = 1 - s;
    const Triple u = r * u0 + s * u1;
    out[g] = {s, half * line.segment(j).length, axis, u, u - (r * w0 + s * w1), r * y0 + s * y1};
  }
  return out;
}

FROUDE_INLINE Triple drag(const PerLength& c, const WaterPoint& p) {
  const double along = p.axis.dot(p.relative);
  const Triple across = p.relative - along * p.axis;
  return c.normal * across.norm() * across + c.tangential * std::abs(along) * along * p.axis;
}

FROUDE_INLINE Triple inertia(const WaterPoint& p) { return p.inertial - p.axis.dot(p.inertial) * p.axis; }

/// Of drag and inertia per length: derivatives by u − w, and by the vector from the segment's first node to its second,
/// of this length, along which the axis turns. That of inertia by y is 1 − ttᵀ.
struct PointDerivatives {
  Eigen::Matrix3d by_relative = Eigen::Matrix3d::Zero(), by_turning = by_relative;

  FROUDE_INLINE PointDerivatives(const PerLength& c, const WaterPoint& p, double length) {
    const double along = p.axis.dot(p.relative);
    const Triple across = p.relative - along * p.axis;
    const double speed = across.norm(), normal = c.normal * speed, skin = c.tangential * std::abs(along);
    const double bent = speed > 0 ? c.normal / speed : 0;  // of |w| w by w, besides |w|; flat at w = 0
    add_unit(normal, by_relative);
    add_outer(bent, across, across, by_relative);
    add_outer(2 * skin - normal, p.axis, p.axis, by_relative);
    if (!(length > 0)) return;
    const double own = (skin * along - p.axis.dot(p.inertial) - along * normal) / length;
    const Triple row = (2 * skin - normal) * p.relative - p.inertial;
    add_unit(own, by_turning);
    add_outer(-own, p.axis, p.axis, by_turning);
    add_outer(-along * bent / length, across, across, by_turning);
    add_outer(1 / length, p.axis, row - p.axis.dot(row) * p.axis, by_turning);
  }
};

/// Adds to the blocks of segment j, which begins at node `first`, what a load at a point of it changes by with both
/// ends.
FROUDE_INLINE void spread(const WaterPoint& p, int j, int first, double by_first, double by_second,
                          const Eigen::Matrix3d& per_length, Blocks& out) {
  const double share[2] = {p.length * (1 - p.s), p.length * p.s};
  const auto at = static_cast<std::size_t>(j), node = static_cast<std::size_t>(first);
  add(share[0] * by_first, per_length, out.diagonal[node]);
  add(share[0] * by_second, per_length, out.upper[at]);
  add(share[1] * by_first, per_length, out.lower[at]);
  add(share[1] * by_second, per_length, out.diagonal[node + 1]);
}

}  // namespace dynamics::line
