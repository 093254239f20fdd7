#include "fit/camera/instants.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fit/median_step.hpp"
#include "hydro/base/error.hpp"

namespace fit::camera {
namespace {

using hydro::InputError;

/// The squares that are left of places of one marker when it rests until t0 and then goes on in even powers of the
/// time since, as whatever falls from rest does; each coordinate by itself. (V19)
double squares_left(const std::vector<double>& time, const std::vector<Eigen::Vector2d>& place, double t0) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();  // a column a coordinate
  const double unit = time.back() - time.front();
  double squares = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double since = std::max(0.0, time[i] - t0) / unit, square = since * since;
    const Eigen::Vector3d basis(1, square, square * square);
    const Eigen::Vector2d from = place[i] - place[0];
    normal += basis * basis.transpose();
    right += basis * from.transpose();
    squares += from.squaredNorm();
  }
  return squares - (right.transpose() * normal.inverse() * right).trace();
}

}  // namespace

Release release_of(const Track& track, std::string_view name) {
  const Marker& marker = track.marker(name);
  std::vector<double> time;
  std::vector<Eigen::Vector2d> place;
  double error = 0;
  for (std::size_t i = 0; i < track.frames(); ++i)
    if (const auto& s = marker.seen[i]) {
      time.push_back(track.time[i]);
      place.push_back(s->at);
      error = std::max(error, std::sqrt(s->covariance.trace()));
    }
  hydro::require(place.size() >= 9, "marker \"{}\" is seen in {} frames, 9 are needed to tell when it begins to move",
                 name, place.size());
  double farthest = 0;
  for (const Eigen::Vector2d& p : place) farthest = std::max(farthest, (p - place[0]).norm());
  if (farthest < 20 * error)
    throw InputError(
        fmt::format("marker \"{}\" moves by {:.3g}, which is less than 20 of its errors: no release can be "
                    "told",
                    name, farthest),
        {}, "name a marker that moves");
  const double until = std::max(farthest / 10, 12 * error);
  std::size_t n = 0;
  while (n < place.size() && (place[n] - place[0]).norm() < until) ++n;
  // The first frame beyond, and two more: one parabola tells less than its noise.
  n = std::min(place.size(), n + 3);
  time.resize(n);
  place.resize(n);
  double best = time[0], least = std::numeric_limits<double>::infinity();
  const double step = median_step(time) / 20;
  for (double t0 = time[0] - 4 * 20 * step; t0 < time[n - 2]; t0 += step)
    if (const double left = squares_left(time, place, t0); left < least) least = left, best = t0;
  const auto at_rest = std::count_if(time.begin(), time.end(), [&](double t) { return t < best; });
  const std::ptrdiff_t moving = std::ssize(time) - at_rest;
  if (at_rest < 5 || moving < 4)
    throw InputError(
        fmt::format("marker \"{}\" is at rest in {} frames and begins to move in {}: 5 and 4 are needed to "
                    "tell its release",
                    name, at_rest, moving),
        {}, "film from before the release, with more frames a second");
  const double h = 4 * step,
               bend = (squares_left(time, place, best + h) - 2 * least + squares_left(time, place, best - h)) / (h * h);
  const double noise = least / (2 * static_cast<double>(n) - 7);
  return {best, std::sqrt(2 * noise / std::max(bend, 1e-300) + step * step / 12)};
}

}  // namespace fit::camera
