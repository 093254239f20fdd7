#include "froude/record_steps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/band_pass.hpp"
#include "fit/prepare_channels.hpp"
#include "fit/sensor.hpp"
#include "froude/option.hpp"
#include "hydro/base/error.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace record_steps {
namespace {

using hydro::InputError;
namespace dim = hydro::dim;

/// A number with its unit, which must be positive. `example`: how it could be written.
double positive_of(const char* option, const std::string& text, const hydro::Dimension& needed, const char* example) {
  const double value = option_si(option, text, needed);
  if (!(value > 0))
    throw InputError(fmt::format("\"{}\" must be positive", text), {.file = option},
                     fmt::format("write for example \"{}\"", example));
  return value;
}

double hertz_of(const char* option, const std::string& text, const char* example) {
  return positive_of(option, text, dim::angular_velocity, example) / (2 * std::numbers::pi);
}

/// "0.05 Hz, 0.5 Hz".
std::pair<double, double> two_frequencies(const char* option, const std::string& text, const char* example) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos || text.find(',', comma + 1) != std::string::npos)
    throw InputError(fmt::format("\"{}\" is not two frequencies with a comma between them", text), {.file = option},
                     fmt::format("write for example \"{}\"", example));
  return {hertz_of(option, text.substr(0, comma), example), hertz_of(option, text.substr(comma + 1), example)};
}

fit::FilterChoice notch_of(const std::string& text) {
  const auto [centre, width] = two_frequencies("--notch", text, "50 Hz, 2 Hz");
  return {.kind = fit::FilterChoice::Kind::notch, .hz = centre, .width = width};
}

/// The edges as named, or about the frequency of the waves.
std::optional<fit::BandEdges> band_of(const StepArguments& a) {
  if (a.band_pass && a.wave_frequency)
    throw InputError("--wave-frequency is a band-pass about the waves, and --band-pass names another",
                     {.file = "command line"}, "leave out one of the two");
  if (a.wave_frequency) {
    constexpr double lowest = 0.2, highest = 4;  // slow drift is below, the third harmonic inside
    const double hz = hertz_of("--wave-frequency", *a.wave_frequency, "0.125 Hz");
    return fit::BandEdges{lowest * hz, highest * hz};
  }
  if (!a.band_pass) return std::nullopt;
  const auto [low, high] = two_frequencies("--band-pass", *a.band_pass, "0.05 Hz, 0.5 Hz");
  if (!(low < high))
    throw InputError(fmt::format("\"{}\" must name the lower edge first", *a.band_pass), {.file = "--band-pass"},
                     "exchange the two");
  return fit::BandEdges{low, high};
}

double deviations_of(const StepArguments& a) {
  constexpr double least = 3, usual = 8;  // as [prepare.outliers] of a fit
  if (!a.outlier_deviations) return usual;
  if (!a.outliers)
    throw InputError("--outlier-deviations does not act without --outliers", {.file = "command line"},
                     "add --outliers with the window that is asked, for example \"1 s\"");
  if (!(*a.outlier_deviations >= least))
    throw InputError(fmt::format("{:g} must be {:g} at least: noise itself comes so far", *a.outlier_deviations, least),
                     {.file = "--outlier-deviations"}, "leave it out for 8");
  return *a.outlier_deviations;
}

fit::ChannelSteps steps_of(const StepArguments& a) {
  fit::ChannelSteps out;
  if (a.longest_gap) out.prepare.longest_gap_s = positive_of("--longest-gap", *a.longest_gap, dim::time, "0.5 s");
  if (a.outliers) out.prepare.outlier_window_s = positive_of("--outliers", *a.outliers, dim::time, "1 s");
  out.prepare.outlier_deviations = deviations_of(a);
  if (a.resample) out.prepare.resample_hz = hertz_of("--resample", *a.resample, "20 Hz");
  out.detrend = a.detrend;
  for (const std::string& text : a.notch) out.prepare.filters.push_back(notch_of(text));
  if (a.low_pass)
    out.prepare.filters.push_back(
        {.kind = fit::FilterChoice::Kind::butterworth, .hz = hertz_of("--low-pass", *a.low_pass, "2 Hz")});
  out.band_pass = band_of(a);
  return out;
}

/// Filters that the sampling does not allow are refused at their option.
void check_filters(const fit::ChannelSteps& steps, const StepArguments& a, double step) {
  using fit::ZeroPhaseFilter;
  for (const fit::FilterChoice& f : steps.prepare.filters)
    if (f.kind == fit::FilterChoice::Kind::notch)
      scene::placed({.file = "--notch"}, [&] { ZeroPhaseFilter::notch(f.hz, f.width, step); });
    else
      scene::placed({.file = "--low-pass"}, [&] { ZeroPhaseFilter::butterworth(f.order, f.hz, step); });
  if (steps.band_pass)
    scene::placed({.file = a.wave_frequency ? "--wave-frequency" : "--band-pass"},
                  [&] { fit::BandPass(steps.band_pass->low_hz, steps.band_pass->high_hz, step); });
}

/// The part as a window of the steps; it must lie in the record as it was given.
fit::WindowChoice window_of(const RecordPart& part, const std::vector<double>& time) {
  if (!part.from && !part.to) return {};
  constexpr double slack = 1e-9;  // times written with few digits
  const double from = part.from.value_or(time.front()), to = part.to.value_or(time.back());
  return {
      .kind = fit::WindowChoice::Kind::span, .from = from - slack * std::abs(from), .to = to + slack * std::abs(to)};
}

/// Else less than was asked for would be analysed.
void require_steady_to(const RecordPart& part, const fit::PreparedChannels& p) {
  if (part.to && *part.to > p.steady_to_s + p.step / 2)
    throw InputError(fmt::format("the steps leave {:.6g} s to {:.6g} s of the record, and --to is {:.6g} s",
                                 p.steady_from_s, p.steady_to_s, *part.to),
                     {}, "give an earlier end, leave --to out, or name filters that give up less");
}

bool never_changes(const Signal& s) {
  return std::all_of(s.values.begin(), s.values.end(), [&](double v) { return v == s.values.front(); });
}

/// Signals that change, as channels, and back.
std::vector<fit::PreparedChannel> channels_of(const RunResult& record) {
  std::vector<fit::PreparedChannel> out;
  for (const Signal& s : record.signals)
    if (!never_changes(s)) out.push_back({s.name, s.values});
  return out;
}

void put_back(fit::PreparedChannels& prepared, RunResult& record) {
  auto next = prepared.channels.begin();
  for (Signal& s : record.signals) {
    if (never_changes(s))
      s.values.assign(prepared.time.size(), s.values.front());
    else
      s.values = std::move((next++)->values);
  }
  record.time = std::move(prepared.time);
}

}  // namespace
}  // namespace record_steps

bool names_a_step(const StepArguments& a) {
  return a.longest_gap || a.outliers || a.outlier_deviations || a.resample || a.detrend || !a.notch.empty() ||
         a.low_pass || a.band_pass || a.wave_frequency;
}

std::optional<StepsDone> take_steps(RunResult& record, const StepArguments& arguments, const RecordPart& part,
                                    const Path& file) {
  using namespace record_steps;
  if (!names_a_step(arguments)) return std::nullopt;
  fit::ChannelSteps steps = steps_of(arguments);
  auto channels = channels_of(record);
  if (channels.empty())
    throw InputError("no signal changes: there is nothing to prepare", {.file = file.string()},
                     "leave the steps out, or take other signals");
  fit::PreparedChannels prepared = scene::placed({.file = file.string()}, [&] {
    const double recorded = fit::even_grid(record.time, steps.prepare.longest_gap_s).step;
    check_filters(steps, arguments, steps.prepare.resample_hz > 0 ? 1 / steps.prepare.resample_hz : recorded);
    steps.prepare.window = window_of(part, record.time);
    return fit::prepare_channels(record.time, std::move(channels), steps);
  });
  scene::placed({.file = file.string()}, [&] { require_steady_to(part, prepared); });
  StepsDone out{.step = prepared.step,
                .steady_from_s = prepared.steady_from_s,
                .steady_to_s = prepared.steady_to_s,
                .filled = prepared.filled,
                .outliers = {},
                .steps = prepared.steps,
                .cautions = prepared.cautions};
  for (const auto& c : prepared.channels) out.outliers.emplace_back(c.name, c.outliers);
  put_back(prepared, record);
  return out;
}

Report report_of(const StepsDone& done) {
  Report out;
  out.sentences("steps", "prepared: {}", done.steps).sentences("cautions", "caution: {}", done.cautions);
  out.say("prepared: steady from {:.6g} s to {:.6g} s", fact("steady_from_s", done.steady_from_s),
          fact("steady_to_s", done.steady_to_s));
  out.keep("filled", done.filled);
  for (const auto& [name, count] : done.outliers)
    out.one_of("outliers", Report().keep("signal", name).keep("bridged", count));
  return out;
}

}  // namespace froude
