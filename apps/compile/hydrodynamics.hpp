#pragma once
/// \file  Private to compile/: from the files that a scene names to coefficients about centres of gravity, in place.
#include "compile/compile.hpp"

namespace froude::compile {

/// Fills groups, hydrostatics, memory and notes of `prepared`, whose bodies are there already.
void add_hydrodynamics(const scene::Scene& scene, Prepared& prepared);

}  // namespace froude::compile
