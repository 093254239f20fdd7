#include "fit/camera/meeting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "golden_section.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"

namespace fit::camera {
namespace {

/// √(χ²/ν) where chance does not make it, else 1.
double widening(double squares, double freedoms) {
  constexpr double clean = 0.999;
  if (freedoms < 1 || squares <= hydro::signal::chi_square_quantile(clean, freedoms)) return 1;
  return std::sqrt(squares / freedoms);
}

/// Σ of squares that rays pass each other by, over their errors, none counted for more than five of these: exchanged
/// names are no clock.
struct StraySum {
  double squares = 0, points = 0;
  double mean() const { return points > 0 ? squares / points : std::numeric_limits<double>::infinity(); }
};
StraySum strays_of(const SpaceTrack& track, double farthest = std::numeric_limits<double>::infinity()) {
  StraySum out;
  for (const auto& marker : track.point)
    for (const auto& p : marker)
      if (p) out.squares += std::pow(std::min(p->stray, farthest), 2), ++out.points;
  return out;
}

double mean_at(const SeenByEye& first, SeenByEye second, double later) {
  constexpr double farthest = 5;
  for (double& t : second.track.time) t += later;
  try {
    return strays_of(joined(first, second), farthest).mean();
  } catch (const hydro::InputError&) {  // no time in common
    return std::numeric_limits<double>::infinity();
  }
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> leave_out_apart(SpaceTrack& track) {  // (V36)
  constexpr double clean = 0.99;
  std::vector<std::pair<std::size_t, std::size_t>> out;
  if (track.points == 0) return out;
  const double level = hydro::signal::chi_square_quantile(std::pow(clean, 1.0 / track.points), 1);
  for (std::size_t i = 0; i < track.time.size(); ++i)
    for (std::size_t m = 0; m < track.point.size(); ++m) {
      auto& p = track.point[m][i];
      if (!p || p->stray * p->stray < level) continue;
      p.reset();
      out.emplace_back(m, i);
    }
  track.points -= static_cast<int>(out.size());
  return out;
}

double stray_of(const SpaceTrack& track) {
  const StraySum sum = strays_of(track);
  return sum.points > 0 ? std::sqrt(sum.mean()) : 0;
}

double widening_of(const SpaceTrack& track) {  // (V38)
  const StraySum sum = strays_of(track);
  // A sighting of the second film goes into two points or more, so that half of them are independent.
  return widening(sum.squares / 2, sum.points / 2);
}

double widening_of(const SpacePoses& poses) {
  double squares = 0, freedoms = 0;
  for (const auto& pose : poses.pose)
    if (pose) squares += pose->stray * pose->stray * pose->freedoms, freedoms += pose->freedoms;
  return widening(squares, freedoms);
}

std::optional<double> clock_of_second(const SeenByEye& first, const SeenByEye& second) {
  constexpr double reach = 0.5, meeting = 1.2;  // s; χ² of a freedom where rays meet, of some hundred points
  if (second.track.frames() < 2 || mean_at(first, second, 0) < meeting) return std::nullopt;
  const double step =
      (second.track.time.back() - second.track.time.front()) / static_cast<double>(second.track.frames() - 1) / 2;
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (double later = -reach; later <= reach; later += step)
    if (const double mean = mean_at(first, second, later); mean < least) least = mean, best = later;
  const double later = least_by_golden_section([&](double t) { return mean_at(first, second, t); }, best - step,
                                               best + step, step / 1000);
  if (mean_at(first, second, later) > meeting) return std::nullopt;
  return later;
}

}  // namespace fit::camera
