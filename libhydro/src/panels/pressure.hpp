#pragma once
/// \file  The pressure on hulls, from potentials on their panels. (G22) in docs/theory/panels.md. Not installed.
#include "hydro/potential/wave_field.hpp"
#include "one_frequency.hpp"

namespace hydro::panels {

/// Of bodies that move as `question` says, at the centres of all panels in all images; `phi` as Model::in_wave() has
/// them of the same wave.
potential::HullPressure pressure_of(const Model& model, const Water& water, const potential::FieldQuestion& question,
                                    const Potentials& phi);

}  // namespace hydro::panels
