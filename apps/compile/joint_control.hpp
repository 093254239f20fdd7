#pragma once
/// \file  Private to apps: what sets the forces of joints in a run.
#include <memory>
#include <vector>

#include "compile/sample.hpp"
#include "dynamics/force/commanded_force.hpp"
#include "froude/joint_control.hpp"

namespace froude::compile {

/// A joint whose force a controller of the caller's sets.
struct RuledJoint {
  dynamics::Pto pto;  ///< what the scene has there
  std::shared_ptr<const JointControl> control;
};

/// Puts the controllers of the caller's in: their joints become elements of one dynamics::CommandedForceKind, in the
/// order of what is returned. \throws hydro::InputError if no joint has the name or two controls have it; if a joint
/// is no slider or hinge, or its motion is prescribed
std::vector<RuledJoint> set_joint_controllers(const scene::Scene& scene, const std::vector<JointControl>& controls,
                                              Prepared& prepared);

/// What rules the joints of one run. Of the signals it reads those that are asked for.
class JointControllers {
 public:
  JointControllers(std::vector<RuledJoint> joints, const std::vector<Signal>& signals);
  /// Sets the forces where the run begins, or at the end of a step. \returns true if loads have jumped by it.
  /// \throws hydro::InputError if a signal is asked for that there is not, hydro::NumericsError at what is not finite
  bool decide(const Moment& now) const;
  bool empty() const { return joints_.empty(); }

 private:
  std::vector<RuledJoint> joints_;
  std::shared_ptr<const SignalsByName> signals_;
};

}  // namespace froude::compile
