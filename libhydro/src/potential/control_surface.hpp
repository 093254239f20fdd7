#pragma once
/// \file  Upright surfaces about bodies, through which momentum goes. (P41) in docs/theory/conventions.md. Not
/// installed.
#include <Eigen/Core>

#include <complex>
#include <vector>

namespace hydro::potential {

/// A point of a surface as it is seen from above.
struct ControlPoint {
  Eigen::Vector2d at;      ///< global, m
  Eigen::Vector2d normal;  ///< of unit length, out of the surface
  double length;           ///< of the line that it stands for, m
};

/// So many points on a circle, evenly spaced.
std::vector<ControlPoint> circle(const Eigen::Vector2d& centre, double radius, int count);

/// The line at `distance` about a convex polygon, whose corners go anticlockwise: edges moved outwards and arcs about
/// corners, by Gauss's rule of four points on pieces of `longest` at most. Two corners are a plate.
std::vector<ControlPoint> line_about(const std::vector<Eigen::Vector2d>& polygon, double distance, double longest);

/// What goes through a point of the line in, on average over a period, less what goes out of it: force along x and y
/// and moment about the vertical at `about`, for the density ρ. The momentum of the water is −½ρ Re(∇φ ∂φ*/∂n) with the
/// slopes of φ along the water; `normal_part`, along the inward normal with the opposite sign, is all that pushes.
Eigen::Vector3d load_through(const ControlPoint& point, const Eigen::Vector2d& about, double density,
                             const Eigen::Vector2cd& slope, double normal_part);

}  // namespace hydro::potential
