#pragma once
/// \file  The water's surface about hulls in a regular wave.
#include <vector>

#include "hydro/panels/solve.hpp"
#include "hydro/potential/wave_field.hpp"

namespace hydro::panels {

/// Elevations about `bodies`, (G21): by Green's theorem where all panels are solved together, with panels cut in four;
/// by the partial waves that hulls send out where each kind is solved by itself, and then nothing is told within the
/// circle about a hull. Nothing is told inside a waterline. `estimate` is what cutting panels in four has changed, with
/// what more partial waves change; within a panel's size of a hull it is large. The first panels are those of the
/// meshes, cut in four until waves allow them; with a tolerance in `options` partial waves are chosen by it. \throws
/// InputError as solve(), and as potential::check(); if pressures are asked for of hulls that partial waves join. These
/// are of the finer panels, (G22). With `drift` that of each body by itself, (G23); where hulls stand over each other
/// or their outlines, made convex, overlap, it is refused
potential::WaveField wave_field(const std::vector<HullBody>& bodies, const Water& water,
                                const potential::FieldQuestion& question, const Options& options = {});

}  // namespace hydro::panels
