#pragma once
/// \file  The track that a fit scene names, as places in its plane of motion and as channels of its fit. Private to
/// apps.
#include <string>
#include <vector>

#include "answers/fit_models.hpp"
#include "answers/fit_scene.hpp"
#include "fit/camera/channels.hpp"
#include "fit/camera/track.hpp"

namespace froude {

/// What [camera] says of this track: lens, scale, pivot. \throws hydro::InputError
::fit::camera::View view_of(const scene::CameraTable& camera, const ::fit::camera::Track& track);
/// The frames that a record of the scene takes, as the track has them.
struct FilmedTrack {
  ::fit::camera::Track track;  ///< times from the run's start
  double begin;                ///< s, where that is in the track's own times, [camera] offset counted
  ::fit::camera::View view;
  double deviation;  ///< of sightings without covariance, in the track's unit; 0: none is stated
};
/// \throws hydro::InputError with the file or the place in the scene
FilmedTrack filmed_track(const scene::FitScene& scene, const scene::MotionModel& model,
                         const scene::MotionModel::Record& record);

struct TrackInPlane {
  ::fit::camera::Track places;  ///< m, with times from the run's start
  double begin;                 ///< s, where that is in the track's own times, [camera] offset counted
};
/// The same frames in metres of the plane of motion. \throws hydro::InputError with the file or the place in the scene
TrackInPlane track_in_plane(const scene::FitScene& scene, const scene::MotionModel& model,
                            const scene::MotionModel::Record& record);
/// The signals of the model, in their order, as this camera sees them. \throws hydro::InputError at a signal that does
/// not lie in the picture
std::vector<::fit::camera::Channel> channels_asked(const scene::MotionModel& model, const scene::CameraTable& camera);

}  // namespace froude
