#pragma once
/// \file  What is seen from above of bodies that make waves: where they pierce the still water, and the plan of those
/// under it.
#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

#include "hydro/hydrostatics/mesh.hpp"
#include "scene/scene.hpp"

namespace froude::view {

using Segment = std::array<Eigen::Vector2d, 2>;  ///< x and y of both ends, global, m

struct Outline {
  std::string body;
  std::vector<Segment> pierced;    ///< cuts with the still water
  std::vector<Segment> submerged;  ///< the plan of parts that lie under it
};

/// Where a mesh [m, global] cuts z = 0; vertices within 1e-6 of its diagonal lie in it. A face that lies in z = 0 has
/// no edge of its own. Empty if nothing pierces the surface.
std::vector<Segment> waterline_of(const hydro::hydrostatics::TriangleMesh& mesh);
/// Edges between faces that are seen from above and faces that are not, and those of one face alone.
std::vector<Segment> plan_of(const hydro::hydrostatics::TriangleMesh& mesh);

/// Of each body with [body.hydrodynamics] of cylinders or a mesh, as the scene places it.
/// \throws hydro::InputError if a mesh cannot be read
std::vector<Outline> outlines_of(const scene::Scene& scene);

}  // namespace froude::view
