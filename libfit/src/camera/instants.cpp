#include "fit/camera/instants.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fit/correlated.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"

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

struct Local {
  double value, slope;
};

/// The samples of a record that are told, and the cubic through so many of them on each side of an instant. (V18)
class Smooth {
 public:
  Smooth(std::span<const double> time, std::span<const double> value) {
    for (std::size_t i = 0; i < time.size(); ++i)
      if (std::isfinite(value[i])) time_.push_back(time[i]), value_.push_back(value[i]);
    step_ = median_step(time_);
  }
  std::size_t size() const { return time_.size(); }
  double time(std::size_t i) const { return time_[i]; }
  double value(std::size_t i) const { return value_[i]; }
  /// Whether that many samples stand on each side, without a gap of half of them, two on each side within reach.
  bool covers(double t, std::size_t side) const {
    const std::size_t next = first_after(t);
    if (next <= side || next + side >= size()) return false;
    const double reach = reach_of(t, next, side);
    return time_[next + side] - time_[next - side - 1] < 2 * step_ * static_cast<double>(2 * side + 1) &&
           (side == 2 || (t - time_[next - 2] < reach && time_[next + 1] - t < reach));
  }
  /// By least squares, the nearer the heavier (tricube); through two on each side it is the interpolation.
  Local at(double t, std::size_t side) const {
    const std::size_t next = first_after(t);
    const double reach = reach_of(t, next, side);
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (std::size_t i = next - side; i < next + side; ++i) {
      const double u = (time_[i] - t) / reach;
      const double near = side == 2 ? 1 : std::max(0.0, 1 - std::abs(u * u * u)), weight = near * near * near;
      const Eigen::Vector4d powers(1, u, u * u, u * u * u);
      normal += weight * powers * powers.transpose();
      right += weight * value_[i] * powers;
    }
    const Eigen::Vector4d cubic = normal.ldlt().solve(right);
    return {cubic[0], cubic[1] / reach};
  }

 private:
  std::size_t first_after(double t) const {
    return static_cast<std::size_t>(std::upper_bound(time_.begin(), time_.end(), t) - time_.begin());
  }
  /// Up to the nearer of the two samples that no longer count: so none comes or goes with a weight.
  double reach_of(double t, std::size_t next, std::size_t side) const {
    return std::min(t - time_[next - side - 1], time_[next + side] - t);
  }
  std::vector<double> time_, value_;
  double step_;
};

constexpr Eigen::Index fewest = 16;  // samples that tell a lag

/// Two records of one motion, the second the denser, and how it is smoothed.
struct Pair {
  Smooth sparse, dense;
  double sparse_step, dense_step;
};

/// Samples of the sparse record that the dense one covers at a lag: columns of one, the dense one smoothed and its
/// slope; the sparse values and their own smooth slope; the dense one as finely as the sparse one is sampled.
struct Compared {
  Eigen::MatrixXd basis;
  Eigen::VectorXd sparse, sparse_slope, dense;
};

std::size_t samples_within(double time, double step, std::size_t of) {
  return std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(time / step)), 2,
                                 std::max<std::size_t>(2, of / 16));
}

Compared compared(const Pair& p, double lag, std::size_t side) {
  const std::size_t fine = samples_within(p.sparse_step, p.dense_step, p.dense.size()),
                    own = samples_within(static_cast<double>(side) * p.dense_step, p.sparse_step, p.sparse.size());
  std::vector<std::size_t> taken;
  for (std::size_t i = 0; i < p.sparse.size(); ++i) {
    const double t = p.sparse.time(i);
    if (p.sparse.covers(t, own) && p.dense.covers(t + lag, std::max(side, fine))) taken.push_back(i);
  }
  const auto n = static_cast<Eigen::Index>(taken.size());
  Compared out{Eigen::MatrixXd(n, 3), Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t i = taken[static_cast<std::size_t>(k)];
    const double t = p.sparse.time(i);
    const Local there = p.dense.at(t + lag, side);
    out.basis.row(k) << 1, there.value, there.slope;
    out.sparse[k] = p.sparse.value(i);
    out.sparse_slope[k] = p.sparse.at(t, own).slope;
    out.dense[k] = p.dense.at(t + lag, fine).value;
  }
  return out;
}

/// How many samples on each side smooth the dense record best: so that it tells the sparse one best, whose noise is
/// another. (V18)
std::size_t best_side(const Pair& p, double lag) {
  std::size_t best = 2;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t side = 2; side == 2 || side <= p.dense.size() / 16; side += std::max<std::size_t>(1, side / 4)) {
    const Compared c = compared(p, lag, side);
    if (c.sparse.size() < fewest) break;
    const Eigen::Vector3d fitted = (c.basis.transpose() * c.basis).ldlt().solve(c.basis.transpose() * c.sparse);
    const double mean_square = (c.sparse - c.basis * fitted).squaredNorm() / static_cast<double>(c.sparse.size() - 3);
    if (mean_square < least) least = mean_square, best = side;
    if (mean_square > 1.5 * least) break;  // the motion itself is smoothed away
  }
  return best;
}

/// (V18) The lag by Gauss and Newton from there, with its deviation, which has the noise of both and its memory.
Offset refined(const Peaks& from, const Pair& p) {
  Offset out{
      .lag = from.lag, .deviation = 0, .half_width = 0, .correlation = from.correlation, .runner_up = from.runner_up};
  const std::size_t side = best_side(p, out.lag);
  double longest = p.sparse_step / 2, before = 0;
  for (int round = 0; round < 50; ++round) {
    Compared c = compared(p, out.lag, side);
    if (c.sparse.size() < fewest)
      throw InputError(fmt::format("film and record tell no offset: {} samples stand beside each other, {} are needed",
                                   c.sparse.size(), fewest));
    const auto level = c.basis.leftCols<2>();
    const Eigen::Matrix2d inverse = (level.transpose() * level).inverse();
    const Eigen::Vector2d fitted = inverse * (level.transpose() * c.sparse);
    Eigen::Ref<Eigen::VectorXd> slope = c.basis.col(2);
    slope -= level * (inverse * (level.transpose() * slope));
    const Eigen::VectorXd left = (c.sparse - fitted[1] * c.dense).array() - fitted[0];
    const double information = slope.dot(c.sparse_slope), move = slope.dot(left) / information;
    if (!std::isfinite(move) || information * from.correlation <= 0)
      throw InputError("film and record tell no offset: their slopes do not");
    // Samples come and go at the ends as the lag moves: where the move jumps from one sign to the other is the end,
    // too.
    if (move * before < 0) longest /= 2;
    before = std::clamp(move, -longest, longest);
    out.lag += before;
    if (std::abs(before) > 5e-4 * p.dense_step) continue;
    if (left.norm() > 1e-12 * c.sparse.norm()) {
      const CoefficientCovariance u = correlated_covariance(c.basis, left, 1, LongMemory::widen);
      out.deviation = std::sqrt(u.covariance(2, 2)) * slope.squaredNorm() / std::abs(information);
      out.half_width = hydro::signal::student_t_quantile(0.975, u.dof) * out.deviation;
    }
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
  Peaks peaks = peaks_of(lags, correlations);
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
  const Smooth film_itself(time, value), record_itself(record_time, record);
  const double film_step = median_step(time), record_step = median_step(record_time);
  if (film_step >= record_step) return refined(peaks, {film_itself, record_itself, film_step, record_step});
  peaks.lag *= -1;
  Offset found = refined(peaks, {record_itself, film_itself, record_step, film_step});
  found.lag *= -1;
  return found;
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
