#pragma once
/// \file  Private to compile/: hulls that a scene shows to still water.
#include "compile/compile.hpp"

namespace froude::compile {

/// Reads meshes and fills `buoyancy` and notes of `prepared`, whose bodies and water are there already.
/// \throws hydro::InputError, placed in the scene: a mesh that is no hull, an opening under water at rest
void add_buoyancy(const scene::Scene& scene, Prepared& prepared);

/// What keeps bodies with buoyancy from floating as placed, one sentence each for those that are out of balance by more
/// than 1e-4 of their weight; empty if all float.
std::vector<std::string> out_of_balance(const Prepared& prepared);

}  // namespace froude::compile
