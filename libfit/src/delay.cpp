#include "fit/delay.hpp"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "convolve.hpp"
#include "cubic.hpp"
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

/// −d/dt of the force that the coefficients give, by central differences; the ends repeat their neighbours.
Eigen::VectorXd minus_rate(const Eigen::VectorXd& force, double step) {
  const Eigen::Index n = force.size();
  Eigen::VectorXd rate(n);
  rate.segment(1, n - 2) = (force.head(n - 2) - force.tail(n - 2)) / (2 * step);
  rate[0] = rate[1];
  rate[n - 1] = rate[n - 2];
  return rate;
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

  const Eigen::MatrixXd columns = morison_columns(cylinder, aligned);
  const Eigen::VectorXd carried = carried_force(cylinder, aligned);
  const auto fitted = [&] {
    return Eigen::VectorXd(carried +
                           columns * hydro::dense::HouseholderQr(columns).solve(as_vector(aligned.force) - carried));
  };
  double lag = static_cast<double>(nearest_lag(columns, carried, middle(record.force, 3), longest));
  // Gauss–Newton on the delay; the coefficients are linear and follow at once.
  constexpr int most_rounds = 30;
  bool beyond = false;
  for (int round = 0;; ++round) {
    const double bounded = std::clamp(lag, -static_cast<double>(longest), static_cast<double>(longest));
    beyond = lag != bounded;
    lag = bounded;
    if (round == most_rounds && !beyond)
      throw SearchFailed(
          fmt::format("the search for the delay has no end: its steps do not settle about {:.4g} s", lag * step), 0);
    aligned.force = later(record.force, lag, margin);
    if (round == most_rounds) break;
    Eigen::MatrixXd all(columns.rows(), 3);
    all << columns, Eigen::VectorXd::Zero(columns.rows());
    all.col(2) = minus_rate(fitted(), step);
    const double change = hydro::dense::HouseholderQr(all).solve(as_vector(aligned.force) - carried)[2] / step;
    if (std::abs(change) < 1e-6) break;
    lag += std::clamp(change, -5.0, 5.0);
  }
  const Eigen::VectorXd column = minus_rate(fitted(), step);
  result.fit = fit_columns(cylinder, aligned, inner, &column);
  Coefficient& delay = *result.fit.delay;
  const double shift = lag * step;
  for (Interval* i : {&delay.interval, &delay.white_interval}) *i = {i->low + shift, i->high + shift};
  if (delay.value) *delay.value += shift;
  if (beyond) withhold_beyond(shift, result.fit);
  return result;
}

}  // namespace fit
