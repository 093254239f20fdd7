#pragma once
/// \file  Bringing bodies to where their joints close.
#include <optional>
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

/// How a constraint of a joint is not met: by metres, or by the sine of an angle.
struct Misfit {
  int joint;
  double off;      ///< m, or 1 of angles; of velocities per second
  bool of_angle;   ///< the constraint is on directions, or on the angle of a hinge with prescribed motion
  double allowed;  ///< what the digits of a scene may leave
};
/// The constraint that is worst met, by its share of what is allowed: 1e-6 of directions, and of places 1e-6 m, or 1e-6
/// of the distance between the joint and its bodies' centres where that is above a metre. Empty without joints.
std::optional<Misfit> worst_misfit(const Model& model, const State& state);
/// The same of velocities: 1e-6 of the speeds that the bodies have where they are joined.
std::optional<Misfit> worst_misfit_of_velocities(const Model& model, const State& state);

}  // namespace dynamics
