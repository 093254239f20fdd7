#pragma once
/// \file  Controllers of the caller's on sliders and hinges of a scene, as froude/control.hpp has them on connectors.
#include <functional>
#include <optional>
#include <string>

#include "dynamics/force/commanded_force.hpp"
#include "froude/control.hpp"

namespace froude {

/// What the controller of a joint may read: one of the joints that its name stands for, now.
struct JointSample {
  const Sample& run;
  const std::string& joint;
  double coordinate;  ///< m, "NAME.stroke" of a slider, or rad, "NAME.angle" of a hinge
  double rate;        ///< m/s or rad/s
};

/// A controller that sets the force of sliders, or the moment of hinges, against their coordinates: positive where it
/// resists a positive coordinate, as "NAME.pto_force". From when it first says something it takes the place of spring,
/// damper and preload of a [joint.pto]; force_limit, stops and latch stay. Without a [joint.pto] nothing bounds it.
struct JointControl {
  std::string joints;  ///< a name; * stands for any characters
  /// Called where the run begins and at the end of each step, for each joint in the order of the scene: what acts from
  /// now on, or nothing to leave it. A force alone is held through the next step; with slopes it follows the motion
  /// within the step. Of hydro::NumericsError, and of what is not finite, the run ends with the reason and keeps what
  /// it has; what else is thrown comes out of the run.
  std::function<std::optional<dynamics::Command>(const JointSample&)> decide;
};

}  // namespace froude
