#pragma once
/// \file  Private to compile/: from the files that a scene names to coefficients about centres of gravity, in place.
#include <string>
#include <vector>

#include "compile/compile.hpp"

namespace froude::compile {

/// Fills groups, hydrostatics, memory and notes of `prepared`, whose bodies are there already.
void add_hydrodynamics(const scene::Scene& scene, Prepared& prepared);

/// "m1, m2 and m3", the first of many.
std::string listed_bodies(const scene::Scene& scene, const std::vector<int>& bodies);

}  // namespace froude::compile
