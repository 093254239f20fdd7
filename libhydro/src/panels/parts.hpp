#pragma once
/// \file  Loads on the parts that sections cut off from hulls. (G24), (G25) in docs/theory/panels.md. Not installed.
#include "one_frequency.hpp"

namespace hydro::panels {

/// W, (6 sections, all panels): load rows ∬ n dS, ∬ (x − x_ref) × n dS over what of each panel in each image is on the
/// part. Sections follow each other body by body; a panel that a plane cuts is divided at it.
Eigen::MatrixXd load_rows_of_parts(const PanelMesh& mesh, const std::vector<HullBody>& bodies);

/// Solution::parts of answers at the frequencies of `whole`, which is what was made of them. `mesh`: of `bodies`, of
/// any fineness.
potential::Coefficients loads_on_parts(const PanelMesh& mesh, const std::vector<HullBody>& bodies,
                                       const std::vector<OneFrequency>& results, const potential::Coefficients& whole);

/// \throws InputError as solve() for sections, where there are any
void require_parts_can_be_told(const std::vector<HullBody>& bodies, const Water& water, const Options& options);

}  // namespace hydro::panels
