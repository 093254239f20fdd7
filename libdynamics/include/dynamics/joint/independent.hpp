#pragma once
/// \file  Which rows of the constraints of joints are not held by others already.
#include "dynamics/joint/joint.hpp"

namespace dynamics {

/// One entry for each constraint: false if it is, to 1e-9 of its own size, made of others, the earlier of the scene
/// first. By sparse QR that tells the rank (SuiteSparseQR, Davis 2011), so that it costs as much as the joints couple.
/// `scale`: √ of the mass of each mode, in the metric of which sizes are seen.
std::vector<bool> independent(const JointSet& joints, const State& state, const Eigen::VectorXd& scale);

}  // namespace dynamics
