#pragma once
/// \file  Whether the sightings of a track fit the path that smooths them: single ones that are wrong, deviations that
///        are stated too small, and a bandwidth that cuts the motion; (V30), (V31), docs/theory/camera.md.
#include <cstddef>
#include <string>
#include <vector>

#include "fit/camera/smooth.hpp"

namespace fit::camera {

/// Frames in which one marker does not fit the path through all its other sightings.
struct Misfit {
  std::string marker;
  std::size_t first, last;  ///< frames, both counted
  double away;              ///< largest distance from that path, in the track's unit
  double errors;            ///< the same over its expected deviation
  bool settles;             ///< what is left without these frames fits together
  bool faster;              ///< a band twice as wide takes them: perhaps the motion itself is faster there
};

/// What all sightings of one marker tell of its stated deviations and of the band.
struct Scatter {
  std::string marker;
  double factor;  ///< by which errors exceed those stated; 1 where chance can be the cause
  double
      lost;  ///< rms of what the band cuts off over the deviation of a smoothed place; 0 where chance can be the cause
  /// The band cuts more off than the deviation of a place: no factor mends that.
  bool cut() const { return lost > 1; }
};

struct SightingCheck {
  std::vector<Misfit> misfits;
  std::vector<Scatter> markers;
};

/// Each sighting beside the path through all others. A clean film has no misfit in 99 of 100 cases.
/// Lengths have no part in it, markers are judged one by one. \throws as smooth()
SightingCheck check_sightings(const Track& track, double bandwidth_hz);

/// The track with the covariances of each marker multiplied by the square of its factor.
Track widened(const Track& track, const SightingCheck& check);

}  // namespace fit::camera
