#pragma once
/// \file  Private to compile/: what joins bodies to each other and to the ground.
#include "compile/compile.hpp"

namespace froude::compile {

/// From a body's centre of gravity to `end`, which is given from its origin in body axes, m; of the ground the point
/// itself, global.
Eigen::Vector3d arm(const scene::Scene& scene, std::optional<int> body, const Eigen::Vector3d& end);
/// Where the scene places that end, global, m.
Eigen::Vector3d placed(const scene::Scene& scene, std::optional<int> body, const Eigen::Vector3d& end);

/// Moorings, connectors, contacts, joints with what works on them, lines and constant loads, in the order of the scene;
/// `out.bodies` and `out.water` are there already.
void add_connections(const scene::Scene& scene, Prepared& out);

}  // namespace froude::compile
