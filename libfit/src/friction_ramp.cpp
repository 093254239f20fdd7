#include "fit/friction_ramp.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "convolve.hpp"
#include "fit/correlated.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "hydro/signal/welch.hpp"

namespace fit {
namespace {

/// Numbers of samples of the three pieces.
struct RampPieces {
  std::size_t ramp, drop, slide;
  std::size_t all() const { return ramp + drop + slide; }
  /// From the last sample of the ramp to the middle of the drop, in samples.
  double beyond() const { return (static_cast<double>(drop) + 1) / 2; }
};

/// Weights over a line's samples that give its value `at` samples behind its first one; with `slope`, its rate a
/// sample.
std::vector<double> line_weights(std::size_t n, double at, bool slope) {
  const auto count = static_cast<double>(n);
  const double centre = (count - 1) / 2, spread = count * (count * count - 1) / 12;
  std::vector<double> w(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double off = static_cast<double>(i) - centre;
    w[i] = slope ? off / spread : 1 / count + off * (at - centre) / spread;
  }
  return w;
}

/// Running sums of squares about the line over every stretch of n samples, or, without `slope`, about its mean.
std::vector<double> squares_left(const std::vector<double>& values, std::size_t n, bool slope) {
  std::vector<double> squares = values;
  for (double& v : squares) v *= v;
  std::vector<double> left = sliding_sum(squares, std::vector<double>(n, 1.0));
  const auto mean = sliding_sum(values, std::vector<double>(n, 1 / static_cast<double>(n)));
  const auto rate = sliding_sum(values, line_weights(n, 0, true));
  const double count = static_cast<double>(n), spread = count * (count * count - 1) / 12;
  for (std::size_t k = 0; k < left.size(); ++k)
    left[k] -= count * mean[k] * mean[k] + (slope ? spread * rate[k] * rate[k] : 0.0);
  return left;
}

/// The first sample of the three pieces together, where the drop is largest against what the pieces leave over: a line
/// that runs into the slide, or a mean that runs out of it, fits badly however large its drop is.
std::size_t find_slip(const std::vector<double>& torque, const RampPieces& p) {
  const double end = static_cast<double>(p.ramp) - 1 + p.beyond();
  const auto levels = sliding_sum(torque, line_weights(p.ramp, end, false)),
             slopes = sliding_sum(torque, line_weights(p.ramp, end, true)),
             means = sliding_sum(torque, std::vector<double>(p.slide, 1 / static_cast<double>(p.slide))),
             of_line = squares_left(torque, p.ramp, true), of_mean = squares_left(torque, p.slide, false);
  double most = 0;
  for (const double v : torque) most = std::max(most, std::abs(v));
  const double rounding = 1e-12 * most * most * static_cast<double>(p.ramp + p.slide);
  std::ptrdiff_t best = -1;
  double largest = 0;
  for (std::size_t k = 0; k + p.all() <= torque.size(); ++k) {
    const std::size_t after = k + p.ramp + p.drop;
    // Without growth before it a drop is the end of the test, where the load is taken off a joint that slides.
    if (slopes[k] * static_cast<double>(p.ramp) < 0.1 * std::abs(levels[k])) continue;
    const double drop =
        (levels[k] - means[after]) / std::sqrt(std::max(0.0, of_line[k]) + std::max(0.0, of_mean[after]) + rounding);
    if (drop <= largest) continue;
    largest = drop;
    best = static_cast<std::ptrdiff_t>(k);
  }
  hydro::require(best >= 0,
                 "the torque nowhere grows along a straight line and then falls: the joint has not slipped, or ramp "
                 "and slide are longer than the test has them");
  return static_cast<std::size_t>(best);
}

struct RampPiece {
  Eigen::VectorXd x;  // level at the origin, rate in 1/s
  CoefficientCovariance u;
  Eigen::VectorXd fitted;
  double squares;  // left over
};

Eigen::MatrixXd line_columns(const Eigen::VectorXd& time) {
  Eigen::MatrixXd columns(time.size(), 2);
  columns << Eigen::VectorXd::Ones(time.size()), time;
  return columns;
}

RampPiece fit_piece(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  RampPiece piece;
  piece.x = hydro::dense::PivotedQr(columns).solve(values);
  piece.fitted = columns * piece.x;
  const Eigen::VectorXd left = values - piece.fitted;
  piece.squares = left.squaredNorm();
  if (left.squaredNorm() > 1e-24 * values.squaredNorm()) {
    piece.u = correlated_covariance(columns, left, 1, LongMemory::widen);
    return piece;
  }
  const Eigen::Index p = columns.cols();  // made by the model itself: rounding has no memory to measure
  piece.u.covariance = piece.u.white_covariance = Eigen::MatrixXd::Zero(p, p);
  piece.u.effective_samples = Eigen::VectorXd::Constant(p, static_cast<double>(values.size()));
  piece.u.dof = piece.u.white_dof = static_cast<double>(values.size() - p);
  piece.u.dof_raised = false;
  return piece;
}

/// The interval of a level with a part that does not average out; (F26).
void widen(Coefficient& c, double systematic, double confidence) {
  const double half = (c.interval.high - c.interval.low) / 2,
               more = hydro::signal::normal_quantile((1 + confidence) / 2) * systematic, all = std::hypot(half, more);
  c.systematic_error = systematic;
  c.standard_error = std::hypot(c.standard_error, systematic);
  c.interval = {*c.value - all, *c.value + all};
}

/// Both levels are independent: variances add up, degrees of freedom as Welch and Satterthwaite have them.
Coefficient difference(const RampPiece& ramp, const RampPiece& slide, double confidence) {
  const double a = ramp.u.covariance(0, 0), b = slide.u.covariance(0, 0);
  Coefficient c;
  c.name = "drop";
  c.value = ramp.x[0] - slide.x[0];
  c.standard_error = std::sqrt(a + b);
  const double dof = a + b > 0 ? (a + b) * (a + b) / (a * a / ramp.u.dof + b * b / slide.u.dof) : ramp.u.dof,
               half = hydro::signal::student_t_quantile((1 + confidence) / 2, dof) * c.standard_error;
  c.interval = c.white_interval = {*c.value - half, *c.value + half};
  return c;
}

void turn(Coefficient& c) {
  if (c.value) *c.value = -*c.value;
  for (Interval* i : {&c.interval, &c.white_interval}) *i = {-i->high, -i->low};
}

}  // namespace

FrictionRamp fit_friction_ramp(std::span<const double> time, std::span<const double> torque,
                               const FrictionRampOptions& options) {  // (F52)
  hydro::require(time.size() == torque.size(), "{} times but {} torques", time.size(), torque.size());
  hydro::require(options.confidence > 0 && options.confidence < 1,
                 "a confidence level must lie between 0 and 1, got {}", options.confidence);
  const double step = hydro::signal::even_step(time);
  double sense = 0;
  for (const double v : torque) {
    hydro::require(std::isfinite(v), "a torque is not finite");
    sense += v * std::abs(v);
  }
  const double sign = sense < 0 ? -1 : 1;
  const auto samples = [&](double s) { return static_cast<std::size_t>(std::lround(std::max(0.0, s) / step)); };
  const RampPieces p{samples(options.ramp_s), samples(options.drop_s), samples(options.slide_s)};
  hydro::require(p.ramp >= 16 && p.slide >= 16, "ramp and slide need 16 samples at least, they have {} and {}", p.ramp,
                 p.slide);
  hydro::require(p.all() <= torque.size(), "ramp, drop and slide take {} samples, the record has {}", p.all(),
                 torque.size());
  std::vector<double> grown(torque.begin(), torque.end());
  for (double& v : grown) v *= sign;
  const std::size_t from = find_slip(grown, p);

  FrictionRamp result;
  result.slip_s = time[from + p.ramp - 1] + p.beyond() * step;
  const auto piece = [&](std::size_t first, std::size_t count, std::vector<double>& t) {
    t.assign(time.begin() + static_cast<std::ptrdiff_t>(first),
             time.begin() + static_cast<std::ptrdiff_t>(first + count));
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(t.data(), std::ssize(t)).array() - result.slip_s);
  };
  const auto values = [&](std::size_t first, std::size_t count) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(grown.data() + first, static_cast<Eigen::Index>(count)));
  };
  const std::size_t after = from + p.ramp + p.drop;
  const auto count = static_cast<Eigen::Index>(p.slide);
  const RampPiece ramp = fit_piece(line_columns(piece(from, p.ramp, result.line_time)), values(from, p.ramp)),
                  slide = fit_piece(Eigen::MatrixXd::Ones(count, 1), values(after, p.slide)),
                  trend = fit_piece(line_columns(piece(after, p.slide, result.slide_time)), values(after, p.slide));
  result.rate = sign * ramp.x[1];
  result.slide_rate = sign * trend.x[1];
  result.static_level = with_interval("static", ramp.x[0], ramp.u, 0, options.confidence);
  result.dynamic_level = with_interval("dynamic", slide.x[0], slide.u, 0, options.confidence);
  result.drop = difference(ramp, slide, options.confidence);
  // The slip is somewhere within the drop and the sample beside it: an even distribution.
  const double unsure = ramp.x[1] * 2 * p.beyond() * step / std::sqrt(12.0);
  for (Coefficient* c : {&result.static_level, &result.drop}) widen(*c, unsure, options.confidence);
  hydro::require(
      result.drop.interval.low > 0,
      "after {:.4g} s the torque falls by {:.3g} with an error of {:.2g}, which may be none: the joint has not "
      "slipped, or both levels are one",
      result.slip_s, *result.drop.value, result.drop.standard_error);
  const double t = hydro::signal::student_t_quantile((1 + options.confidence) / 2, trend.u.dof);
  result.residual_rms = std::sqrt((ramp.squares + slide.squares) / static_cast<double>(p.ramp + p.slide));
  if (ramp.u.dof_raised || slide.u.dof_raised)
    result.caution =
        "what a piece leaves over hardly forgets within it: it is no straight line, or no constant, more than noise, "
        "which no interval made from scatter covers";
  if (std::abs(trend.x[1]) > t * std::sqrt(trend.u.covariance(1, 1)) &&
      std::abs(trend.x[1]) * options.slide_s > 0.05 * std::abs(slide.x[0]))
    result.caution = fmt::format(
        "while it slides the torque changes by {:.2g} a second: the dynamic level is no constant, and its interval is "
        "that of a mean over the slide",
        result.slide_rate);
  for (const auto& [fitted, out] : {std::pair{&ramp.fitted, &result.line}, {&slide.fitted, &result.slide}})
    for (const double v : *fitted) out->push_back(sign * v);
  if (sign < 0)
    for (Coefficient* c : {&result.static_level, &result.dynamic_level}) turn(*c);
  return result;
}

}  // namespace fit
