#pragma once
/// \file  Loads on the parts that sections cut off from hulls. (G24), (G25) in docs/theory/panels.md. Not installed.
#include "one_frequency.hpp"

namespace hydro::panels {

/// W, (12 sections, all panels): load rows ∬ n dS, ∬ (x − x_ref) × n dS over what of each panel in each image is on the
/// part. Sections follow each other body by body; a panel that a plane cuts is divided at it. Then as many rows that
/// tell how far off that division may be, (G30).
Eigen::MatrixXd load_rows_of_parts(const PanelMesh& mesh, const std::vector<HullBody>& bodies);

/// A result whose loads on parts are as far off as the division of panels may leave them, (G30). `coarsest`: of the
/// first of the meshes that the result is extrapolated from.
OneFrequency with_division_doubted(const OneFrequency& result, const OneFrequency& coarsest);

/// Solution::parts of answers at the frequencies of `whole`, which is what was made of them. `mesh`: of `bodies`, of
/// any fineness.
potential::Coefficients loads_on_parts(const PanelMesh& mesh, const std::vector<HullBody>& bodies,
                                       const std::vector<OneFrequency>& results, const potential::Coefficients& whole);

/// \throws InputError as solve() for sections, where there are any
void require_parts_can_be_told(const std::vector<HullBody>& bodies, const Water& water, const Options& options);

}  // namespace hydro::panels
