#pragma once
/// \file  Films whose rows are read one after the other; (V37), docs/theory/camera.md.
#include "fit/camera/track.hpp"

namespace fit::camera {

/// The track as it would be had all rows of a frame been read at its time, which is that of its first row: row y of
/// `height` is read `readout_s` · y/height later, so that each marker was seen at times of its own. Between them it is
/// taken by the cubic through two sightings on each side, covariances along; where one of the four is missing, and in
/// two frames at the start and one at the end, there is a gap. Sightings without covariance have that of `deviation`,
/// px, unless it is 0. \throws hydro::InputError for a track in metres, a readout that is not positive or longer than
/// the shortest time between frames, or a height that is not positive
Track of_one_instant(const Track& track, double readout_s, int height, double deviation = 0);

}  // namespace fit::camera
