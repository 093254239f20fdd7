#pragma once
/// \file  What the water does to a point of a segment, by Morison's equation. (D74)
#include <Eigen/Core>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "loads.hpp"

namespace dynamics::line {

/// One point of a segment: where, what length of wet line it stands for, and what flows past.
struct WaterPoint {
  double s, length;
  Eigen::Vector3d axis, water, relative, inertial;  // t, u, u − w, and y = (1 + C_A)ρA u̇ − C_A ρA ẇ
};

/// The share of a segment that is under water, its surface straight between heights g₀, g₁ above the ends.
inline std::array<double, 2> wet_interval(double g0, double g1) {
  if (g0 >= 0 && g1 >= 0) return {0, 1};
  if (g0 < 0 && g1 < 0) return {0, 0};
  const double at = g0 / (g0 - g1);
  return g0 < 0 ? std::array{at, 1.0} : std::array{0.0, at};
}

/// Both Gauss points of the wet part of segment j: exact for the added mass of a rod, of third order in the drag.
inline std::array<WaterPoint, 2> points(const Line& line, int j, const PerLength& c, const Motion& now,
                            const std::vector<Flow>& water) {
  const Segment& segment = line.segment(j);
  const int first = line.first(j), second = first + 1;
  const Eigen::Vector3d axis = (now.x.col(second) - now.x.col(first)).normalized();
  const auto& k0 = water[static_cast<std::size_t>(first)];
  const auto& k1 = water[static_cast<std::size_t>(second)];
  std::array<double, 2> wet{0, 1};
  if (line.description().water.wet == Wet::below_surface)
    wet = wet_interval(k0.elevation - now.x(2, first), k1.elevation - now.x(2, second));
  std::array<WaterPoint, 2> out;
  const double middle = (wet[0] + wet[1]) / 2, half = (wet[1] - wet[0]) / 2;
  for (std::size_t g = 0; g < 2; ++g) {
    WaterPoint& p = out[g];
    p.s = middle + (g == 0 ? -half : half) / std::numbers::sqrt3;
    p.length = half * segment.length;
    p.axis = axis;
    const double r = 1 - p.s, s = p.s;
    p.water = r * k0.velocity + s * k1.velocity;
    p.relative = p.water - r * now.v.col(first) - s * now.v.col(second);
    p.inertial = (c.displaced + c.added) * (r * k0.acceleration + s * k1.acceleration) -
                 c.added * (r * now.a.col(first) + s * now.a.col(second));
  }
  return out;
}

inline Eigen::Vector3d drag(const PerLength& c, const Eigen::Vector3d& axis, const Eigen::Vector3d& relative) {
  const double along = axis.dot(relative);
  const Eigen::Vector3d across = relative - along * axis;
  return c.normal * across.norm() * across + c.tangential * std::abs(along) * along * axis;
}

/// Of y or of what is to become part of it.
inline Eigen::Vector3d inertia(const Eigen::Vector3d& axis, const Eigen::Vector3d& inertial) {
  return inertial - axis * axis.dot(inertial);
}

/// Derivatives of drag and inertia per length by u − w, by y and by t.
struct PointDerivatives {
  Eigen::Matrix3d by_relative, by_inertial, by_axis;

  PointDerivatives(const PerLength& c, const WaterPoint& p) {
    using Eigen::Matrix3d;
    const Matrix3d outer = p.axis * p.axis.transpose(), P = Matrix3d::Identity() - outer;
    const double along = p.axis.dot(p.relative);
    const Eigen::Vector3d across = p.relative - along * p.axis;
    const double speed = across.norm(), normal = c.normal * speed, skin = c.tangential * std::abs(along);
    // Of normal |w| w by w, which is across the axis: its product with the axis is normal times the axis.
    Matrix3d by_across = normal * Matrix3d::Identity();
    if (speed > 0) by_across += (c.normal / speed) * across * across.transpose();  // flat at w = 0
    by_relative = by_across + (2 * skin - normal) * outer;
    by_inertial = P;
    by_axis = (skin * along - p.axis.dot(p.inertial)) * Matrix3d::Identity() - along * by_across +
              p.axis * ((2 * skin - normal) * p.relative - p.inertial).transpose();
  }
  /// By the vector from the segment's first node to its second, of this length.
  Eigen::Matrix3d by_turning(const Eigen::Vector3d& axis, double length) const {
    if (!(length > 0)) return Eigen::Matrix3d::Zero();
    const Eigen::Vector3d along = by_axis * axis;
    return 1 / length * (by_axis - along * axis.transpose());
  }
};

/// Adds to the blocks of segment j, which begins at node `first`, what a load per length at a point changes by with both ends.
inline void spread(const WaterPoint& p, int j, int first, const Eigen::Matrix3d& by_first, const Eigen::Matrix3d& by_second,
                   Blocks& out) {
  const double share[2] = {p.length * (1 - p.s), p.length * p.s};
  const auto at = static_cast<std::size_t>(j), node = static_cast<std::size_t>(first);
  out.diagonal[node] += share[0] * by_first;
  out.upper[at] += share[0] * by_second;
  out.lower[at] += share[1] * by_first;
  out.diagonal[node + 1] += share[1] * by_second;
}

}  // namespace dynamics::line
