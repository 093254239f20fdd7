#pragma once
/// \file  The surface about hulls, from potentials on their panels. (G21) in docs/theory/panels.md. Not installed.
#include <vector>

#include "hydro/potential/wave_field.hpp"
#include "one_frequency.hpp"

namespace hydro::panels {

/// True for each point that is outside of the waterlines of all hulls of the mesh.
std::vector<bool> outside(const PanelMesh& mesh, const Eigen::MatrixX2d& point);

/// By Green's theorem over all panels, from potentials that are solved for here. Points that are not outside() are not
/// told. `threads`: which share the points.
potential::WaveField field_of(const Model& model, const Water& water, const potential::FieldQuestion& question,
                              int threads);

}  // namespace hydro::panels
