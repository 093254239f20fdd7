#pragma once
/// \file  When a model was let go, as a film tells it; (V19), docs/theory/camera.md.
#include <string_view>

#include "fit/camera/track.hpp"

namespace fit::camera {

struct Release {
  double at;         ///< s, of the track
  double deviation;  ///< s, standard; holds what one more power of the time since would change
};

/// When a marker that has been at rest begins to move, as one does that is let go: in even powers of the time since,
/// until it has come a tenth of its whole way. \throws hydro::InputError: unknown marker, fewer than 5 frames at
/// rest or 4 in motion, a marker that does not move by 20 of its errors
Release release_of(const Track& track, std::string_view marker);

}  // namespace fit::camera
