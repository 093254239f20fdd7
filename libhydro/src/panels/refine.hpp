#pragma once
/// \file  Smaller panels on the same faces. (G15), (G16) in docs/theory/panels.md. Not installed.
#include "panel_mesh.hpp"

namespace hydro::panels {

/// Every panel cut through the middles of its sides. Pieces of a panel follow each other, in the order of the panels.
PanelMesh refined(const PanelMesh& mesh);
/// How many a panel of so many corners is cut into: a triangle into four, others into as many as they have corners.
std::size_t pieces_when_refined(std::size_t corners);
/// Panels at edges cut along them `times` times over, so that those at the edge are 2^-times as wide.
PanelMesh graded(const PanelMesh& mesh, int times);

}  // namespace hydro::panels
