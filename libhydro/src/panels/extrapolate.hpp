#pragma once
/// \file  Values of panels of no size from those of meshes, each with all panels of the one before cut in four, and
/// what is left of the error. (G16), (G17) in docs/theory/panels.md. Not installed.
#include <vector>

#include "discretisation.hpp"

namespace hydro::panels {

/// a + s b, entry by entry.
OneFrequency sum(const OneFrequency& a, double s, const OneFrequency& b);

Extrapolated sum(const Extrapolated& a, double s, const Extrapolated& b);

/// What is added to the finest of two or three meshes, coarse to fine, and how much of that is doubtful.
Extrapolated step_to_the_limit(const std::vector<const Extrapolated*>& coarse_to_fine);
Eigen::MatrixXd step_to_the_limit(const std::vector<Eigen::MatrixXd>& coarse_to_fine);
/// The error that is left, as a share of the step.
double doubtful_share(std::size_t meshes);
/// The same for loads on parts, which fall less evenly, (G28).
double doubtful_share_of_parts(std::size_t meshes);

/// Of A, B, B_far, X, X_far, and perhaps A, B and X of parts, at rising frequencies: what damping and excitation have
/// been at most so far, √(B_ii B_jj) and the row of X; for A ones. (G17)
std::vector<Extrapolated> scales_of_waves(const std::vector<const Extrapolated*>& solved);

/// Weights of values at `nodes` (rising) in the cubic through the four nearest to x, or all if they are fewer; the node
/// `without` is not used (−1: all are).
std::vector<double> cubic_weights(const std::vector<double>& nodes, double x, int without = -1);

}  // namespace hydro::panels
