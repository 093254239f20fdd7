#pragma once
/// \file  Channels of a fit from a track: coordinates of markers and angles of lines between them, with what makes
/// their
///        errors independent; (V11), (V12), docs/theory/camera.md.
#include <Eigen/Core>

#include <string>
#include <vector>

#include "fit/camera/track.hpp"

namespace fit::camera {

/// A number that a track in the plane of motion tells at each frame.
struct Channel {
  enum class Kind { along, up, angle } kind;
  std::string marker;      ///< of an angle the first of the line
  std::string to = {};     ///< the other one
  bool downwards = false;  ///< the angle grows from the axis down; else up
  double zero = 0;         ///< rad: direction of the line where the angle is zero, counted the same way
};

struct Channels {
  Eigen::MatrixXd values;          ///< shape (frames, channels); m and rad, NaN where a marker was not seen
  std::vector<double> deviations;  ///< one a channel: rms over the frames
  /// One a frame, shape (channels, channels): makes of errors over `deviations` independent ones of variance 1. Rows
  /// and columns of what was not seen are zero.
  std::vector<Eigen::MatrixXd> whitening;
  double largest_turn = 0;  ///< rad: of an angle against where it was expected from the two frames before it
};

/// Angles go on without jumps, the first within ±π. \throws hydro::InputError: a track in pixels, an unknown marker, a
/// channel that is never seen, both markers of a line at one place, channels that tell the same, an angle that turns so
/// fast between two frames that its direction round is not known
Channels channels_of(const Track& track, const std::vector<Channel>& channels);

}  // namespace fit::camera
