#pragma once
/// \file  Simple hulls as closed meshes, with what they would displace if their triangles were not flat.
#include <Eigen/Core>

#include "hydro/hydrostatics/mesh.hpp"

namespace hydro::hydrostatics {

/// A box between two opposite corners, 12 triangles, exact. \throws InputError unless low < high in x, y and z
TriangleMesh box_mesh(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

/// A cylinder about a vertical axis from z = bottom to z = top, `segments` (>= 3) flat walls whose edges are on the
/// true surface. Its volume and areas of section are short by the factor sin(α)/α, α = 2π/segments (H3). \throws
/// InputError
TriangleMesh cylinder_mesh(const Eigen::Vector2d& centre, double radius, double bottom, double top, int segments);

/// A sphere with vertices on the true surface: an octahedron whose edges are cut `cuts` (>= 0) times in halves;
/// 8·4^cuts triangles. Volume is short by O(4^−cuts) (H3). \throws InputError
TriangleMesh sphere_mesh(const Eigen::Vector3d& centre, double radius, int cuts);

/// Several meshes as one hull; no attempt is made to merge what overlaps.
TriangleMesh joined(std::vector<TriangleMesh> meshes);

}  // namespace hydro::hydrostatics
