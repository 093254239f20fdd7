#pragma once
/// \file  Places, velocities and accelerations of markers from a track with gaps: a smoother of stated bandwidth, with
///        known lengths between markers as constraints; (V5)-(V7), docs/theory/camera.md.
#include <Eigen/Core>

#include <string>
#include <vector>

#include "fit/camera/track.hpp"

namespace fit::camera {

/// Two markers that keep their distance.
struct KnownLength {
  std::string from, to;
  double length;     ///< in the track's unit
  double deviation;  ///< of that statement, in the same unit, positive
};
/// \throws hydro::InputError for a length that is not positive, a deviation that is not or is as large as the length
void check(const KnownLength& length);

struct SmoothOptions {
  /// Below it the gain of a record without gaps is within 1 % of 1; it falls as 1/(1 + (f/f_c)⁶), f_c = 2.15 times it.
  double bandwidth_hz = 0;
  std::vector<KnownLength> lengths = {};
};

/// One instant of one marker.
struct MarkerMotion {
  Eigen::Vector2d place, velocity, acceleration;
  Eigen::Vector2d place_sd, velocity_sd, acceleration_sd;  ///< standard deviations
};

/// An angle of the line between two markers, with its rates.
struct AngleMotion {
  double angle, rate, acceleration;  ///< rad, rad/s, rad/s²
  double angle_sd, rate_sd, acceleration_sd;
};

/// Numbers of a frame that are one marker's.
inline constexpr Eigen::Index numbers_of_marker = 6;

/// All markers together at each frame. Numbers of a frame: marker by marker, along x: place, velocity, acceleration;
/// then along y.
struct SmoothTrack {
  std::vector<double> time;
  std::vector<std::string> markers;
  std::vector<Eigen::VectorXd> state;       ///< one a frame, shape (6 markers)
  std::vector<Eigen::MatrixXd> covariance;  ///< one a frame
  double cutoff_hz = 0;                     ///< f_c
  int rounds = 0;                           ///< of lengths taken as straight about the last trajectory

  MarkerMotion marker(std::size_t marker, std::size_t frame) const;
  /// Of the direction from one marker to another, from x towards y, within ±π. \throws hydro::InputError where both
  /// are at one place
  AngleMotion angle(std::size_t from, std::size_t to, std::size_t frame) const;
};

/// Kalman's filter forwards and the smoother of Rauch, Tung & Striebel (1965) backwards over jerk that is white noise.
/// Covariances hold noise of the sightings and what the band cuts off of a motion with that jerk: those of
/// accelerations are wider by √6 than noise alone. \throws hydro::InputError: no bandwidth or one above half of the
/// frames' rate, a length that differs by five deviations from what is seen, a marker that is never seen, sightings
/// without covariance, a length or deviation that is not positive, an unknown marker;
/// hydro::NumericsError where lengths and sightings contradict each other so that no round of linearisation ends
SmoothTrack smooth(const Track& track, const SmoothOptions& options);

}  // namespace fit::camera
