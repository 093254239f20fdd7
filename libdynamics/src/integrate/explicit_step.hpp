#pragma once
/// \file  What explicit integrators share. Not installed.
#include "dynamics/integrate/integrator.hpp"

namespace dynamics {

/// Contacts need constraints on places that hold at the end of a step. \throws hydro::InputError
void refuse_contacts(const ActiveSet& active);

/// Rate of the displacement (places, and rotation vectors since the start of the step) with a velocity there.
Eigen::VectorXd displacement_rate(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity);
/// The same, into a vector that has room.
void find_displacement_rate(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity, Eigen::VectorXd& out);

/// Joints closed by the least motion, then the accelerations there; the workspace ends in that state, `end` in that
/// which the workspace had. \returns false, with the workspace as it was, if they cannot be had
bool arrive(const Model& model, const ActiveSet& active, State& end, Workspace& workspace);

}  // namespace dynamics
