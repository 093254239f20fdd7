#include "towing_records.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "fit/parts.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "telling.hpp"

namespace fit::towing {
namespace {

std::span<const double> part_of(const std::vector<double>& values, Stretch part) {
  return std::span(values).subspan(part.from, part.size());
}

/// Samples from one time to another, both included.
Stretch span_of(const std::vector<double>& time, const WindowChoice& window) {
  const auto from = std::lower_bound(time.begin(), time.end(), window.from),
             to = std::upper_bound(time.begin(), time.end(), window.to);
  hydro::require(
      from < to && window.from >= time.front() && window.to <= time.back(),
      "the window from {:.4g} s to {:.4g} s does not lie in what is left of the record, {:.4g} s to {:.4g} s",
      window.from, window.to, time.front(), time.back());
  return {static_cast<std::size_t>(from - time.begin()), static_cast<std::size_t>(to - time.begin())};
}

/// Where speed and force have settled within the stretch of even speed. (F91)
Stretch settled(const PreparedTow& tow, Stretch even) {
  const auto speed = settled_from(part_of(tow.speed, even)), force = settled_from(part_of(tow.force, even));
  for (const auto& [name, from] : {std::pair{"speed", speed}, {"force", force}})
    if (!from)
      throw hydro::InputError(
          fmt::format("the {} does not settle between {:.4g} s and {:.4g} s: its mean becomes better known the more of "
                      "that is left out, up to the half of it",
                      name, tow.time[even.from], tow.time[even.to - 1]),
          {}, "tow for longer, or name the steady part: [prepare] window = { kind = \"span\", from = …, to = … }");
  return {even.from + std::max(*speed, *force), even.to};
}

/// Standard error of the mean over a rest of `duration_s` whose noise has the correlation time θ, e^{−t/θ}: the mean
/// has the share r = (2θ/T)(1 − (θ/T)(1 − e^{−T/θ})) of its variance, and scatter about the mean is the rest of it. A
/// short rest tells little of θ by itself, so that it is the steady part's, and one of less than ten θ little of its
/// scatter, which is then no less than the steady part's. Scatter about the mean of that is too small too, and so is a
/// correlation time from n samples that are independent, by 5/2n of itself; (F93).
double error_of_rest(const SteadyMean& rest, const SteadyMean& towed, double duration_s, double theta_s) {
  const double few = std::min(0.5, 1 / towed.effective_samples), x = theta_s * (1 + 2.5 * few) / duration_s,
               share = 2 * x * (1 - x * -std::expm1(-1 / x));
  double deviation = rest.deviation / std::sqrt(1 - share);
  if (10 * x > 1) deviation = std::max(deviation, towed.deviation / std::sqrt(1 - few));
  return std::max(rest.error, deviation * std::sqrt(share));
}

/// Takes the force at rest off. Filters reach over the start of the motion, and a carriage shakes before it moves: what
/// comes just before it is left out.
void take_rest(const Tow& tow, Stretch steady, PreparedTow& p) {
  const double margin_s = std::max(1.0, p.filter_reach_s);
  const auto margin = static_cast<std::size_t>(margin_s / p.step);
  const std::size_t rest = tow.motion.from > margin ? tow.motion.from - margin : 0;
  if (rest < 64 || static_cast<double>(rest) * p.step < 1)
    throw hydro::InputError(
        fmt::format(
            "the carriage is at rest for {:.3g} s before it starts, and {:.3g} s of that are left out: too little "
            "to take the zero of the force from",
            static_cast<double>(tow.motion.from) * p.step, margin_s),
        {}, "name a run at rest, [data] zero = \"zero.csv\", or begin to record earlier");
  const SteadyMean zero = steady_mean(std::span(p.force).first(rest)), towed = steady_mean(part_of(p.force, steady));
  const double theta = p.step * static_cast<double>(steady.size()) / towed.effective_samples / 2,
               error = error_of_rest(zero, towed, static_cast<double>(rest) * p.step, theta);
  for (double& f : p.force) f -= zero.value;
  for (ForceChannel& c : p.channels) {
    const double own = steady_mean(std::span(c.values).first(rest)).value;
    for (double& f : c.values) f -= own;
  }
  p.zero_errors = {error};
  p.steps.push_back(fmt::format("zero: {:.4g} N ± {:.2g} N taken off, the mean of the force at rest until {:.4g} s",
                                zero.value, error, p.time[rest - 1]));
}

void require_long(Stretch steady) {
  hydro::require(steady.size() >= 64, "the window holds {} samples: a steady part needs 64 at least", steady.size());
}

/// Finds the steady part and takes the zero off.
Stretch steady_part(PreparedTow& p, const Options& options) {
  const bool named = options.prepare.window.kind == WindowChoice::Kind::span;
  Stretch steady{};
  if (named) steady = span_of(p.time, options.prepare.window);
  if (!named || options.zero_at_rest) {
    const Tow tow = find_tow(p.speed, options.tolerance);
    if (!named) {
      steady = settled(p, tow.even_speed);
      p.steps.push_back(fmt::format(
          "steady part: the carriage moves from {:.4g} s to {:.4g} s, within {:g} % of {:.4g} m/s from {:.4g} s on; "
          "speed and force have settled from {:.4g} s to {:.4g} s",
          p.time[tow.motion.from], p.time[tow.motion.to - 1], 100 * options.tolerance, tow.speed,
          p.time[tow.even_speed.from], p.time[steady.from], p.time[steady.to - 1]));
      if (tow.moves_again)
        p.cautions.push_back(fmt::format("the carriage moves again as fast after {:.4g} s: only the first tow is taken",
                                         p.time[tow.motion.to - 1]));
    }
    require_long(steady);
    if (options.zero_at_rest) take_rest(tow, steady, p);
  }
  require_long(steady);
  return steady;
}

/// What does not average out within a record, N. Of a cell's loop half the width on either side of the line, even in
/// between: a deviation of 1/√3 of the half, (F26).
struct ForceErrors {
  double zero = 0, own = 0, common = 0;
};
ForceErrors errors_of(const PreparedTow& p, Stretch steady) {
  ForceErrors out;
  for (const double e : p.zero_errors) out.zero = std::hypot(out.zero, e);
  for (const ForceChannel& f : p.channels) {
    if (!f.calibration) continue;
    const Calibration& c = *f.calibration;
    double mean = 0;
    for (const double v : part_of(f.values, steady)) mean += v / static_cast<double>(steady.size());
    out.own = std::hypot(out.own, c.hysteresis * c.range / std::abs(c.slope) / (2 * std::sqrt(3.0)));
    out.common = std::hypot(out.common, mean * c.slope_error / c.slope);
  }
  return out;
}

/// C_D of the means with all that its error is made of. (F93)
void add_coefficient(const Problem& problem, RecordedTow& r) {
  const Cylinder& c = problem.cylinder;
  const CylinderErrors& e = problem.options.errors;
  const auto point = [&](double force_error, double speed_error) {
    return towing_point(c, {r.speed.value, speed_error, r.force.value, force_error});
  };
  const ForceErrors errors = errors_of(r.prepared, r.steady);
  // The zero is known by the scatter of the same noise: Student's t is that of the force.
  const TowingPoint scatter = point(std::hypot(r.force.error, errors.zero), r.speed.error), own = point(errors.own, 0),
                    slope = point(errors.common, 0);
  r.re = scatter.re;
  const double common = std::hypot(
      slope.cd_deviation, scatter.cd * std::hypot(e.diameter / c.diameter, e.length / c.length, e.density / c.density),
      2 * scatter.cd * problem.options.speed_slope.standard);  // C_D ~ U⁻² (F105)
  const double t = hydro::signal::student_t_quantile((1 + problem.options.confidence) / 2, r.force.dof);
  r.cd = with_parts("cd", scatter.cd, scatter.cd_deviation, t, std::hypot(own.cd_deviation, common),
                    problem.options.confidence);
  r.cd.systematic_error = common;  // of runs together the zero and the loop of each are scatter
  r.cd.effective_samples = r.force.effective_samples;
  const double white = r.samples.deviation / std::sqrt(static_cast<double>(r.steady.size())) *
                       hydro::signal::normal_quantile((1 + problem.options.confidence) / 2);
  r.cd.white_interval = {scatter.cd - white, scatter.cd + white};
}

RecordedTow recorded(const Problem& problem, const Record& record) {
  RecordedTow out{.prepared = prepare_towing(record.raw, problem.options.prepare),
                  .steady = {},
                  .speed = {},
                  .force = {},
                  .samples = {},
                  .box = {},
                  .cd = {},
                  .re = {}};
  PreparedTow& p = out.prepared;
  out.steady = steady_part(p, problem.options);
  out.speed = steady_mean(part_of(p.speed, out.steady));
  out.force = steady_mean(part_of(p.force, out.steady));
  if (!(out.force.value > 0))
    throw hydro::InputError(
        fmt::format("the force is {:.4g} N where the carriage moves at {:.4g} m/s: it has the wrong "
                    "sign, or the wrong zero",
                    out.force.value, out.speed.value),
        {}, fmt::format("write \"-{}\" among the channels to turn it", p.channels[0].name));
  std::vector<double> samples;
  for (std::size_t i = out.steady.from; i < out.steady.to; ++i)
    samples.push_back(drag_coefficient(problem.cylinder, p.speed[i], p.force[i]));
  out.samples = steady_mean(samples);
  out.box = box_of(std::move(samples));
  add_coefficient(problem, out);
  for (const auto& [name, unit, mean] : {std::tuple{"speed", "m/s", &out.speed}, {"force", "N", &out.force}})
    if (std::abs(mean->drift) > 3 * mean->drift_error)
      p.cautions.push_back(fmt::format(
          "the {} drifts by {:.2g} {} over the steady part, {:.2g} of its mean: the interval does not cover that", name,
          mean->drift, unit, std::abs(mean->drift / mean->value)));
  return out;
}

Facts facts_of(const SteadyMean& mean) {
  return {{"mean", mean.value},
          {"deviation", mean.deviation},
          {"coefficient_of_variation", mean.coefficient_of_variation()},
          {"standard_error", mean.error},
          {"drift", mean.drift},
          {"drift_error", mean.drift_error},
          {"effective_samples", mean.effective_samples}};
}

Facts facts_of(const Box& box) {
  return {{"lower_quartile", box.lower_quartile},
          {"median", box.median},
          {"upper_quartile", box.upper_quartile},
          {"low", box.low},
          {"high", box.high},
          {"outliers", box.outliers.size()}};
}

Report told(const Source& source, const RecordedTow& r) {
  Report report = begin_run(source);
  const auto& p = r.prepared;
  report.heading = fmt::format("{}: {:.4g} m/s, coefficient of variation {:.2f} %; {:.4g} N, {:.2f} %{}", source.name(),
                               r.speed.value, 100 * r.speed.coefficient_of_variation(), r.force.value,
                               100 * r.force.coefficient_of_variation(), r.re ? fmt::format("; Re {:.3g}", *r.re) : "");
  append(report.facts, {{"from_s", p.time[r.steady.from]},
                        {"to_s", p.time[r.steady.to - 1]},
                        {"speed", facts_of(r.speed)},
                        {"force", facts_of(r.force)},
                        {"cd_of_samples", facts_of(r.samples)},
                        {"cd_box", facts_of(r.box)}});
  if (r.re) report.facts.emplace_back("re", *r.re);
  report.estimates = {{.coefficient = r.cd}};
  report.say(
      "single samples of cd: mean {:.4g}, deviation {:.2g}, coefficient of variation {:.2f} %; the mean has a "
      "deviation of {:.2g} from scatter and {:.2g} in all",
      r.samples.value, r.samples.deviation, 100 * r.samples.coefficient_of_variation(), r.samples.error,
      r.cd.standard_error);
  report.say(
      "half of them lie between {:.4g} and {:.4g} about the median {:.4g}, all but {} outliers between {:.4g} and "
      "{:.4g}",
      r.box.lower_quartile, r.box.upper_quartile, r.box.median, r.box.outliers.size(), r.box.low, r.box.high);
  report.steps = p.steps;
  report.cautions = p.cautions;
  return report;
}

/// Three records and more: their mean, with what runs differ by beyond their own errors, and what is the same in all.
Report told_law(const Problem& problem, Solution& out) {
  std::vector<Coefficient> runs;
  for (const RecordedTow& r : out.records) runs.push_back(r.cd);
  out.law = together(runs, files_of(problem.records), problem.options.confidence);
  return over_runs("cd", "", *out.law, "run", runs.size(), problem.options.confidence);
}

}  // namespace

Solution solve_records(const Problem& problem) {
  hydro::require(problem.runs.empty(), "a problem of towing has means or records, not both");
  Solution out;
  Report& report = out.report;
  for (const Record& record : problem.records) {
    out.records.push_back(of_run(record.source, [&] { return recorded(problem, record); }));
    report.parts.push_back(told(record.source, out.records.back()));
  }
  report.heading = "C_D = F/(1/2 rho U^2 D L) of the means over the steady part";
  Facts coefficients;
  if (out.records.size() >= 3) {
    Report together = told_law(problem, out);
    coefficients.emplace_back("cd", out.law->coefficients[0]);
    report.parts.push_back(std::move(together));
  } else if (out.records.size() == 1) {
    coefficients.emplace_back("cd", *out.records[0].cd.value);
  }
  if (!coefficients.empty()) report.facts.emplace_back("coefficients", std::move(coefficients));
  return out;
}

}  // namespace fit::towing
