#pragma once
/// \file  Mean drift of single hulls, from potentials on their panels. (G23) in docs/theory/panels.md. Not installed.
#include "hydro/potential/body_drift.hpp"
#include "hydro/potential/wave_field.hpp"
#include "one_frequency.hpp"

namespace hydro::panels {

/// Of bodies that move as `question` says; `phi` as Model::in_wave() has them of the same wave. \throws InputError
/// where no upright surface parts two hulls: their outlines seen from above, made convex, overlap
potential::BodyDrift drift_of(const Model& model, const Water& water, const potential::FieldQuestion& question,
                              const Potentials& phi, int threads);

}  // namespace hydro::panels
