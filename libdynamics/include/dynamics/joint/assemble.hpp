#pragma once
/// \file  Bringing bodies to where their joints close.
#include <vector>

#include "dynamics/model/model.hpp"

namespace dynamics {

/// Moves and turns the bodies that are not `placed` (one entry a body) until every joint is closed to round-off, by the
/// smallest displacements in the metric of their own masses that Newton finds at each of its steps (D18). Does nothing
/// where all are closed already, and stops after some steps where joints cannot be closed that way: an integrator's
/// start then names the joint.
void close_joints(const Model& model, const std::vector<bool>& placed, State& state);

/// The same for velocities: those of the bodies that are not `given` change by the least that keeps joints closed.
void close_joint_velocities(const Model& model, const std::vector<bool>& given, State& state);

}  // namespace dynamics
