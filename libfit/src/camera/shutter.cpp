#include "fit/camera/shutter.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "hydro/base/error.hpp"

namespace fit::camera {
namespace {

/// Where the cubic through four sightings, at their times, is at a time.
Sighting between(const std::array<Sighting, 4>& seen, const std::array<double, 4>& times, double time) {
  Sighting out{.at = Eigen::Vector2d::Zero()};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (std::size_t j = 0; j < 4; ++j) {
    double weight = 1;
    for (std::size_t k = 0; k < 4; ++k)
      if (k != j) weight *= (time - times[k]) / (times[j] - times[k]);
    out.at += weight * seen[j].at;
    covariance += weight * weight * seen[j].covariance;
  }
  if (std::all_of(seen.begin(), seen.end(), [](const Sighting& s) { return s.has_covariance(); }))
    out.covariance = covariance;
  return out;
}

/// A marker at the time of frame i, which its row there is read after.
std::optional<Sighting> at_frame(const Marker& marker, const std::vector<double>& time, std::size_t i,
                                 double later_per_row, double deviation) {
  if (i < 2 || i + 1 >= time.size()) return std::nullopt;
  std::array<Sighting, 4> seen{};
  std::array<double, 4> times{};
  for (std::size_t j = 0; j < 4; ++j) {
    const auto& s = marker.seen[i + j - 2];
    if (!s) return std::nullopt;
    seen[j] = *s;
    if (!s->has_covariance() && deviation > 0) seen[j].covariance = deviation * deviation * Eigen::Matrix2d::Identity();
    times[j] = time[i + j - 2] + later_per_row * s->at.y();
  }
  return between(seen, times, time[i]);
}

}  // namespace

Track of_one_instant(const Track& track, double readout_s, int height, double deviation) {  // (V37)
  hydro::require(!track.in_metres, "the track is in metres, and rows of a picture are told by pixels");
  hydro::require(height > 0, "the height of the pictures is not known, over which the rows are read");
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < track.frames(); ++i) least = std::min(least, track.time[i] - track.time[i - 1]);
  hydro::require(readout_s > 0 && readout_s <= least,
                 "reading the rows of a frame takes {:.4g} s, which must be positive and no longer than the {:.4g} s "
                 "between frames",
                 readout_s, least);
  Track out = track;
  for (std::size_t m = 0; m < track.markers.size(); ++m)
    for (std::size_t i = 0; i < track.frames(); ++i)
      out.markers[m].seen[i] = at_frame(track.markers[m], track.time, i, readout_s / height, deviation);
  return out;
}

}  // namespace fit::camera
