#pragma once
/// \file  What a segment's own weight does between its nodes: it hangs through, and near the bed it rests in part.
/// (D88)
#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/line/line.hpp"

namespace dynamics::line {

/// A segment of unstretched length ℓ and weight w per length in water, with the heights of its ends above the bed.
struct Span {
  double length, weight;
  double height[2];  ///< +∞ without a bed
  double level;      ///< cos² of its slope
  double rounding;   ///< δ, heights below which lifting off is rounded, m
};

/// Of catenary segment j between places x, the sine of its slope given.
inline Span span_of(const Line& line, int j, const Eigen::Ref<const Places>& x, double slope) {
  const Segment& s = line.segment(j);
  constexpr double none = std::numeric_limits<double>::infinity();
  Span span{.length = s.length,
            .weight = line.sag_weight(j),
            .height = {none, none},
            .level = 1 - slope * slope,
            .rounding = 0};
  if (!s.meets_bed || line.description().bed.empty()) return span;
  const Bed& bed = line.description().bed.front();
  for (int i = 0; i < 2; ++i) span.height[i] = x(2, line.first(j) + i) - bed.z;
  span.rounding = 2 * span.weight / (bed.stiffness * s.diameter);  // twice the depth to which the line sinks
  return span;
}

/// How much shorter the chord is than the line, and what of the weight the bed takes off both ends, N; with
/// derivatives.
struct Sag {
  double shortening = 0, by_tension = 0, by_height[2] = {0, 0}, by_level = 0;
  double stored = 0;  ///< S of (D88), J
  double relief[2] = {0, 0}, relief_by_tension[2] = {0, 0}, relief_by_height[2][2] = {{0, 0}, {0, 0}};
};

template <bool derivatives = true>
[[gnu::always_inline]] inline Sag sag_of(const Span& s, double tension) {
  const double w = s.weight, l = s.length, T = std::max(tension, 1e-3 * w * l);
  Sag out;
  double g[2], root[2] = {1, 1}, q[2];
  // A parabola that leaves the bed level and is longer than the segment before it is as high as one end: no bed.
  const bool clear = 2 * T * std::max(s.height[0], s.height[1]) >= w * l * l;
  for (int i = 0; i < 2 && !clear; ++i) {
    root[i] = std::sqrt(s.height[i] * s.height[i] + s.rounding * s.rounding);
    g[i] = (s.height[i] + root[i]) / 2;
    q[i] = std::sqrt(2 * T * g[i] / w);  // what hangs at this end
  }
  if (clear || q[0] + q[1] >= l) {  // all of it hangs: w²ℓ³/24T²
    const double sag = w * w * l * l * l / (24 * T * T);
    out.shortening = sag * s.level;
    if constexpr (derivatives) {
      out.by_tension = -2 * out.shortening / T;
      out.by_level = sag;
      out.stored = -T * out.shortening;
    }
  } else {
    const double rise = g[1] - g[0];
    double sag = -rise * rise / (2 * l);
    for (int i = 0; i < 2; ++i) {
      const double part = q[i] * g[i] / (3 * T) * w, sign = i == 1 ? 1 : -1;
      sag += part;
      out.relief[i] = w * l / 2 - w * q[i] + sign * T * rise / l;
      if constexpr (!derivatives) continue;
      const double slope = (1 + s.height[i] / root[i]) / 2, other = (1 + s.height[1 - i] / root[1 - i]) / 2;
      out.stored += 2 * T * part * s.level - w * l * g[i] / 2;
      out.by_tension -= part / (2 * T) * s.level;
      out.by_height[i] = (w * q[i] / (2 * T) - sign * rise / l) * slope * s.level;
      out.relief_by_tension[i] = -w * q[i] / (2 * T) + sign * rise / l;
      out.relief_by_height[i][i] = (-w * q[i] / (2 * g[i]) + T / l) * slope;
      out.relief_by_height[i][1 - i] = -T / l * other;
    }
    out.shortening = sag * s.level;
    out.stored -= T * rise * rise / (2 * l) * s.level;
    out.by_level = sag;
  }
  if (tension < T) {  // held at the least tension
    out.by_tension = 0;
    out.relief_by_tension[0] = out.relief_by_tension[1] = 0;
  }
  return out;
}

}  // namespace dynamics::line
