#include "fit/camera/instants.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fit/correlated.hpp"
#include "hydro/base/error.hpp"

namespace fit::camera {
namespace {

using hydro::InputError;

double median_step(std::span<const double> time) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  std::nth_element(steps.begin(), steps.begin() + std::ssize(steps) / 2, steps.end());
  return steps[steps.size() / 2];
}

/// A record between its samples, by the cubic through the two on each side.
class Between {
 public:
  Between(std::span<const double> time, std::span<const double> value) : time_(time), value_(value) {}
  bool covers(double t) const { return t >= time_[1] && t < time_[time_.size() - 2]; }
  double at(double t) const {
    const auto next = std::upper_bound(time_.begin(), time_.end(), t) - time_.begin();
    const auto first = static_cast<std::size_t>(next - 2);
    double sum = 0;
    for (std::size_t j = first; j < first + 4; ++j) {
      double weight = 1;
      for (std::size_t k = first; k < first + 4; ++k)
        if (k != j) weight *= (t - time_[k]) / (time_[j] - time_[k]);
      sum += weight * value_[j];
    }
    return sum;
  }

 private:
  std::span<const double> time_, value_;
};

/// Of samples of the film that the record covers at a lag: their correlation; 0 where they are fewer than `least`.
double correlation_at(double lag, std::span<const double> time, std::span<const double> value, const Between& record,
                      double least) {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (std::isnan(value[i]) || !record.covers(time[i] + lag)) continue;
    const double x = value[i], y = record.at(time[i] + lag);
    n += 1, a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
  }
  const double xx = aa - a * a / n, yy = bb - b * b / n;
  return n >= least && xx > 0 && yy > 0 ? (ab - a * b / n) / std::sqrt(xx * yy) : 0;
}

/// The lag of the largest correlation, whatever its sign, and the largest of those that are on another swing.
struct Peaks {
  double lag = 0, correlation = 0, runner_up = 0;
};

Peaks peaks_of(const std::vector<double>& lags, const std::vector<double>& correlations) {
  Peaks out;
  std::size_t best = 0;
  for (std::size_t i = 0; i < lags.size(); ++i)
    if (std::abs(correlations[i]) > std::abs(correlations[best])) best = i;
  out.lag = lags[best];
  out.correlation = correlations[best];
  // A swing ends where the correlation has changed its sign twice.
  const auto swing_ends = [&](int way) {
    int changes = 0;
    auto i = static_cast<std::ptrdiff_t>(best);
    for (; i + way >= 0 && i + way < std::ssize(lags) && changes < 2; i += way)
      changes += correlations[static_cast<std::size_t>(i)] * correlations[static_cast<std::size_t>(i + way)] <= 0;
    return i;
  };
  const std::ptrdiff_t low = swing_ends(-1), high = swing_ends(1);
  for (std::ptrdiff_t i = 0; i < std::ssize(lags); ++i)
    if (i < low || i > high)
      out.runner_up = std::max(out.runner_up, std::abs(correlations[static_cast<std::size_t>(i)]));
  return out;
}

/// (V18) Zero, factor and lag by Gauss and Newton from there; the lag's deviation with the memory of what is left over.
/// Slopes are taken over the longer step, h, on either side: noise of the record would make them too steep.
Offset refined(Peaks from, std::span<const double> time, std::span<const double> value, const Between& record,
               double step, double h) {
  Offset out{.lag = from.lag, .deviation = 0, .correlation = from.correlation, .runner_up = from.runner_up};
  for (int round = 0; round < 50; ++round) {
    std::vector<Eigen::RowVector3d> rows;
    std::vector<double> values;
    for (std::size_t i = 0; i < time.size(); ++i) {
      const double t = time[i] + out.lag;
      if (std::isnan(value[i]) || !record.covers(t - h) || !record.covers(t + h)) continue;
      rows.emplace_back(1, record.at(t), (record.at(t + h) - record.at(t - h)) / (2 * h));
      values.push_back(value[i]);
    }
    Eigen::MatrixXd basis(std::ssize(rows), 3);
    for (std::size_t i = 0; i < rows.size(); ++i) basis.row(static_cast<Eigen::Index>(i)) = rows[i];
    const Eigen::Map<const Eigen::VectorXd> right(values.data(), std::ssize(values));
    const Eigen::Vector3d fitted = (basis.transpose() * basis).inverse() * (basis.transpose() * right);
    const double move = fitted[2] / fitted[1];
    if (!std::isfinite(move)) throw InputError("film and record tell no offset: their slopes do not");
    out.lag += std::clamp(move, -step, step);
    if (std::abs(move) > 1e-3 * step) continue;
    basis.col(2) *= fitted[1];
    const Eigen::VectorXd left = basis * Eigen::Vector3d(fitted[0], fitted[1], 0) - right;
    if (left.norm() > 1e-12 * right.norm())
      out.deviation = std::sqrt(correlated_covariance(basis, left, 1, LongMemory::widen).covariance(2, 2));
    return out;
  }
  throw InputError("film and record tell no offset: no lag brings them nearest");
}

}  // namespace

Offset offset_between(std::span<const double> time, std::span<const double> value, std::span<const double> record_time,
                      std::span<const double> record) {
  const auto seen =
      static_cast<std::size_t>(std::count_if(value.begin(), value.end(), [](double v) { return std::isfinite(v); }));
  hydro::require(
      time.size() == value.size() && record_time.size() == record.size() && seen >= 16 && record.size() >= 16,
      "an offset needs 16 samples at least of both, got {} of the film and {} of the record", seen, record.size());
  for (std::size_t i = 0; i < record.size(); ++i)
    hydro::require(std::isfinite(record[i]) && (i == 0 || record_time[i] > record_time[i - 1]),
                   "the record must be finite and its times ascend, which they do not at sample {}", i + 1);
  const Between whole(record_time, record);
  const double step = std::min(median_step(time), median_step(record_time)) / 2, film = time.back() - time.front(),
               span = record_time.back() - record_time.front(), half = std::min(film, span) / 2,
               first = record_time.front() - time.back() + half, last = record_time.back() - time.front() - half;
  const double least = std::max(16.0, 0.9 * static_cast<double>(seen) * half / film);
  std::vector<double> lags, correlations;
  for (double lag = first; lag <= last; lag += step) {
    lags.push_back(lag);
    correlations.push_back(correlation_at(lag, time, value, whole, least));
  }
  hydro::require(!lags.empty(), "film and record have no time in common, whatever the offset");
  const Peaks peaks = peaks_of(lags, correlations);
  if (std::abs(peaks.correlation) < 0.7)
    throw InputError(
        fmt::format("film and record do not show the same: their largest correlation is {:.3g}, at {:.4g} s",
                    peaks.correlation, peaks.lag),
        {}, "name a signal and a column that move together");
  // Of normal errors, how many times as likely the better one is, as a logarithm; errors with a memory tell less.
  const double sure = 8, exact = 1e-6;
  const auto unexplained = [exact](double r) { return std::max(exact, 1 - r * r); };
  const double more_likely =
      static_cast<double>(seen) / 2 * std::log(unexplained(peaks.runner_up) / unexplained(peaks.correlation));
  if (more_likely < sure)
    throw InputError(
        fmt::format("two offsets fit nearly alike: the correlation is {:.4g} at {:.4g} s, and {:.4g} a swing "
                    "or more away",
                    std::abs(peaks.correlation), peaks.lag, peaks.runner_up),
        {}, "take more of both records: their beginning, a change, not the steady part alone");
  return refined(peaks, time, value, whole, step, std::max(median_step(time), median_step(record_time)));
}

namespace {

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
