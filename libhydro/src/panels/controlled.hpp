#pragma once
/// \file  Refinement until an error is met. (G16), (G17) in docs/theory/panels.md. Not installed.
#include <optional>
#include <vector>

#include "one_frequency.hpp"

namespace hydro::panels {

/// What a solution is filled from.
struct Work {
  std::vector<OneFrequency> results;  ///< of each frequency
  Eigen::MatrixXd A_inf;
  std::optional<Eigen::MatrixXd> A_zero;  ///< deep water only
  SelfCheck check;
};

/// Values of panels of no size on the faces of `given`, to the tolerance of `options`. `least` is the length of
/// a panel that the shortest wave allows.
/// \throws InputError with the numbers if the tolerance cannot be met
Work controlled_work(const PanelMesh& given, const std::vector<HullBody>& bodies, const Water& water,
                     const std::vector<double>& omega, const std::vector<double>& heading, const Options& options);

/// The coarsest mesh that an error is controlled with: at edges panels are a quarter as wide as those of `given`, and
/// no panel that waves reach is longer than they allow.
PanelMesh first_mesh(const PanelMesh& given, const Water& water, double highest);
/// At how many frequencies meshes are refined at first.
int first_samples(const Options& options);

}  // namespace hydro::panels
