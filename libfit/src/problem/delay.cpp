#include "fit/problem/delay.hpp"

#include <algorithm>

#include "telling.hpp"

namespace fit::delay {
namespace {

constexpr double by_chance = 0.01;

FittedRun fitted(const Run& run, const Options& options) {
  FittedRun out;
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    if (options.window && (run.time[i] < options.window->first || run.time[i] > options.window->second)) continue;
    out.time.push_back(run.time[i]);
    out.first.push_back(run.first.at(i));
  }
  constexpr std::size_t fewest = 16;
  if (options.window && out.time.size() < fewest)
    throw hydro::InputError(
        fmt::format(
            "the window from {:g} s to {:g} s holds {} samples of {}, and a delay needs {}; the record goes from "
            "{:g} s to {:g} s",
            options.window->first, options.window->second, out.time.size(), options.search.first, fewest,
            run.time.empty() ? 0 : run.time.front(), run.time.empty() ? 0 : run.time.back()),
        {}, "name [prepare] window within the record");
  const OffsetOptions& search = options.search;
  out.offset = offset_between(out.time, out.first, run.second_time, run.second, search);
  if (out.offset.chance > by_chance && !options.one_source)
    throw hydro::InputError(
        fmt::format(
            "{} and {} may have nothing in common: their correlation is {:.3g}, and records of such spectra and "
            "length that are unrelated come so far at one of the lags in {:.2g} % of cases",
            search.first, search.second, out.offset.correlation, 100 * out.offset.chance),
        {},
        "take a longer record, or one with a beginning; or bound the delay, [model] longest; or say that they are of "
        "one source, a sea or a motor: [model] one_source = true");
  return out;
}

Coefficient delay_of(const Offset& o) {
  Coefficient out;
  out.name = "delay";
  out.value = o.lag;
  out.standard_error = o.deviation;
  out.interval = out.white_interval = {o.lag - o.half_width, o.lag + o.half_width};
  return out;
}

Report told(const Run& run, const FittedRun& found, const OffsetOptions& search) {
  const Offset& o = found.offset;
  Report report = begin_run(run.source);
  report.heading = fmt::format("{}: {} behind {}", run.source.name(), search.second, search.first);
  report.facts.emplace_back("samples", found.time.size());
  append(report.facts, {{"correlation", o.correlation},
                        {"correlation_elsewhere", o.runner_up},
                        {"chance", o.chance},
                        {"scale", o.scale},
                        {"level", o.level}});
  report.estimates = {{.coefficient = delay_of(o), .unit = "s"}};
  report.say("{} samples; correlation {:.5g}, on other swings {:.3g} at most; {} = {:.5g} {:+.5g} {}",
             found.time.size(), o.correlation, o.runner_up, search.first, o.level, o.scale, search.second);
  if (const std::string known = supposed(search, "a delay"); !known.empty()) {
    report.facts.emplace_back("supposed", known);
    report.remarks.push_back(known);
  }
  add_labels(report, run.source);
  return report;
}

/// Runs differ by more than their errors where a delay is not constant: a filter, a buffer, a clock that drifts.
Report told_together(const Problem& problem, Solution& out) {
  const double confidence = problem.options.search.confidence;
  std::vector<Coefficient> delays;
  for (const FittedRun& r : out.runs) delays.push_back(delay_of(r.offset));
  out.together = together(delays, files_of(problem.runs), confidence);
  return over_runs("delay", "s", *out.together, "run", delays.size(), confidence);
}

}  // namespace

Solution solve(const Problem& problem) {
  hydro::require(!problem.runs.empty(), "a delay needs one record at least");
  Solution out;
  for (const Run& run : problem.runs) {
    out.runs.push_back(of_run(run.source, [&] { return fitted(run, problem.options); }));
    out.report.parts.push_back(told(run, out.runs.back(), problem.options.search));
  }
  const bool noisy =
      std::all_of(out.runs.begin(), out.runs.end(), [](const auto& r) { return r.offset.deviation > 0; });
  if (out.runs.size() >= 3 && noisy) out.report.parts.push_back(told_together(problem, out));
  return out;
}

}  // namespace fit::delay
