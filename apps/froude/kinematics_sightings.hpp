#pragma once
/// \file  `froude kinematics`: whether the sightings of a track fit the path that is told of them.
#include <string>
#include <vector>

#include "answers/camera_track.hpp"

namespace froude {

struct FittingSightings {
  ::fit::camera::Track places;     ///< with deviations as wide as the sightings themselves show them
  std::vector<std::string> notes;  ///< sentences: deviations that are stated too small, frames of too fast a motion
};
/// \throws hydro::InputError naming markers and frames that do not fit, or a bandwidth that cuts the motion
FittingSightings fitting_sightings(const TrackInPlane& track, double bandwidth_hz);

}  // namespace froude
