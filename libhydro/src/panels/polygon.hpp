#pragma once
/// \file  Rankine's potential of flat polygons, in closed form. (G1), (G2) in docs/theory/panels.md. Not installed.
#include <Eigen/Core>

#include <vector>

namespace hydro::panels {

/// A flat convex polygon, anticlockwise seen from the side that `normal` points to.
struct Polygon {
  std::vector<Eigen::Vector3d> corners;
  Eigen::Vector3d centre;  ///< of its area
  Eigen::Vector3d normal;  ///< of unit length
  double area;             ///< m²
  double size;             ///< greatest distance of two corners, m
};
Polygon polygon(std::vector<Eigen::Vector3d> corners);

/// ∬ 1/r dS and ∬ ∂(1/r)/∂n_Q dS over a polygon, r from a point P.
struct Rankine {
  double source = 0;  ///< m
  double dipole = 0;  ///< the solid angle, positive on the side of the normal; 0 in the plane of the polygon
};
/// Exact to rounding at any P, on corners and edges too.
Rankine rankine(const Polygon& polygon, const Eigen::Vector3d& P);

}  // namespace hydro::panels
