#pragma once
/// \file  Markers that are no discs: squares with a pattern within, and whatever a picture of one shows; (V16), (V17),
///        docs/theory/camera.md. Where they are roughly is known from elsewhere.
#include <Eigen/Core>

#include <array>
#include <optional>

#include "fit/camera/picture.hpp"
#include "fit/camera/track.hpp"

namespace fit::camera {

/// The middle of a dark square on a light ground, seen from any side, where its diagonals cross. `corners` go round it
/// and may be off by two pixels. None where an edge cannot be told: sides shorter than 12 px, the picture's edge, no
/// contrast. Sides are taken as straight: a lens that bends one by a tenth of a pixel moves its corners by as much.
std::optional<Sighting> middle_of_square(const Picture& picture, const std::array<Eigen::Vector2d, 4>& corners);

/// The middle of what `pattern` shows, brightness and contrast whatever they are, from a place that is off by a pixel
/// or two; not turned and of the pattern's size. None where no place near it fits, or the picture's edge is in the way.
std::optional<Sighting> middle_of_pattern(const Picture& picture, const Picture& pattern, const Eigen::Vector2d& near);

}  // namespace fit::camera
