#pragma once
/// \file  What the water does to a point of a segment, by Morison's equation. (D74)
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "loads.hpp"
#include "triple.hpp"

namespace dynamics::line {

/// One point of a segment: where, what length of wet line it stands for, by how much that grows per metre that the
/// point goes down, and what flows past.
struct WaterPoint {
  double s, length, by_depth;
  Triple axis, water, relative, inertial;  // t, u, u − w, and y = (1 + C_A)ρA u̇ − C_A ρA ẇ
};

/// The part of a segment above whose ends the surface, straight between them, is by more than a level: g₀, g₁ the
/// heights of the surface above that level.
inline std::array<double, 2> wet_interval(double g0, double g1) {
  if (g0 >= 0 && g1 >= 0) return {0, 1};
  if (g0 < 0 && g1 < 0) return {0, 0};
  const double at = g0 / (g0 - g1);
  return g0 < 0 ? std::array{at, 1.0} : std::array{0.0, at};
}

/// The share of a circular section that is wet where its axis is d radii below the surface, and its derivative. (D158)
struct WetShare {
  double share, by_d;

  explicit WetShare(double d) {
    const double within = std::clamp(d, -1.0, 1.0), chord = std::sqrt(1 - within * within);
    share = 0.5 + (within * chord + std::asin(within)) / std::numbers::pi;
    by_d = 2 * chord / std::numbers::pi;
  }
};

/// A stretch of a segment that is wet whole, or whose section the surface cuts.
struct Stretch {
  double from = 0, to = 0;            // shares of the length
  double depth = 1, depth_along = 0;  // of its axis in radii where s = 0, and by s
  double radius = 0;                  // m; 0: wet whole

  bool is_cut() const { return radius > 0; }
  double depth_at(double s) const { return depth + depth_along * s; }
};

/// What of segment j is wet: where the surface cuts its section, that stretch; and what is under water whole. A line
/// that floats level has a lift that way, not all or nothing. (D158)
inline std::array<Stretch, 2> wet_stretches(const Line& line, int j, const Motion& now,
                                            const std::vector<Flow>& water) {
  if (line.description().water.wet != Wet::below_surface) return {Stretch{.from = 0, .to = 1}, Stretch{}};
  const int first = line.first(j);
  const double g0 = water[static_cast<std::size_t>(first)].elevation - now.x(2, first),
               g1 = water[static_cast<std::size_t>(first) + 1].elevation - now.x(2, first + 1),
               radius = line.segment(j).diameter / 2;
  const auto whole = wet_interval(g0 - radius, g1 - radius), any = wet_interval(g0 + radius, g1 + radius);
  const Stretch under{.from = whole[0], .to = whole[1]};
  if (!(radius > 0)) return {under, Stretch{}};
  const bool none = whole[0] == whole[1];
  return {under, Stretch{.from = none || g0 < g1 ? any[0] : whole[1],
                         .to = none || g0 >= g1 ? any[1] : whole[0],
                         .depth = g0 / radius,
                         .depth_along = (g1 - g0) / radius,
                         .radius = radius}};
}

/// The wet shares of a cut section at two points of a stretch, their derivatives brought to where they have the change
/// of the share from its one end to the other between them: a root at both ends of the cut is beyond Gauss.
inline std::array<WetShare, 2> wet_shares(const Stretch& wet, const std::array<double, 2>& s) {
  std::array<WetShare, 2> out{WetShare(wet.depth_at(s[0])), WetShare(wet.depth_at(s[1]))};
  const double begins = wet.depth_at(wet.from), ends = wet.depth_at(wet.to), mean = (out[0].by_d + out[1].by_d) / 2;
  if (std::abs(ends - begins) < 1e-3 || !(mean > 0)) return out;  // so short of a cut that Gauss is exact
  const double between = (WetShare(ends).share - WetShare(begins).share) / (ends - begins);
  for (WetShare& w : out) w.by_d *= between / mean;
  return out;
}

/// Both Gauss points of a stretch of segment j, along `axis`: exact for the added mass of a rod and for what lifts
/// where it is wet whole, of third order in the drag.
FROUDE_INLINE std::array<WaterPoint, 2> points(const Line& line, int j, const Stretch& wet, const Triple& axis,
                                               const PerLength& c, const Motion& now, const std::vector<Flow>& water) {
  const int first = line.first(j), second = first + 1;
  const Flow &k0 = water[static_cast<std::size_t>(first)], &k1 = water[static_cast<std::size_t>(second)];
  const double middle = (wet.from + wet.to) / 2, half = (wet.to - wet.from) / 2;
  const Triple u0 = Triple::of(k0.velocity), u1 = Triple::of(k1.velocity);
  const Triple w0 = column(now.v, first), w1 = column(now.v, second);
  const double moved = c.displaced + c.added;
  const Triple y0 = moved * Triple::of(k0.acceleration) - c.added * column(now.a, first),
               y1 = moved * Triple::of(k1.acceleration) - c.added * column(now.a, second);
  const std::array<double, 2> at{middle - half / std::numbers::sqrt3, middle + half / std::numbers::sqrt3};
  double share[2] = {1, 1}, by_depth[2] = {0, 0};
  if (wet.is_cut()) {
    const auto cut = wet_shares(wet, at);
    for (std::size_t g = 0; g < 2; ++g) share[g] = cut[g].share, by_depth[g] = cut[g].by_d / wet.radius;
  }
  std::array<WaterPoint, 2> out;
  for (std::size_t g = 0; g < 2; ++g) {
    const double s = at[g], r = 1 - s;
    const Triple u = r * u0 + s * u1;
    const double length = half * line.segment(j).length;
    out[g] = {s, share[g] * length, by_depth[g] * length, axis, u, u - (r * w0 + s * w1), r * y0 + s * y1};
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

/// The same of what a load f per length changes by where its point goes up or down through the surface.
FROUDE_INLINE void spread_rise(const WaterPoint& p, int j, int first, double by_place, const Triple& f, Blocks& out) {
  Eigen::Matrix3d rising = Eigen::Matrix3d::Zero();
  f.put(rising.data() + 6);
  const WaterPoint rate{.s = p.s,
                        .length = -by_place * p.by_depth,
                        .by_depth = 0,
                        .axis = {},
                        .water = {},
                        .relative = {},
                        .inertial = {}};
  spread(rate, j, first, 1 - p.s, p.s, rising, out);
}

}  // namespace dynamics::line
