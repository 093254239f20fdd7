#pragma once
/// \file  Bodies that were measured, as a start that their joints allow.
#include <map>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace froude::compile {

/// What a body begins with, as `initial` and `initial_velocity` of a scene.
struct BodyStart {
  std::map<hydro::Mode, double> displacement,
      velocity;  ///< m and rad, m/s and rad/s; modes that are not free are left out
};
struct ClosedStart {
  std::vector<BodyStart> bodies;
  std::string opened = {};  ///< the joint that was open by most as measured, and by how much; empty: there is none
};
/// The start nearest to what was measured (one a body; what is left out is 0) in which all joints are closed, places
/// and velocities, to round-off: all bodies move by the least in the metric of their masses (D18). Angles are those
/// that lie nearest to the measured ones. \throws hydro::InputError for joints that cannot be closed that way
ClosedStart closed_start(const scene::Scene& scene, const std::vector<BodyStart>& measured);

}  // namespace froude::compile
