#pragma once
/// \file  Hulls that several tests share, as triangles of plane quadrilaterals.
#include <cmath>
#include <functional>
#include <numbers>

#include "hydro/panels/solve.hpp"

namespace hydro::panels {

/// A closed surface from a grid of points: point(i, j), i from 0 to rows, j around from 0 to columns. Rows that
/// shrink to a point lose one triangle of each pair.
inline hydrostatics::Hull surface_of_revolution(int rows, int columns,
                                                const std::function<Eigen::Vector2d(int)>& profile,
                                                const Eigen::Vector2d& centre = {0, 0}) {
  hydrostatics::TriangleMesh mesh{.source = "test", .vertices = {}, .triangles = {}};
  for (int i = 0; i <= rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double angle = 2 * std::numbers::pi * j / columns;
      const Eigen::Vector2d p = profile(i);  // radius, z
      mesh.vertices.emplace_back(centre.x() + p.x() * std::cos(angle), centre.y() + p.x() * std::sin(angle), p.y());
    }
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const int a = i * columns + j, b = i * columns + (j + 1) % columns, c = a + columns, d = b + columns;
      mesh.triangles.push_back({a, c, b});
      mesh.triangles.push_back({b, c, d});
    }
  return hydrostatics::Hull(hydrostatics::welded(std::move(mesh), 1e-9));
}

/// A hemisphere open at z = 0: parallels and meridians in equal angles, scaled to the volume of the sphere.
inline hydrostatics::Hull hemisphere(double radius, int rows, int columns) {
  const auto with = [&](double a) {
    return surface_of_revolution(rows, columns, [=](int i) {
      const double polar = std::numbers::pi / 2 * (1 + static_cast<double>(i) / rows);
      return Eigen::Vector2d(i == rows ? 0 : a * std::sin(polar), i == 0 ? 0 : a * std::cos(polar));
    });
  };
  const double volume = with(radius).volume(), exact = 2 * std::numbers::pi / 3 * std::pow(radius, 3);
  return with(radius * std::cbrt(exact / volume));
}

/// A vertical cylinder open at z = 0, of the cross-section's area; panels are finer towards the edge and the surface.
inline hydrostatics::Hull cylinder(double radius, double draught, int side, int bottom, int columns,
                                   const Eigen::Vector2d& centre = {0, 0}) {
  const double angle = 2 * std::numbers::pi / columns, a = radius * std::sqrt(angle / std::sin(angle));
  return surface_of_revolution(
      side + bottom, columns,
      [=](int i) {
        const double pi = std::numbers::pi;
        if (i <= side) return Eigen::Vector2d(a, i == 0 ? 0 : -draught * (1 - std::cos(pi * i / side)) / 2);
        const double t = static_cast<double>(i - side) / bottom;
        return Eigen::Vector2d(i == side + bottom ? 0 : a * std::cos(pi / 2 * t), -draught);
      },
      centre);
}

}  // namespace hydro::panels
