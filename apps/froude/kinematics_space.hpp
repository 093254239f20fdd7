#pragma once
/// \file  `froude kinematics` in space: --space and --second. Private to apps/froude.
#include "answers/fit_models.hpp"
#include "answers/fit_scene.hpp"
#include "froude/commands.hpp"

namespace froude {

/// \throws hydro::InputError for a scene without a track
const scene::MotionModel& model_of_track(const scene::FitScene& scene);

/// Six motions of bodies by one camera, or places of markers by two, frame by frame, as a table with gaps.
/// \throws hydro::InputError as poses_in_space() and joined(), and for a camera whose pose no board told
void kinematics_in_space(const KinematicsArguments& arguments, const Console& console);

}  // namespace froude
