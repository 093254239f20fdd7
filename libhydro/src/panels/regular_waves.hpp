#pragma once
/// \file  Partial waves that are regular at the axis of a hull: what arrives from its neighbours. (G18) in
/// docs/theory/panels.md. Not installed.
#include <Eigen/Core>

#include "cylinders/groups.hpp"

namespace hydro::panels {

/// S_n(r) Z_n(z) e^{imθ} of (C4) about the vertical axis through the origin, one column a channel in WaveIndex's order.
struct RegularWaves {
  Eigen::MatrixXcd value;  ///< (points, channels)
  Eigen::MatrixXcd slope;  ///< along the normals, 1/m
};

/// At `point` (points, 3), with slopes along `normal` (points, 3). `radius`: of the circle that scales belong to. The
/// wave's columns are zero where there is no wave (ω → ∞). Within 1e-12 of the largest value of each column.
RegularWaves regular_waves(const Eigen::MatrixXd& point, const Eigen::MatrixXd& normal,
                           const cylinders::VerticalModes& modes, double radius, const cylinders::Channels& channels);

}  // namespace hydro::panels
