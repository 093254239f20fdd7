// `froude extremes`: the largest values that a record lets one expect, without a law of the signal.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "answers/picture.hpp"
#include "froude/commands.hpp"
#include "froude/option.hpp"
#include "froude/outputs.hpp"
#include "froude/record_file.hpp"
#include "froude/record_looks.hpp"
#include "froude/record_steps.hpp"
#include "froude/report.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/peaks.hpp"
#include "hydro/signal/zero_crossings.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

namespace hs = hydro::signal;

/// A record, its peaks and both laws; lowest values are the largest of minus the signal, sign −1.
struct Extremes {
  Signal signal;
  double sign, recorded, duration, confidence;  // s
  std::vector<double> peaks, maxima;            // of sign · signal
  std::vector<double> probabilities;
  hs::ParetoTail tail;
  std::size_t above;
  hs::BlockMaxima blocks;
  std::optional<StepsDone> prepared;  // where steps were asked for
  double missed = 0;                  // share of crests that lies between samples
  std::vector<std::string> cautions;  // of the record itself
};

/// The level that a tenth of the peaks is above, or twenty where that is fewer, or half: many make a tail, and only
/// high ones do.
double usual_threshold(std::vector<double> peaks) {
  hydro::require(!peaks.empty(), "the record has no complete wave: no peak");
  std::sort(peaks.rbegin(), peaks.rend());
  return peaks[std::max(peaks.size() / 10, std::min<std::size_t>(20, peaks.size() / 2))];
}

/// The steps asked for, and what comes after --from.
std::optional<StepsDone> take_part(RunResult& record, const ExtremesArguments& a) {
  RecordPart part;
  if (a.from) part.from = option_si("--from", *a.from, hydro::dim::time);
  auto done = take_steps(record, a.steps, part, a.file);
  if (!done && part.from) drop_before(record, *part.from, a.file);
  return done;
}

/// Both laws tell the largest of many peaks: a duration in which none is expected above the threshold has no such, and
/// with a probability p none comes there in rate · D ≤ −ln p. \throws InputError at the option
void require_exceedances(const Extremes& e) {
  const double expected = e.tail.rate_hz * e.duration;
  hydro::require(!e.probabilities.empty(), "no probability is asked for");
  const double lowest = *std::min_element(e.probabilities.begin(), e.probabilities.end()),
               needed = lowest > 0 && lowest < 1 ? std::max(1.0, -std::log(lowest)) : 1;
  if (expected >= needed) return;
  throw hydro::InputError(
      fmt::format("of {} peaks beyond {:.5g} {} in {:.6g} s a duration of {:.6g} s holds {:.2g} on average, and its "
                  "largest value is only told where it holds {:.3g}{}",
                  e.above, e.sign * e.tail.threshold, e.signal.units, e.recorded, e.duration, expected, needed,
                  needed > 1 ? fmt::format(", for the quantile {:g}", lowest) : " or more"),
      {.file = "--duration"},
      fmt::format("take {:.6g} s or more, or a --threshold that more peaks are beyond", needed / e.tail.rate_hz));
}

/// A sensor at its stop tells nothing of larger values. Filters hide it, so the record is asked as it was measured.
std::vector<std::string> look_at_sensor(RunResult record, const ExtremesArguments& a) {
  if (a.from) drop_before(record, option_si("--from", *a.from, hydro::dim::time), a.file);
  if (!accepts(a.accept, "stop"))
    require_free_of_stops(record.signals.front(), a.lowest ? Ends::low : Ends::high, a.file);
  return cautions_of_stops(record.signals);
}

/// The mean of a record that drifts is another at each time, and its largest values are those of one end alone.
void require_no_drift(const RunResult& record) {
  const hs::Trend trend = hs::trend_of(record.time, record.signals.front().values);
  if (!trend.is_drift()) return;
  throw hydro::InputError(
      fmt::format("{} drifts by {:.4g} {} over the record, {:.2g} of its variance: largest values of another duration "
                  "would need to know how the drift goes on",
                  record.signals.front().name, trend.slope * (record.time.back() - record.time.front()),
                  record.signals.front().units, trend.share),
      {}, "take the drift off with --detrend, take a part without it by --from, or add --accept drift");
}

/// A law through the peaks that stays below the largest of them, for a time as long as the record's and longer, is the
/// law of something else: of peaks that are cut off, or of others than the one spike among them.
void require_record_within(const Extremes& e) {
  if (e.duration < e.recorded) return;
  constexpr double slack = 0.05;  // of what exceeds the threshold: moments place the end of a law no better
  const double largest = *std::max_element(e.peaks.begin(), e.peaks.end()),
               asked = std::max(0.99, *std::max_element(e.probabilities.begin(), e.probabilities.end())),
               told = e.tail.largest_not_exceeded(e.duration, asked);
  if (told >= largest - slack * (largest - e.tail.threshold)) return;
  throw hydro::InputError(
      fmt::format("the law of the peaks of {} tells that {:.5g} {} is not passed in {:.6g} s with {:g} %, and the "
                  "record of {:.6g} s holds {:.5g} {}",
                  e.signal.name, e.sign * told, e.signal.units, e.duration, 100 * asked, e.recorded, e.sign * largest,
                  e.signal.units),
      {},
      "look at that peak: --outliers bridges a spike, --threshold takes a part of the peaks that has one law; or add "
      "--accept tail");
}

Extremes find(const ExtremesArguments& a) {
  require_known(a.accept, {"stop", "drift", "tail"});
  RunResult record = read_record(a.file);
  hydro::require(!record.time.empty(), "the record has no samples");
  record.signals = {signal_of(record, a.signal, a.file)};
  std::vector<std::string> cautions = look_at_sensor(record, a);
  auto prepared = take_part(record, a);
  if (!accepts(a.accept, "drift")) require_no_drift(record);
  const MeasuredTime measured = measured_time(record.time);
  record.time = measured.time;
  const auto gaps = measured.cautions();
  cautions.insert(cautions.end(), gaps.begin(), gaps.end());
  Extremes out{.signal = record.signals.front(),
               .sign = a.lowest ? -1.0 : 1.0,
               .recorded = record.time.back() - record.time.front(),
               .duration = option_si("--duration", a.duration, hydro::dim::time),
               .confidence = a.confidence,
               .peaks = {},
               .maxima = {},
               .probabilities = a.quantiles.empty() ? std::vector{0.5, 0.9, 0.99} : a.quantiles,
               .tail = {},
               .above = 0,
               .blocks = {},
               .prepared = std::move(prepared),
               .cautions = std::move(cautions)};
  for (double& v : out.signal.values) v *= out.sign;
  out.missed = hs::missed_of_crests(record.time, out.signal.values);
  out.peaks = hs::crests(record.time, out.signal.values);
  const double threshold =
      a.threshold ? out.sign * option_si("--threshold", *a.threshold, hydro::parse_unit(out.signal.units).dimension)
                  : usual_threshold(out.peaks);
  out.tail = hs::fit_tail(out.peaks, threshold, out.recorded);
  out.above = static_cast<std::size_t>(
      std::count_if(out.peaks.begin(), out.peaks.end(), [&](double p) { return p > threshold; }));
  require_exceedances(out);
  if (!accepts(a.accept, "tail")) require_record_within(out);
  const double block = a.block ? option_si("--block", *a.block, hydro::dim::time) : out.recorded / 20;
  out.maxima = hs::block_maxima(record.time, out.signal.values, block);
  out.blocks = hs::fit_maxima(out.maxima, block);
  return out;
}

/// "50 %   12.3 (11.0 to 14.1)"; the interval of the signal itself.
template <class Fit>
Report estimate(const Extremes& e, const Fit& fit, std::size_t count, double p, const char* of) {
  const double level = fit.largest_not_exceeded(e.duration, p);
  hs::Interval i = hs::interval_of(fit, count, e.duration, p, e.confidence);
  double low = e.sign * i.low, high = e.sign * i.high;
  if (low > high) std::swap(low, high);
  return Report().say("{:>6.4g} %  {:<22} {:>11.5g} {:>11.5g} {:>11.5g}", fact("probability", p, 100 * p),
                      fact("of", std::string(of)), fact("level", e.sign * level), fact("low", low), fact("high", high));
}

Report report_of(const Extremes& e) {
  Report out;
  if (e.prepared) out.part("prepared", froude::report_of(*e.prepared));
  out.say("{}: {} peaks between up-crossings of the mean in {:.6g} s, the {} {:.5g} {}", fact("signal", e.signal.name),
          fact("peaks", e.peaks.size()), fact("recorded_s", e.recorded), e.sign > 0 ? "largest" : "lowest",
          fact("extreme", e.sign * *std::max_element(e.signal.values.begin(), e.signal.values.end())),
          fact("unit", e.signal.units));
  out.say("{} peaks beyond {:.5g}: generalised Pareto, scale {:.4g}, shape {:.3g}", fact("above", e.above),
          fact("threshold", e.sign * e.tail.threshold), fact("tail_scale", e.tail.scale),
          fact("tail_shape", e.tail.shape));
  out.say("{} blocks of {:.5g} s: Gumbel, location {:.5g}, scale {:.4g}", fact("blocks", e.maxima.size()),
          fact("block_s", e.blocks.block_s), fact("location", e.sign * e.blocks.location),
          fact("scale", e.blocks.scale));
  out.say("in {:.6g} s the {} value stays {} with the probability; between, {:g} % of such records:",
          fact("duration_s", e.duration), e.sign > 0 ? "largest" : "lowest", e.sign > 0 ? "below" : "above",
          fact("confidence", e.confidence, 100 * e.confidence));
  for (const double p : e.probabilities) {
    out.one_of("estimates", estimate(e, e.tail, e.above, p, "peaks over threshold"));
    out.one_of("estimates", estimate(e, e.blocks, e.maxima.size(), p, "block maxima"));
  }
  out.sentences("cautions", "caution: {}", e.cautions);
  out.sentences("cautions", "caution: {}", cautions_of_samples(e.missed, ", and levels are too low by as much"));
  if (e.duration > 10 * e.recorded)
    out.sentences("notes", "note: {}",
                  {fmt::format("{:.3g} times the record: far beyond what it holds, where the law "
                               "decides more than the record",
                               e.duration / e.recorded)});
  return out;
}

/// Peaks over how often they are exceeded in the record, and the law through them.
plot::Figure figure(const Extremes& e, const std::string& file_name) {
  std::vector<double> sorted = e.peaks;
  std::sort(sorted.rbegin(), sorted.rend());
  plot::Series found{.name = "peaks", .x = {}, .y = {}, .line = false, .marks = true};
  plot::Series law{.name = "generalised Pareto", .x = {}, .y = {}};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    found.x.push_back(static_cast<double>(i + 1) / e.recorded * 3600);
    found.y.push_back(e.sign * sorted[i]);
  }
  const double rate = e.tail.rate_hz * 3600, least = std::min(1 / e.duration, 1 / e.recorded) * 3600;
  for (int i = 0; i <= 60; ++i) {
    const double n = rate * std::pow(least / rate, i / 60.0);
    law.x.push_back(n);
    law.y.push_back(e.sign * e.tail.largest_not_exceeded(3600 / n, std::exp(-1.0)));
  }
  return {.title = "Peaks of " + e.signal.name + " in " + file_name,
          .panels = {{.x = {.label = "exceeded an hour", .unit = "", .scale = plot::Scale::logarithmic},
                      .y = {.label = "level", .unit = e.signal.units},
                      .series = {found, law}}}};
}

}  // namespace

void extremes(const ExtremesArguments& arguments, const Console& console) {
  require_outputs(named({{"-o", arguments.output}, {"--picture", arguments.picture}}),
                  {{"the record", arguments.file}});
  require_picture(arguments.picture);
  require_csv(arguments.output);
  const Extremes found = scene::placed({.file = arguments.file.string()}, [&] { return find(arguments); });
  if (arguments.output) {
    std::vector<double> peaks = found.peaks;
    for (double& p : peaks) p *= found.sign;
    hydro::io::write_csv(*arguments.output, {{"peak", found.signal.units, &peaks}},
                         {fmt::format("the extreme of {} between up-crossings of its mean", found.signal.name)});
  }
  if (arguments.picture) plot::write_picture(*arguments.picture, figure(found, arguments.file.filename().string()));
  tell(report_of(found).wrote(arguments.output).wrote(arguments.picture), console);
}

}  // namespace froude
