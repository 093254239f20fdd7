#include "fit/problem/delay.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "telling.hpp"

namespace fit::delay {
namespace {

constexpr double by_chance = 0.01;

/// How far the lag of a half may be from that of the whole: clocks run apart by less than a hundredth, and beyond a
/// quarter of a period another swing fits half a record as well.
double reach_of_half(const FittedRun& whole) {
  const double length = whole.time.back() - whole.time.front(),
               mean = std::accumulate(whole.first.begin(), whole.first.end(), 0.0) /
                      static_cast<double>(whole.first.size());
  int crossings = 1;
  for (std::size_t i = 1; i < whole.first.size(); ++i)
    crossings += (whole.first[i] > mean) != (whole.first[i - 1] > mean) ? 1 : 0;
  return std::max(std::min(0.01 * length, length / crossings / 2), 3 * whole.offset.half_width);
}

/// One half of the first channel against the whole of the second, about the lag that is known.
std::optional<Offset> half_offset(const Run& run, const FittedRun& whole, const OffsetOptions& search, bool first) {
  const auto middle = static_cast<std::ptrdiff_t>(whole.time.size() / 2);
  const auto half_of = [&](const std::vector<double>& v) {
    return first ? std::vector(v.begin(), v.begin() + middle) : std::vector(v.begin() + middle, v.end());
  };
  OffsetOptions about = search;
  about.around = whole.offset.lag;
  about.longest = std::min(search.longest, reach_of_half(whole));
  about.sign = whole.offset.scale < 0 ? OffsetOptions::Sign::opposite : OffsetOptions::Sign::same;
  try {
    return offset_between(half_of(whole.time), half_of(whole.first), run.second_time, run.second, about);
  } catch (const hydro::InputError&) {  // a half that tells no lag tells no drift either
    return std::nullopt;
  }
}

/// (F122) Clocks of one rate have one delay: halves whose delays exclude each other are of two clocks that run apart.
void require_one_rate(const Run& run, const FittedRun& whole, const OffsetOptions& search) {
  constexpr double apart = 2;  // times both half-widths together: of two halves that are right one in ten thousand
  const auto first = half_offset(run, whole, search, true), second = half_offset(run, whole, search, false);
  if (!first || !second) return;
  const double change = second->lag - first->lag, known = std::hypot(first->half_width, second->half_width),
               between = (whole.time.back() - whole.time.front()) / 2;
  constexpr double rounding = 1e-4;  // of the time between: records without noise have no half-width
  if (std::abs(change) <= std::max(apart * known, rounding * between)) return;
  throw hydro::InputError(
      fmt::format("{} is {:.4g} s behind {} in the first half of the record and {:.4g} s in the second, +- {:.2g} s "
                  "each: the two run apart by {:.2g} s in 1000 s, and no one delay is true of both",
                  search.second, first->lag, search.first, second->lag, known / std::sqrt(2.0),
                  1000 * std::abs(change) / between),
      {},
      "correct the rate of one clock, its times multiplied by the ratio of both, or name a short [prepare] window, in "
      "which the delay does not change");
}

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
  require_one_rate(run, out, search);
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
