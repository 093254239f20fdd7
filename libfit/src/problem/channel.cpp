#include "fit/problem/channel.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "telling.hpp"

namespace fit::channel {
namespace {

Report told(const Run& run, const ChannelLine& line, const Problem& problem) {
  const std::string &v = problem.reading_unit, &x = problem.reference_unit,
                    per = v.empty() && x.empty() ? "" : v + "/" + x;
  const double slope = std::abs(*line.slope.value);
  Report report = begin_run(run.source);
  report.heading =
      fmt::format("{}: {} points; reading = offset + slope x reference", run.source.name(), run.points.reading.size());
  report.facts.emplace_back("points", run.points.reading.size());
  report.estimates = {{line.slope, per}, {line.offset, v}};
  if (line.drift) report.estimates.push_back({*line.drift, (v.empty() ? std::string("1") : v) + "/s"});
  append(report.facts, {{"residual_deviation", line.residual_deviation}, {"nonlinearity", line.nonlinearity}});
  report.say("points lie {:.3g} {} about the line, {:.2g} {} of the reference; the furthest {:.2g} % of the range",
             line.residual_deviation, v, line.residual_deviation / slope, x, 100 * line.nonlinearity);
  if (line.hysteresis) {
    append(report.facts, {{"hysteresis", *line.hysteresis}, {"pairs", line.pairs}});
    report.say("hysteresis: {:.2g} % of the range, {:.2g} {} of the reference, at {} references from both sides",
               100 * *line.hysteresis, *line.hysteresis * line.range / slope, x, line.pairs);
  } else {
    report.say("hysteresis: not known, no reference was reached from both sides");
  }
  if (line.steps) {
    append(report.facts, {{"step", line.steps->step}, {"levels", line.steps->levels}});
    report.say("steps: the channel knows {} levels, {:.3g} {} apart, {:.2g} {} of the reference: a noise of {:.2g} {}",
               line.steps->levels, line.steps->step, v, line.steps->step / slope, x, line.steps->noise() / slope, x);
  }
  if (line.drift && line.drift->value) {
    const double whole = *line.drift->value * (run.points.time.back() - run.points.time.front());
    report.warn(
        fmt::format("the channel drifts by {:.2g} {} while it is calibrated, {:.2g} {} of the reference: take a "
                    "zero before each run",
                    whole, v, std::abs(whole) / slope, x));
  }
  if (line.nonlinearity > 0.02)
    report.warn(
        fmt::format("a point lies {:.2g} % of the range off the line: the channel is not straight, or a point "
                    "is wrong",
                    100 * line.nonlinearity));
  return report;
}

/// What series differ by: a line of each was taken on another day, or after the runs.
void compare(const std::vector<ChannelLine>& lines, const Problem& problem, Report& report) {
  const auto [low, high] = std::minmax_element(
      lines.begin(), lines.end(), [](const auto& a, const auto& b) { return *a.slope.value < *b.slope.value; });
  const double change = *high->slope.value - *low->slope.value,
               error = std::hypot(high->slope.standard_error, low->slope.standard_error);
  report.facts.emplace_back("slope_change", change);
  report.say("slopes of the {} series differ by {:.2g} {}/{}, {:.2g} %, {:.2g} times their standard errors",
             lines.size(), change, problem.reading_unit, problem.reference_unit,
             100 * std::abs(change / *low->slope.value), error > 0 ? change / error : 0.0);
  if (change > 3 * error)
    report.warn("the slopes of the series differ by more than their errors: the channel changed between them");
}

}  // namespace

Solution solve(const Problem& problem) {
  hydro::require(!problem.runs.empty(), "a calibration needs one series of points at least");
  Solution out;
  for (const Run& run : problem.runs) {
    out.lines.push_back(of_run(run.source, [&] { return fit_channel_line(run.points, problem.options.confidence); }));
    out.report.parts.push_back(told(run, out.lines.back(), problem));
  }
  if (out.lines.size() > 1) compare(out.lines, problem, out.report);
  return out;
}

}  // namespace fit::channel
