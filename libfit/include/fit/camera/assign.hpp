#pragma once
/// \file  Which place in a frame belongs to which marker: assignment to predicted places over all frames; (V8)-(V10),
///        docs/theory/camera.md.
#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

#include "fit/camera/smooth.hpp"
#include "fit/camera/track.hpp"

namespace fit::camera {

/// For each row of a matrix of costs the column that it takes, so that the sum is least (Kuhn 1955, Munkres 1957; with
/// the potentials of Jonker & Volgenant 1987). Shape (n, m), n <= m. \throws hydro::InputError for another shape or a
/// cost that is not finite
std::vector<std::size_t> least_assignment(const Eigen::MatrixXd& cost);

/// What was found in a frame, without names.
struct Frame {
  double time = 0;
  std::vector<Sighting> found = {};
};

struct AssignOptions {
  std::vector<std::string> names;
  /// Where each marker is in the first frame, to the nearest of what is found there; empty: in the order of `order`.
  std::vector<Eigen::Vector2d> first = {};
  enum class Order { left_to_right, top_to_bottom } order = Order::left_to_right;
  /// Share of right places that the gate lets pass, in both coordinates together.
  double gate = 0.999;
  std::vector<KnownLength> lengths = {};  ///< places that break one by more than five deviations are not its marker's
};

/// Two markers whose names may as well be exchanged, from a time on and in so many frames.
struct Exchangeable {
  std::size_t first, second;  ///< of the markers
  double time;                ///< s, of the first of these frames
  std::size_t frames;
};

struct Assigned {
  Track track;
  std::size_t sightings = 0;             ///< that were given to a marker
  std::size_t left_over = 0;             ///< found and given to none
  std::vector<std::size_t> missing;      ///< frames without it, one a marker
  double acceleration = 0;               ///< px/s²: that predictions allow for, of both coordinates together
  std::vector<Exchangeable> alike = {};  ///< left without both, in the order of their first frames
};

/// Each marker moves on at its velocity, with accelerations that are white noise; what is found is given out so that
/// the sum of squared distances, each over the variance of its prediction, is least, and nothing beyond the gate. A
/// marker that nothing is given to is a gap, over which its prediction grows uncertain. Two markers of which exchanged
/// names are not a thousand times less likely are gaps both (V35). How large accelerations are is
/// taken from a first pass, in which a quarter of the least distance between markers is allowed between two frames.
/// \throws hydro::InputError: fewer than two frames, times that do not increase, fewer places than markers in the first
/// frame, more of them without `first`, a first place that is nearly as near to another, two markers nearest to one
/// place, an unknown name in `lengths`, a film in which nothing moves more than its errors
Assigned assign(const std::vector<Frame>& frames, const AssignOptions& options);

}  // namespace fit::camera
