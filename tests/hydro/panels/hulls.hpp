#pragma once
/// \file  Hulls of meshes at their places, for tests of what is told about them.
#include <string>
#include <utility>

#include "hydro/panels/solve.hpp"

namespace hydro::panels {

/// A body whose mesh has its point of reference at the origin, moved to `at`; without a centre of gravity.
inline HullBody body(std::string name, hydrostatics::TriangleMesh mesh, const Eigen::Vector3d& at) {
  for (Eigen::Vector3d& v : mesh.vertices) v += at;
  return {std::move(name), at, {}, hydrostatics::Hull(std::move(mesh))};
}

}  // namespace hydro::panels
