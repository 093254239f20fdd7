#include "fit/camera/instants.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fit/median_step.hpp"
#include "hydro/base/error.hpp"

namespace fit::camera {
namespace {

using hydro::InputError;

constexpr Eigen::Index most_powers = 4;  // powers of the series, and of the one beyond that judges it

/// The squares that are left of places of one marker when it rests until t0 and then goes on in even powers of the
/// time since, 2 to 2 `powers`, as whatever falls from rest does; each coordinate by itself. (V19)
double squares_left(const std::vector<double>& time, const std::vector<Eigen::Vector2d>& place, double t0,
                    Eigen::Index powers) {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_powers + 1, most_powers + 1> normal;
  Eigen::Matrix<double, Eigen::Dynamic, 2, 0, most_powers + 1, 2> right;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_powers + 1, 1> basis(powers + 1);
  normal.setZero(powers + 1, powers + 1);
  right.setZero(powers + 1, 2);
  const double unit = time.back() - t0;
  double squares = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double since = std::max(0.0, time[i] - t0) / unit;
    for (Eigen::Index k = 0; k <= powers; ++k) basis[k] = k == 0 ? 1 : basis[k - 1] * since * since;
    const Eigen::Vector2d from = place[i] - place[0];
    normal += basis * basis.transpose();
    right += basis * from.transpose();
    squares += from.squaredNorm();
  }
  return squares - (right.transpose() * normal.ldlt().solve(right)).trace();
}

/// The instant at which least is left over with so many powers.
struct Instant {
  double at, deviation, squares;
  double freedoms;  ///< numbers that are left over
};
Instant instant_of(const std::vector<double>& time, const std::vector<Eigen::Vector2d>& place, Eigen::Index powers) {
  const double step = median_step(time) / 20, h = 4 * step;
  const auto left = [&](double t0) { return squares_left(time, place, t0, powers); };
  Instant out{time[0], 0, std::numeric_limits<double>::infinity(),
              2 * static_cast<double>(time.size()) - 2 * static_cast<double>(powers) - 3};
  for (double t0 = time[0] - 4 * 20 * step; t0 < time[time.size() - 2]; t0 += step)
    if (const double now = left(t0); now < out.squares) out.squares = now, out.at = t0;
  const double bend = (left(out.at + h) - 2 * out.squares + left(out.at - h)) / (h * h);
  out.deviation = std::sqrt(2 * out.squares / out.freedoms / std::max(bend, 1e-300) + step * step / 12);
  return out;
}

/// (V19) The series goes on as far as the places show it; what one power more would make of the instant is counted as
/// an error of where it ends.
Instant judged_instant(const std::vector<double>& time, const std::vector<Eigen::Vector2d>& place) {
  constexpr double shown = 9;  // mean square of two numbers over that of noise: e^-9, one in some thousand by chance
  Instant now = instant_of(time, place, 2);
  for (Eigen::Index powers = 3;; ++powers) {
    const Instant next = instant_of(time, place, powers);
    const bool goes_on = (now.squares - next.squares) / 2 > shown * next.squares / next.freedoms;
    if (!goes_on || powers == most_powers) {
      now.deviation = std::hypot(now.deviation, next.at - now.at);
      return now;
    }
    now = next;
  }
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
  const Instant begun = judged_instant(time, place);
  const auto at_rest = std::count_if(time.begin(), time.end(), [&](double t) { return t < begun.at; });
  const std::ptrdiff_t moving = std::ssize(time) - at_rest;
  if (at_rest < 5 || moving < 4)
    throw InputError(
        fmt::format("marker \"{}\" is at rest in {} frames and begins to move in {}: 5 and 4 are needed to "
                    "tell its release",
                    name, at_rest, moving),
        {}, "film from before the release, with more frames a second");
  return {begun.at, begun.deviation};
}

}  // namespace fit::camera
