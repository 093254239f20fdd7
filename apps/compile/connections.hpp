#pragma once
/// \file  Private to compile/: what joins bodies to each other and to the ground.
#include "compile/compile.hpp"

namespace froude::compile {

/// The point that a scene gives from a body's origin in body axes, or, of the ground, in global ones, m.
dynamics::PointOnBody point_on(const scene::Scene& scene, int body, const Eigen::Vector3d& at);
dynamics::Point point_on(const scene::Scene& scene, const std::optional<int>& body, const Eigen::Vector3d& at);
/// The same of two points.
dynamics::Ends ends_of(const scene::Scene& scene, const scene::PointPair& pair);
/// From the first to the second as the scene places them, global, m.
Eigen::Vector3d offset_of(const scene::Scene& scene, const scene::PointPair& pair);

/// Moorings, connectors, contacts, joints with what works on them, lines and constant loads, in the order of the scene;
/// `out.bodies` and `out.water` are there already.
void add_connections(const scene::Scene& scene, Prepared& out);

}  // namespace froude::compile
