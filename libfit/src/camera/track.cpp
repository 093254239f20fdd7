#include "fit/camera/track.hpp"

#include <algorithm>

#include "hydro/base/error.hpp"

namespace fit::camera {

using hydro::InputError;

const Marker& Track::marker(std::string_view name) const {
  std::vector<std::string> names;
  for (const Marker& m : markers) {
    if (m.name == name) return m;
    names.push_back(m.name);
  }
  const std::string near = hydro::nearest(name, names);
  throw InputError(fmt::format("the track has no marker \"{}\"", name), {},
                   near.empty() ? fmt::format("its markers are {}", fmt::join(names, ", "))
                                : fmt::format("did you mean \"{}\"?", near));
}

Track cut(const Track& track, double from, double to) {
  Track out{.time = {}, .markers = {}, .in_metres = track.in_metres, .size = track.size};
  for (const Marker& m : track.markers) out.markers.push_back({m.name, {}});
  for (std::size_t i = 0; i < track.frames(); ++i) {
    if (track.time[i] < from || track.time[i] > to) continue;
    out.time.push_back(track.time[i] - from);
    for (std::size_t k = 0; k < track.markers.size(); ++k) out.markers[k].seen.push_back(track.markers[k].seen[i]);
  }
  if (out.frames() < 2)
    throw InputError(fmt::format("the track runs from {:.6g} s to {:.6g} s; from {:.6g} s to {:.6g} s it has {} frames",
                                 track.time.front(), track.time.back(), from, to, out.frames()),
                     {},
                     "take a part of it that is longer: from and to of [camera], start and end of a [[data.record]]");
  return out;
}

Track in_plane(const Track& track, const View& view, double deviation) {
  Track out{.time = track.time, .markers = {}, .in_metres = true, .size = track.size};
  if (view.lens && track.size.x() > 0 && track.size != view.lens->size)
    throw InputError(fmt::format("the film's pictures are {} x {} px, the lens was calibrated with {} x {} px",
                                 track.size.x(), track.size.y(), view.lens->size.x(), view.lens->size.y()),
                     {},
                     "calibrate with pictures of the film's size: scaling and cropping change focal length and centre");
  for (const Marker& m : track.markers) {
    Marker placed{m.name, {}};
    for (std::size_t i = 0; i < track.frames(); ++i) {
      placed.seen.emplace_back();
      if (!m.seen[i]) continue;
      const Sighting& s = *m.seen[i];
      if (!s.has_covariance() && !(deviation > 0))
        throw InputError(fmt::format("the track tells no errors of marker \"{}\"", m.name), {},
                         "state the standard deviation of its places: [camera] deviation");
      const Eigen::Matrix2d errors =
          s.has_covariance() ? s.covariance : Eigen::Matrix2d(deviation * deviation * Eigen::Matrix2d::Identity());
      try {
        const Eigen::Matrix2d slope = point_slope(view, s.at);
        placed.seen.back() = {point_of(view, s.at), slope * errors * slope.transpose()};
      } catch (const InputError& e) {
        throw InputError(fmt::format("marker \"{}\" at {:.6g} s: {}", m.name, track.time[i], e.rule()), e.where(),
                         e.remedy());
      }
    }
    out.markers.push_back(std::move(placed));
  }
  return out;
}

double mean_distance(const Track& track, const View& view, std::string_view a, std::string_view b) {
  View one = view;  // in the track's own unit
  one.pose.reset();
  one.metres_per_pixel = 1;
  const Marker &first = track.marker(a), &second = track.marker(b);
  double sum = 0;
  int frames = 0;
  for (std::size_t i = 0; i < track.frames(); ++i)
    if (first.seen[i] && second.seen[i]) {
      sum += (point_of(one, first.seen[i]->at) - point_of(one, second.seen[i]->at)).norm();
      ++frames;
    }
  hydro::require(frames > 0, "markers \"{}\" and \"{}\" are in no frame together, so their distance tells no scale", a,
                 b);
  return sum / frames;
}

}  // namespace fit::camera
