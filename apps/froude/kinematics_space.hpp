#pragma once
/// \file  `froude kinematics` in space: --space and --second. Private to apps/froude.
#include "answers/fit_models.hpp"
#include "answers/fit_scene.hpp"
#include "froude/commands.hpp"

namespace froude {

/// One film of a fit scene.
struct FilmAsked {
  const scene::MotionModel& model;
  const scene::MotionModel::Record& record;
  const scene::CameraTable& camera;

  const Path& scene_of_motion() const { return record.scene ? record.scene->value : model.scene.value; }
};
/// By the name of its record; none: the only one. \throws hydro::InputError for a scene without a track, an unknown
/// name, and none where there are several
FilmAsked film_asked(const scene::FitScene& scene, const std::optional<std::string>& name);

/// Six motions of bodies by one camera, or places of markers by two, frame by frame, as a table with gaps.
/// \throws hydro::InputError as poses_in_space() and joined(), and for a camera whose pose no board told
void kinematics_in_space(const KinematicsArguments& arguments, const Console& console);

}  // namespace froude
