#pragma once
/// \file  Private to compile/: what joins bodies to each other and to the ground.
#include "compile/compile.hpp"

namespace froude::compile {

/// Moorings, connectors, contacts, joints with what works on them, lines and constant loads, in the order of the scene;
/// `out.bodies` and `out.water` are there already.
void add_connections(const scene::Scene& scene, Prepared& out);

}  // namespace froude::compile
