#pragma once
/// \file  Instants that a film and another record have in common, or that a film tells by itself: how late a record's
///        clock is, and when a model was let go; (V18), (V19), docs/theory/camera.md.
#include <span>

#include "fit/camera/track.hpp"

namespace fit::camera {

struct Offset {
  double lag;         ///< s: what is added to times of the film to have those of the record
  double deviation;   ///< s, standard, with the noise of both and its memory
  double half_width;  ///< s: of the interval of 95 % about the lag
  double correlation;
  double runner_up;  ///< the largest correlation more than a swing away; 0: there is none
};

/// What of a film and of a record show the same, whatever its unit, its zero and its sign: value(t) against
/// record(t + lag). Both may have noise, with a memory or without, independent of the other's; of 400 made sets 92 to
/// 97 % have the truth within the interval. Lags are those at which half of the film or of the record, whichever is
/// shorter, lies within the other. Times ascend and need not be even; NaN is a gap of the film. \throws
/// hydro::InputError: fewer than 16 samples of either or of what stands beside each other, a record that is constant or
/// not finite, a correlation below 0.7, another lag that is nearly as good, more than a swing away
Offset offset_between(std::span<const double> time, std::span<const double> value, std::span<const double> record_time,
                      std::span<const double> record);

struct Release {
  double at;         ///< s, of the track
  double deviation;  ///< s, standard
};

/// When a marker that has been at rest begins to move, as one does that is let go: in even powers of the time since,
/// until it has come a tenth of its whole way. \throws hydro::InputError: unknown marker, fewer than 5 frames at
/// rest or 4 in motion, a marker that does not move by 20 of its errors
Release release_of(const Track& track, std::string_view marker);

}  // namespace fit::camera
