#include "fit/offset.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fit/correlated.hpp"
#include "fit/median_step.hpp"
#include "fit/sensor.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "hydro/signal/fft.hpp"

namespace fit {
namespace {

using hydro::InputError;

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

/// Of each `stride`th sample of the first that the second covers at a lag: their correlation; 0 where they are fewer
/// than `least`.
double correlation_at(double lag, std::span<const double> time, std::span<const double> value, const Between& record,
                      double least, std::size_t stride) {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < time.size(); i += stride) {
    if (std::isnan(value[i]) || !record.covers(time[i] + lag)) continue;
    const double x = value[i], y = record.at(time[i] + lag);
    n += 1, a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
  }
  const double xx = aa - a * a / n, yy = bb - b * b / n;
  return n >= least && xx > 0 && yy > 0 ? (ab - a * b / n) / std::sqrt(xx * yy) : 0;
}

/// The lag of the largest correlation of the sign asked for, and the largest of those on another swing.
struct Peaks {
  double lag = 0, correlation = 0, runner_up_lag = 0, runner_up = 0;
  bool at_end = false;
};

/// How well a correlation fits a sign.
double fitting(double correlation, OffsetOptions::Sign sign) {
  using enum OffsetOptions::Sign;
  return sign == either ? std::abs(correlation) : sign == same ? correlation : -correlation;
}

Peaks peaks_of(const std::vector<double>& lags, const std::vector<double>& correlations, OffsetOptions::Sign sign) {
  const auto better = [&](double a, double b) { return fitting(a, sign) < fitting(b, sign); };
  const auto best = std::max_element(correlations.begin(), correlations.end(), better) - correlations.begin();
  const auto at = [&](std::ptrdiff_t i) { return correlations[static_cast<std::size_t>(i)]; };
  Peaks out{.lag = lags[static_cast<std::size_t>(best)], .correlation = at(best)};
  out.at_end = best == 0 || best + 1 == std::ssize(lags);
  // A swing ends where the correlation changes its sign.
  std::ptrdiff_t low = best, high = best;
  while (low >= 0 && at(low) * at(best) > 0) --low;
  while (high < std::ssize(lags) && at(high) * at(best) > 0) ++high;
  for (std::ptrdiff_t i = 0; i < std::ssize(lags); ++i)
    if ((i < low || i > high) && fitting(at(i), sign) > out.runner_up)
      out.runner_up = fitting(at(i), sign), out.runner_up_lag = lags[static_cast<std::size_t>(i)];
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
  std::vector<std::size_t> taken;  ///< of the sparse samples
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
  Compared out{std::move(taken), Eigen::MatrixXd(n, 3), Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t i = out.taken[static_cast<std::size_t>(k)];
    const double t = p.sparse.time(i);
    const Local there = p.dense.at(t + lag, side);
    out.basis.row(k) << 1, there.value, there.slope;
    out.sparse[k] = p.sparse.value(i);
    out.sparse_slope[k] = p.sparse.at(t, own).slope;
    out.dense[k] = p.dense.at(t + lag, fine).value;
  }
  return out;
}

Eigen::VectorXd fitted_by(const Eigen::MatrixXd& basis, const Eigen::VectorXd& x) {
  return (basis.transpose() * basis).ldlt().solve(basis.transpose() * x);
}

Eigen::VectorXd left_by(const Eigen::MatrixXd& basis, const Eigen::VectorXd& x) {
  return x - basis * fitted_by(basis, x);
}

/// How many samples on each side smooth the dense record best: so that it tells the sparse one best, whose noise is
/// another. (V18)
std::size_t best_side(const Pair& p, double lag) {
  std::size_t best = 2;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t side = 2; side == 2 || side <= p.dense.size() / 16; side += std::max<std::size_t>(1, side / 4)) {
    const Compared c = compared(p, lag, side);
    if (c.sparse.size() < fewest) break;
    const double mean_square = left_by(c.basis, c.sparse).squaredNorm() / static_cast<double>(c.sparse.size() - 3);
    if (mean_square < least) least = mean_square, best = side;
    if (mean_square > 1.5 * least) break;  // the motion itself is smoothed away
  }
  return best;
}

/// (V18) The lag by Gauss and Newton from there, with its deviation, which has the noise of both and its memory.
Offset refined(const Peaks& from, const Pair& p, std::size_t side, const OffsetOptions& options) {
  Offset out{.lag = from.lag,
             .deviation = 0,
             .half_width = 0,
             .correlation = from.correlation,
             .runner_up = from.runner_up,
             .level = 0,
             .scale = 0,
             .chance = 0};
  double longest = p.sparse_step / 2, before = 0;
  const auto none = [&](const std::string& why) {
    return InputError(fmt::format("{} and {} tell no offset: {}", options.first, options.second, why));
  };
  for (int round = 0; round < 50; ++round) {
    Compared c = compared(p, out.lag, side);
    if (c.sparse.size() < fewest)
      throw none(fmt::format("{} samples stand beside each other, {} are needed", c.sparse.size(), fewest));
    const auto level = c.basis.leftCols<2>();
    const Eigen::Matrix2d inverse = (level.transpose() * level).inverse();
    const Eigen::Vector2d fitted = inverse * (level.transpose() * c.sparse);
    Eigen::Ref<Eigen::VectorXd> slope = c.basis.col(2);
    slope -= level * (inverse * (level.transpose() * slope));
    const Eigen::VectorXd left = (c.sparse - fitted[1] * c.dense).array() - fitted[0];
    const double information = slope.dot(c.sparse_slope), move = slope.dot(left) / information;
    if (!std::isfinite(move) || information * from.correlation <= 0) throw none("their slopes do not");
    // Samples come and go at the ends as the lag moves: where the move jumps from one sign to the other is the end,
    // too.
    if (move * before < 0) longest /= 2;
    before = std::clamp(move, -longest, longest);
    out.lag += before;
    if (std::abs(before) > 5e-4 * p.dense_step) continue;
    out.level = fitted[0], out.scale = fitted[1];
    if (left.norm() > 1e-12 * c.sparse.norm()) {
      const CoefficientCovariance u = correlated_covariance(c.basis, left, 1, LongMemory::widen);
      out.deviation = std::sqrt(u.covariance(2, 2)) * slope.squaredNorm() / std::abs(information);
      out.half_width = hydro::signal::student_t_quantile((1 + options.confidence) / 2, u.dof) * out.deviation;
    }
    return out;
  }
  throw none("no lag brings them nearest");
}

/// Where the correlation is looked for: lags at which half of the shorter lies within the other.
struct Lags {
  double first, last, step;
};

Lags lags_between(std::span<const double> time, std::span<const double> other, const OffsetOptions& o) {
  const double step = std::min(median_step(time), median_step(other)) / 2, span = time.back() - time.front(),
               other_span = other.back() - other.front(), half = std::min(span, other_span) / 2;
  const Lags all{other.front() - time.back() + half, other.back() - time.front() - half, step};
  hydro::require(all.first <= all.last, "{} and {} have no time in common, whatever the offset", o.first, o.second);
  const Lags out{std::max(o.around - o.longest, all.first), std::min(o.around + o.longest, all.last), step};
  if (!(out.first <= out.last))
    throw InputError(
        fmt::format("{} and {} stand beside each other for half of the shorter one at offsets from {:.4g} s to {:.4g} "
                    "s, and those that are looked for go from {:.4g} s to {:.4g} s",
                    o.first, o.second, all.first, all.last, o.around - o.longest, o.around + o.longest),
        {}, "look at the sign of the offset, or for longer ones");
  return out;
}

struct Span {
  double first, last;
  double length() const { return last - first; }
};

/// What the first has beside the second at a lag, by its own clock.
Span beside(const Smooth& first, const Smooth& second, double lag) {
  return {std::max(first.time(0), second.time(0) - lag),
          std::min(first.time(first.size() - 1), second.time(second.size() - 1) - lag)};
}

/// Squares of the Fourier coefficients but the mean of a record over that time, of so many even samples.
std::vector<double> periodogram(const Smooth& record, Span over, std::size_t samples) {
  std::vector<double> even(samples);
  std::size_t j = 0;
  double mean = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const double t = over.first + over.length() * static_cast<double>(i) / static_cast<double>(samples);
    while (j + 2 < record.size() && record.time(j + 1) <= t) ++j;
    const double s = (t - record.time(j)) / (record.time(j + 1) - record.time(j));
    even[i] = (1 - s) * record.value(j) + s * record.value(j + 1);
    mean += even[i] / static_cast<double>(samples);
  }
  for (double& x : even) x -= mean;
  std::vector<double> out;
  for (const auto& x : hydro::signal::real_fft(even)) out.push_back(std::norm(x));
  return out;
}

/// (F106) That two records of these spectra which have nothing in common correlate so much at one of the lags.
double chance_of(const Offset& found, const Smooth& first, const Smooth& second, const Lags& lags) {
  const Span common = beside(first, second, found.lag);
  const std::size_t n = std::min(first.size(), second.size());
  const std::vector<double> x = periodogram(first, common, n),
                            y = periodogram(second, {common.first + found.lag, common.last + found.lag}, n);
  const double sum_x = std::accumulate(x.begin(), x.end(), 0.0), sum_y = std::accumulate(y.begin(), y.end(), 0.0),
               both = std::inner_product(x.begin(), x.end(), y.begin(), 0.0),
               rate = sum_x * sum_y / both / common.length(), square = std::min(1.0, std::pow(found.correlation, 2));
  // Lags beyond one that are independent of it come at that rate, and the less is beside each other the fewer tell.
  const auto of_one = [&](double lag) {
    return std::pow(1 - square, std::max(0.0, rate * beside(first, second, lag).length() - 1));
  };
  double sum = of_one(found.lag);
  for (double lag = lags.first; lag <= lags.last; lag += lags.step) sum += rate * lags.step * of_one(lag);
  return std::min(1.0, sum);
}

void check(std::span<const double> time, std::span<const double> value, std::span<const double> other_time,
           std::span<const double> other, std::size_t seen, const OffsetOptions& o) {
  hydro::require(time.size() == value.size() && other_time.size() == other.size() && seen >= 16 && other.size() >= 16,
                 "an offset needs 16 samples at least of both, got {} of the {} and {} of the {}", seen, o.first,
                 other.size(), o.second);
  require_signal(o.first, value);
  require_signal(o.second, other);
  for (std::size_t i = 0; i < other.size(); ++i)
    hydro::require(std::isfinite(other[i]) && (i == 0 || other_time[i] > other_time[i - 1]),
                   "the {} must be finite and its times ascend, which they do not at sample {}", o.second, i + 1);
}

void require_alike(const Peaks& peaks, const OffsetOptions& o) {
  if (std::abs(peaks.correlation) < 0.7 || fitting(peaks.correlation, o.sign) < 0)
    throw InputError(fmt::format("{} and {} do not show the same: their largest correlation is {:.3g}, at {:.4g} s",
                                 o.first, o.second, peaks.correlation, peaks.lag),
                     {},
                     fmt::format("name channels that move together{}{}",
                                 std::isfinite(o.longest) ? ", or look further than these offsets" : "",
                                 o.sign == OffsetOptions::Sign::either ? "" : ", or leave out the sign"));
  if (peaks.at_end && std::isfinite(o.longest))
    throw InputError(fmt::format("{} and {} are most alike at the end of the offsets that are looked for, {:.4g} s: "
                                 "theirs may lie beyond",
                                 o.first, o.second, peaks.lag),
                     {}, "look further, or for offsets that the records can tell");
}

/// Of the mean square of a record without noise, which interpolation leaves.
constexpr double exact = 1e-6;

/// What a lag leaves unexplained of the sparse samples.
struct Unexplained {
  std::vector<std::size_t> taken;
  Eigen::VectorXd left;
  double share;  ///< of the mean square about the mean, `exact` at least
};

/// At the best lag within half a step of those that were tried, to first order.
Unexplained unexplained_at(const Pair& p, double lag, std::size_t side) {
  Compared c = compared(p, lag, side);
  if (c.sparse.size() < fewest) return {{}, {}, exact};
  const Eigen::VectorXd fitted = fitted_by(c.basis, c.sparse);
  const double half_step = p.dense_step / 4;
  c.basis.col(1) += std::clamp(fitted[2] / fitted[1], -half_step, half_step) * c.basis.col(2);
  const Eigen::VectorXd left = left_by(c.basis.leftCols<2>(), c.sparse);
  const double all = (c.sparse.array() - c.sparse.mean()).square().sum();
  return {std::move(c.taken), left, std::max(exact, left.squaredNorm() / all)};
}

/// How alike what two lags leave is, by the samples that both have.
double likeness(const Unexplained& a, const Unexplained& b, double& shared) {
  double aa = 0, bb = 0, ab = 0;
  shared = 0;
  for (std::size_t i = 0, j = 0; i < a.taken.size() && j < b.taken.size();) {
    if (a.taken[i] != b.taken[j]) {
      ++(a.taken[i] < b.taken[j] ? i : j);
      continue;
    }
    const double x = a.left[static_cast<Eigen::Index>(i++)], y = b.left[static_cast<Eigen::Index>(j++)];
    aa += x * x, bb += y * y, ab += x * y, ++shared;
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

/// (V18) By how many of their deviations the logarithms of what two lags leave unexplained differ, were it noise of one
/// variance in both.
double deviations_apart(const Peaks& peaks, const Pair& p, std::size_t side) {
  const Unexplained best = unexplained_at(p, peaks.lag, side), other = unexplained_at(p, peaks.runner_up_lag, side);
  if (best.taken.empty() || other.taken.empty()) return 0;
  double shared = 0;
  const double alike = likeness(best, other, shared);
  const auto n = static_cast<double>(best.taken.size()), m = static_cast<double>(other.taken.size());
  const double memory = best.share > exact ? memory_of_squares(fit_autoregression(best.left)) : 1;
  const double variance = memory * (2 / n + 2 / m - 4 * alike * alike * shared / (n * m));
  return std::log(other.share / best.share) / std::sqrt(variance);
}

void require_one_lag(const Peaks& peaks, double deviations, const OffsetOptions& o) {
  if (peaks.runner_up > 0 && !(deviations > 3))
    throw InputError(fmt::format("two offsets fit nearly alike: the correlation is {:.4g} at {:.4g} s, and {:.4g} at "
                                 "{:.4g} s: the {} repeats itself after {:.4g} s",
                                 std::abs(peaks.correlation), peaks.lag, peaks.runner_up, peaks.runner_up_lag, o.first,
                                 std::abs(peaks.lag - peaks.runner_up_lag)),
                     {}, o.remedy);
}

}  // namespace

std::string supposed(const OffsetOptions& o, const std::string& what) {
  using enum OffsetOptions::Sign;
  const bool bounded = std::isfinite(o.longest);
  if (!bounded && o.sign == either) return {};
  std::string out = "supposed: ";
  if (bounded) out += fmt::format("{} between {:.6g} s and {:.6g} s", what, o.around - o.longest, o.around + o.longest);
  if (o.sign == either) return out;
  return out +
         fmt::format("{}{} goes {} {}", bounded ? ", and " : "", o.second, o.sign == same ? "as" : "against", o.first);
}

Offset offset_between(std::span<const double> time, std::span<const double> value, std::span<const double> other_time,
                      std::span<const double> other, const OffsetOptions& options) {
  const auto seen =
      static_cast<std::size_t>(std::count_if(value.begin(), value.end(), [](double v) { return std::isfinite(v); }));
  check(time, value, other_time, other, seen, options);
  const Between whole(other_time, other);
  const Lags range = lags_between(time, other_time, options);
  const auto [first, last, step] = range;
  constexpr double most_lags = 1e7;  // a day of both at 100 samples a second
  if ((last - first) / step > most_lags)
    throw InputError(
        fmt::format("offsets from {:.4g} s to {:.4g} s by half a sample, {:.3g} s, are {:.2g}: at most {:.0g} "
                    "are looked at",
                    first, last, step, (last - first) / step, most_lags),
        {}, "look whether a time jumps, or bound the offset");
  const double span = time.back() - time.front(), half = std::min(span, other_time.back() - other_time.front()) / 2;
  // Of long records each sample at each lag would take minutes; the swing is found by fewer.
  constexpr double most = 1e8;
  const auto stride =
      static_cast<std::size_t>(std::ceil(static_cast<double>(value.size()) * ((last - first) / step + 1) / most));
  const double samples = static_cast<double>(seen) / static_cast<double>(stride),
               least = std::max(16.0, 0.9 * samples * half / span);
  std::vector<double> lags, correlations;
  for (double lag = first; lag <= last; lag += step) {
    lags.push_back(lag);
    correlations.push_back(correlation_at(lag, time, value, whole, least, stride));
  }
  const Peaks peaks = peaks_of(lags, correlations, options.sign);
  require_alike(peaks, options);
  const Smooth one(time, value), two(other_time, other);
  const double own_step = median_step(time), other_step = median_step(other_time);
  const bool turned = own_step < other_step;
  const Pair pair = turned ? Pair{two, one, other_step, own_step} : Pair{one, two, own_step, other_step};
  Peaks of_pair = peaks;
  if (turned) of_pair.lag *= -1, of_pair.runner_up_lag *= -1;
  const std::size_t side = best_side(pair, of_pair.lag);
  Offset found = refined(of_pair, pair, side, options);
  require_one_lag(peaks, deviations_apart(of_pair, pair, side), options);
  if (turned) found.lag *= -1, found.level /= -found.scale, found.scale = 1 / found.scale;
  found.chance = chance_of(found, one, two, range);
  return found;
}

}  // namespace fit
