#include "fit/delay.hpp"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "convolve.hpp"
#include "cubic.hpp"
#include "fit/differentiate.hpp"
#include "fit/morison.hpp"
#include "fit/verdict.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/welch.hpp"
#include "morison_columns.hpp"

namespace fit {
namespace {

std::vector<double> middle(const std::vector<double>& v, std::size_t margin) {
  const auto cut = static_cast<std::ptrdiff_t>(margin);
  return {v.begin() + cut, v.end() - cut};
}

/// The whole number of samples by which the force lags, from the best of all least-squares fits; (F24). `carried` is
/// what the load cells carry whatever the coefficients are.
std::ptrdiff_t nearest_lag(const Eigen::MatrixXd& columns, const Eigen::VectorXd& carried,
                           const std::vector<double>& force, std::size_t longest) {
  const Eigen::Matrix2d inverse = (columns.transpose() * columns).inverse();
  const std::size_t n = static_cast<std::size_t>(columns.rows());
  const Eigen::Vector2d known = columns.transpose() * carried;
  std::vector<double> b[2];
  for (Eigen::Index i = 0; i < 2; ++i) b[i] = sliding_sum(force, {columns.col(i).data(), n});
  const std::vector<double> with = sliding_sum(force, {carried.data(), n});
  double squares = carried.squaredNorm(), least = 0;
  for (std::size_t j = 0; j < n; ++j) squares += force[j] * force[j];
  std::ptrdiff_t best = -1;
  for (std::size_t k = 0; k < b[0].size(); ++k) {
    const Eigen::Vector2d right = Eigen::Vector2d(b[0][k], b[1][k]) - known, x = inverse * right;
    const double rest = squares - 2 * with[k] - right.dot(x);
    if (x[0] > 0 && (best < 0 || rest < least)) {  // drag does not push backwards
      least = rest;
      best = static_cast<std::ptrdiff_t>(k);
    }
    if (k + n < force.size()) squares += force[k + n] * force[k + n] - force[k] * force[k];
  }
  hydro::require(best >= 0, "at no delay up to {} samples does the drag push against the motion: look at the signs",
                 longest);
  return best - static_cast<std::ptrdiff_t>(longest);
}

/// −d/dt of the force that the coefficients give, by local polynomials that are right within 1 % up to three times the
/// main frequency. Noise of the motion goes through the columns into that force, and a rate of more bandwidth would be
/// mostly noise. The ends have central differences, the last samples those of their neighbours.
Eigen::VectorXd minus_rate(const Eigen::VectorXd& force, double step, double period) {
  constexpr double reach = 0.087;  // of the period: half a window that keeps 99 % of the third harmonic's rate
  const Eigen::Index n = force.size(), half = std::clamp<Eigen::Index>(std::lround(reach * period / step), 3, n / 8);
  Eigen::VectorXd rate(n);
  rate.segment(1, n - 2) = (force.head(n - 2) - force.tail(n - 2)) / (2 * step);
  rate[0] = rate[1];
  rate[n - 1] = rate[n - 2];
  const auto middle =
      LocalPolynomial(1, static_cast<int>(half), step).apply({force.data(), static_cast<std::size_t>(n)});
  rate.segment(half, n - 2 * half) = -as_vector(middle);
  return rate;
}

/// The linear problem for drag, inertia and a delay of the force, with what noise of the motion takes off it put back
/// (F68): noise of the acceleration makes least squares find too little inertia, and a delay then takes the place of
/// what is missing (F115). The coefficients follow at once; only the delay is searched for.
class DelayEquations {
 public:
  DelayEquations(const Cylinder& cylinder, const ForceRecord& record, double step, double period)
      : columns_(morison_columns(cylinder, record)),
        carried_(carried_force(cylinder, record)),
        step_(step),
        period_(period) {
    const MorisonColumns at(MorisonOptions{}, false);
    for (const MotionError& e : record.motion_errors) {
      Eigen::MatrixXd errors(columns_.rows(), 6);
      errors.leftCols<2>() = column_errors(cylinder, e, at);
      errors.col(2) = carried_error(cylinder, e);
      for (Eigen::Index k = 0; k < 3; ++k) errors.col(3 + k) = minus_rate(errors.col(k), step, period);
      rate_errors_.emplace_back(errors.rightCols<3>());
      gram_ += errors.transpose() * errors / static_cast<double>(record.motion_errors.size());
    }
    // So much noise is refused with the fit itself.
    if ((gram_.diagonal().head(2).array() > 0.5 * columns_.colwise().squaredNorm().transpose().array()).any())
      gram_.setZero();
  }

  const Eigen::MatrixXd& columns() const { return columns_; }
  const Eigen::VectorXd& carried() const { return carried_; }

  /// −d/dt of the force that the coefficients of a measured one give.
  DelayColumn column_for(const Eigen::VectorXd& force) const {
    const Eigen::Vector3d parts = parts_for(force);
    DelayColumn out{minus_rate(carried_ + columns_ * parts.head<2>(), step_, period_), {}};
    for (const Eigen::MatrixXd& errors : rate_errors_) out.errors.emplace_back(errors * parts);
    return out;
  }

  /// By how much a measured force is later than the motion, to first order, s.
  double delay_in(const Eigen::VectorXd& force) const {
    const Eigen::Vector3d parts = parts_for(force);
    Eigen::MatrixXd all(columns_.rows(), 3);
    all << columns_, minus_rate(carried_ + columns_ * parts.head<2>(), step_, period_);
    Eigen::Matrix<double, 6, 3> errors = Eigen::Matrix<double, 6, 3>::Zero();
    errors.topLeftCorner<2, 2>().setIdentity();
    errors.col(2).tail<3>() = parts;
    return solved(all, errors, force)[2];
  }

 private:
  /// C_D, the inertia coefficient, and one of what is carried.
  Eigen::Vector3d parts_for(const Eigen::VectorXd& force) const {
    Eigen::Matrix<double, 6, 2> errors = Eigen::Matrix<double, 6, 2>::Zero();
    errors.topRows<2>().setIdentity();
    const Eigen::VectorXd x = solved(columns_, errors, force);
    return {x[0], x[1], 1};
  }

  /// Least squares whose columns have errors that are those combinations of what the draws hold: AᵀA less the mean of
  /// δAᵀδA, and the mean of δAᵀδc beside what is carried.
  Eigen::VectorXd solved(const Eigen::MatrixXd& all, const Eigen::MatrixXd& errors,
                         const Eigen::VectorXd& force) const {
    const Eigen::VectorXd target = force - carried_;
    if (gram_.isZero(0)) return hydro::dense::HouseholderQr(all).solve(target);
    const Eigen::MatrixXd normal = all.transpose() * all - errors.transpose() * gram_ * errors;
    return hydro::dense::PivotedQr(normal).solve(
        Eigen::VectorXd(all.transpose() * target + errors.transpose() * gram_.col(2)));
  }

  Eigen::MatrixXd columns_;
  Eigen::VectorXd carried_;
  double step_, period_;
  std::vector<Eigen::MatrixXd> rate_errors_;  // of minus_rate() of both columns and of what is carried, for each draw
  Eigen::MatrixXd gram_ = Eigen::MatrixXd::Zero(6, 6);  // mean over the draws; those rates after what they are of
};

/// Where `step_at`, samples that a Gauss–Newton step would go from a lag, changes from forward to backward: the one
/// root about `first`. At a bound that a step would cross: the bound.
struct FoundLag {
  double lag;
  bool beyond;
};
template <class F>
FoundLag find_lag(F step_at, double first, double longest, double step) {
  double low = first, high = first, at_low = step_at(first), at_high = at_low;
  // Outwards by ever longer strides: noise of the samples may have put the whole number a few beside the root.
  for (double stride = 1; at_low < 0; stride *= 2) {
    if (low == -longest) return {low, true};
    high = low, at_high = at_low;
    low = std::max(low - stride, -longest);
    at_low = step_at(low);
  }
  for (double stride = 1; at_high > 0; stride *= 2) {
    if (high == longest) return {high, true};
    low = high, at_low = at_high;
    high = std::min(high + stride, longest);
    at_high = step_at(high);
  }
  constexpr int most_rounds = 100;  // regula falsi after the Illinois rule takes some ten, halving 30
  constexpr double enough = 1e-6;   // of a sample: far below what any noise leaves of a delay
  for (int round = 0, kept = 0; round < most_rounds; ++round) {
    if (at_low == 0 || high - low < enough) return {at_low == 0 ? low : high, false};
    if (at_high == 0) return {high, false};
    const double between = (low * at_high - high * at_low) / (at_high - at_low), at_between = step_at(between);
    if (std::abs(at_between) < enough) return {between, false};
    if (at_between > 0) {
      low = between, at_low = at_between;
      if (kept == 1) at_high /= 2;  // an end that stays is counted half, or it would stay for ever
      kept = 1;
    } else {
      high = between, at_high = at_between;
      if (kept == -1) at_low /= 2;
      kept = -1;
    }
  }
  throw SearchFailed(fmt::format("the search for the delay has no end: its steps do not settle between {:.4g} s and "
                                 "{:.4g} s",
                                 low * step, high * step),
                     0);
}

/// A delay that lies beyond the longest, and all that goes with it.
void withhold_beyond(double delay_s, MorisonFit& fit) {
  const std::string why = fmt::format(
      "the force is told best by a delay of {:.4g} s or beyond, and no longer one is looked for (longest_delay)",
      delay_s);
  withhold(fit.cd, why);
  withhold(fit.inertia, why);
  for (auto* c : {&fit.linear_drag, &fit.offset, &fit.delay})
    if (*c) withhold(**c, why);
  for (FittedLine& line : fit.lines) withhold(line.amplitude, why);
  fit.fit_band.clear();
  fit.sample_band.clear();
}

}  // namespace

std::vector<double> later(std::span<const double> values, double lag, std::size_t margin) {  // (F24)
  hydro::require(values.size() > 2 * margin && static_cast<double>(margin) >= std::abs(lag) + 2,
                 "{} samples cannot be moved by {:.4g}", values.size(), lag);
  const double whole = std::floor(lag), s = lag - whole;
  std::vector<double> out(values.size() - 2 * margin);
  for (std::size_t j = 0; j < out.size(); ++j) {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(j + margin) + static_cast<std::ptrdiff_t>(whole);
    out[j] = cubic_between(values.data() + at, s);
  }
  return out;
}

DelayedFit fit_morison_and_delay(const Cylinder& cylinder, const ForceRecord& record, double longest_s,
                                 const MorisonOptions& options) {  // (F24)
  const double step = hydro::signal::even_step(record.time);
  hydro::require(longest_s > 0 && std::isfinite(longest_s), "the longest delay must be positive, got {} s", longest_s);
  const auto longest = static_cast<std::size_t>(std::ceil(longest_s / step)), margin = longest + 3;
  hydro::require(record.time.size() > 2 * margin + 32,
                 "a record of {} samples is too short for delays up to {} samples", record.time.size(), longest);
  DelayedFit result;
  ForceRecord& aligned = result.aligned;
  aligned = {middle(record.time, margin), {}, middle(record.velocity, margin), middle(record.acceleration, margin), {}};
  if (!record.drag_flow.empty()) aligned.drag_flow = middle(record.drag_flow, margin);
  if (!record.water_acceleration.empty()) aligned.water_acceleration = middle(record.water_acceleration, margin);
  if (!record.linear_flow.empty()) aligned.linear_flow = middle(record.linear_flow, margin);
  for (MotionError e : record.motion_errors) {
    for (auto* c : {&e.velocity, &e.acceleration, &e.water_acceleration, &e.drag_flow, &e.linear_flow})
      if (!c->empty()) *c = middle(*c, margin);
    aligned.motion_errors.push_back(std::move(e));
  }
  for (const std::vector<double>& draw : record.rounding) aligned.rounding.push_back(middle(draw, margin));
  MorisonOptions inner = options;
  for (ForceError& e : inner.force_errors) e.force = middle(e.force, margin);

  const auto [u2, a2] = flow_squares(aligned, Eigen::ArrayXd::Ones(std::ssize(aligned.velocity)));
  const double period = 2 * std::numbers::pi * std::sqrt(u2 / a2);
  const DelayEquations equations(cylinder, aligned, step, period);
  const std::ptrdiff_t first = nearest_lag(equations.columns(), equations.carried(), middle(record.force, 3), longest);
  const auto step_at = [&](double lag) {
    aligned.force = later(record.force, lag, margin);
    return equations.delay_in(as_vector(aligned.force)) / step;
  };
  const auto [lag, beyond] = find_lag(step_at, static_cast<double>(first), static_cast<double>(longest), step);
  aligned.force = later(record.force, lag, margin);
  const DelayColumn column = equations.column_for(as_vector(aligned.force));
  result.fit = fit_columns(cylinder, aligned, inner, &column);
  Coefficient& delay = *result.fit.delay;
  const double shift = lag * step;
  for (Interval* i : {&delay.interval, &delay.white_interval}) *i = {i->low + shift, i->high + shift};
  if (delay.value) *delay.value += shift;
  if (beyond) withhold_beyond(shift, result.fit);
  return result;
}

}  // namespace fit
