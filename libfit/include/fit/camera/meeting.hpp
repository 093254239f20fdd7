#pragma once
/// \file  Whether rays of two cameras meet, and pixels fit their poses, as their errors say; (V36), (V38),
///        docs/theory/camera.md.
#include <optional>
#include <utility>
#include <vector>

#include "fit/camera/space.hpp"

namespace fit::camera {

/// Takes from a track in space the points whose rays pass each other by more of their errors than those of any of so
/// many clean points do in 99 of 100 films. \return their markers and frames, by frame
std::vector<std::pair<std::size_t, std::size_t>> leave_out_apart(SpaceTrack& track);

/// Rms of what rays pass each other by, over their errors; 0 without points.
double stray_of(const SpaceTrack& track);

/// By what deviations must be multiplied for residuals to be as large as they say: 1 where chance makes one clean film
/// in a thousand stray as much.
double widening_of(const SpaceTrack& track);
double widening_of(const SpacePoses& poses);

/// How much later the second film must be taken for rays to meet as their errors say. None where they do as it is, or
/// where no time within half a second makes them.
std::optional<double> clock_of_second(const SeenByEye& first, const SeenByEye& second);

}  // namespace fit::camera
