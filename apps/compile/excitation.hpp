#pragma once
/// \file  Private to compile/: loads of the incoming waves by coefficients.
#include "compile/compile.hpp"
#include "compile/signals.hpp"

namespace froude::compile {

/// Adds the excitation that bodies name: of bodies as they are placed, and of those that turn. \throws
/// hydro::InputError, at its place, if bodies that feel each other's waves are to turn, or the data lack a heading
void add_excitation(const scene::Scene& scene, const Prepared& prepared, const hydro::waves::Sea& sea,
                    const StepGrid& grid, std::vector<std::unique_ptr<const dynamics::ForceKind>>& forces);

}  // namespace froude::compile
