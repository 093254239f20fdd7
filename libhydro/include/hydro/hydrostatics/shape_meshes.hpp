#pragma once
/// \file  Simple hulls as meshes of so many panels: bodies of revolution and boxes.
///
/// Lengths in m. Panels are flat quadrilaterals, two triangles each, or triangles at an axis. A hull that reaches
/// z = 0 from below is open there. Faces of a body of revolution are flat, so its radius is enlarged until the polygon
/// has the area, or the hull the volume, of the round body: what waves feel is then second-order in the faceting.
#include <array>
#include <vector>

#include "hydro/hydrostatics/mesh.hpp"

namespace hydro::hydrostatics {

/// How a length is divided: alike, or by cosine, which makes parts small at both ends.
enum class Spacing { equal, cosine };

/// Radius over that of the circle whose area a regular polygon of so many corners has.
double polygon_radius(int corners);

/// The surface that a line makes that is turned about the vertical through `centre`: `profile` holds its corners,
/// radius of the polygon's corners and z, from the top down; radius 0 is allowed at the ends. \throws InputError unless
/// there are two points and three columns at least, radii are not negative and all is finite
TriangleMesh revolved(const std::vector<Eigen::Vector2d>& profile, int columns, const Eigen::Vector2d& centre = {0, 0});

/// A hemisphere below z = 0, of the volume of the round one: parallels and meridians in equal angles.
/// \throws InputError unless radius, rows and columns are positive, columns three at least
TriangleMesh hemisphere_mesh(double radius, int rows, int columns);

/// A vertical cylinder from z = 0 to −draught, of the cross-section of the round one. `side` and `bottom` rows, by
/// cosine: finer at the edge and at the surface. \throws InputError as hemisphere_mesh()
TriangleMesh cylinder_mesh(double radius, double draught, int side, int bottom, int columns,
                           const Eigen::Vector2d& centre = {0, 0});

/// A box with sides along the axes and so many panels along x, y and z; without a lid if it ends at z = 0.
/// \throws InputError unless `low` is below `high` in each direction and there is a panel in each
TriangleMesh box_mesh(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const std::array<int, 3>& panels,
                      Spacing spacing = Spacing::cosine);

}  // namespace hydro::hydrostatics
