#include "froude/record_steps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "answers/record_step_words.hpp"
#include "fit/band_pass.hpp"
#include "fit/prepare_channels.hpp"
#include "fit/sensor.hpp"
#include "froude/option.hpp"
#include "froude/record_file.hpp"
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
    return fit::band_about_waves(hertz_of("--wave-frequency", *a.wave_frequency, "0.125 Hz"));
  }
  if (!a.band_pass) return std::nullopt;
  const auto [low, high] = two_frequencies("--band-pass", *a.band_pass, "0.05 Hz, 0.5 Hz");
  if (!(low < high))
    throw InputError(fmt::format("\"{}\" must name the lower edge first", *a.band_pass), {.file = "--band-pass"},
                     "exchange the two");
  return fit::BandEdges{low, high};
}

/// An option that says more of another, which must be there.
[[noreturn]] void refuse_alone(const char* option, const char* needs, const char* remedy) {
  throw InputError(fmt::format("{} does not act without {}", option, needs), {.file = "command line"}, remedy);
}

double deviations_of(const StepArguments& a) {
  constexpr double least = scene::least_outlier_deviations;
  if (!a.outlier_deviations) return scene::usual_outlier_deviations;
  if (!a.outliers)
    refuse_alone("--outlier-deviations", "--outliers",
                 "add --outliers with the window that is asked, for example \"1 s\"");
  if (!(*a.outlier_deviations >= least))
    throw InputError(fmt::format("{:g} must be {:g} at least: noise itself comes so far", *a.outlier_deviations, least),
                     {.file = "--outlier-deviations"}, "leave it out for 8");
  return *a.outlier_deviations;
}

scene::LowPassWord low_pass_of(const std::string& word) {
  std::string known;
  for (const scene::LowPassWord& l : scene::low_pass_words) {
    if (l.word == word) return l;
    known += fmt::format("{}\"{}\"", known.empty() ? "" : ", ", l.word);
  }
  throw InputError(fmt::format("\"{}\" is no kind of low pass", word), {.file = "--low-pass-kind"},
                   "write one of " + known);
}

std::optional<fit::FilterChoice> low_pass_of(const StepArguments& a) {
  if (!a.low_pass) {
    if (a.low_pass_kind || a.low_pass_order || a.low_pass_ripple)
      refuse_alone(a.low_pass_kind    ? "--low-pass-kind"
                   : a.low_pass_order ? "--low-pass-order"
                                      : "--low-pass-ripple",
                   "--low-pass", "add --low-pass with its cutoff, for example \"2 Hz\"");
    return std::nullopt;
  }
  const scene::LowPassWord kind = low_pass_of(a.low_pass_kind.value_or("butterworth"));
  if (a.low_pass_order && !kind.has_order)
    refuse_alone("--low-pass-order", "an order, which this kind has not", "leave it out, or take another kind");
  if (a.low_pass_ripple && !kind.has_ripple)
    refuse_alone("--low-pass-ripple", "--low-pass-kind chebyshev", "leave it out, or name that kind");
  fit::FilterChoice out{.kind = kind.kind, .hz = hertz_of("--low-pass", *a.low_pass, "2 Hz")};
  if (a.low_pass_order) out.order = *a.low_pass_order;
  if (kind.has_ripple) out.ripple = a.low_pass_ripple.value_or(scene::usual_ripple);
  return out;
}

fit::PrepareOptions steps_of(const StepArguments& a) {
  fit::PrepareOptions out;
  if (a.longest_gap) out.longest_gap_s = positive_of("--longest-gap", *a.longest_gap, dim::time, "0.5 s");
  if (a.outliers) out.outlier_window_s = positive_of("--outliers", *a.outliers, dim::time, "1 s");
  out.outlier_deviations = deviations_of(a);
  out.through_levels = a.through_levels;
  if (a.resample) out.resample_hz = hertz_of("--resample", *a.resample, "20 Hz");
  out.detrend = a.detrend;
  for (const std::string& text : a.notch) out.filters.push_back(notch_of(text));
  if (a.moving_average)
    out.filters.push_back({.kind = fit::FilterChoice::Kind::moving_average,
                           .seconds = positive_of("--moving-average", *a.moving_average, dim::time, "0.05 s")});
  if (const auto low_pass = low_pass_of(a)) out.filters.push_back(*low_pass);
  out.band_pass = band_of(a);
  return out;
}

/// Filters that the sampling does not allow are refused at their option.
void check_filters(const fit::PrepareOptions& steps, const StepArguments& a, double step) {
  for (const fit::FilterChoice& f : steps.filters) {
    using enum fit::FilterChoice::Kind;
    const char* option = f.kind == notch ? "--notch" : f.kind == moving_average ? "--moving-average" : "--low-pass";
    scene::placed({.file = option}, [&] { fit::filter_of(f, step); });
  }
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

RecordPart record_part(const std::optional<std::string>& from, const std::optional<std::string>& to) {
  RecordPart part;
  if (from) part.from = option_si("--from", *from, hydro::dim::time);
  if (to) part.to = option_si("--to", *to, hydro::dim::time);
  if (part.from && part.to && !(*part.to > *part.from))
    throw hydro::InputError(fmt::format("--to {:.6g} s is not after --from {:.6g} s", *part.to, *part.from),
                            {.file = "command line"}, "exchange the two, or leave one out");
  return part;
}

bool names_a_step(const StepArguments& a) {
  return a.longest_gap || a.outliers || a.outlier_deviations || a.through_levels || a.resample || a.detrend ||
         !a.notch.empty() || a.moving_average || a.low_pass || a.low_pass_kind || a.low_pass_order ||
         a.low_pass_ripple || a.band_pass || a.wave_frequency;
}

std::optional<StepsDone> take_steps(RunResult& record, const StepArguments& arguments, const RecordPart& part,
                                    const Path& file) {
  using namespace record_steps;
  if (!names_a_step(arguments)) return std::nullopt;
  fit::PrepareOptions steps = steps_of(arguments);
  auto channels = channels_of(record);
  if (channels.empty())
    throw InputError("no signal changes: there is nothing to prepare", {.file = file.string()},
                     "leave the steps out, or take other signals");
  fit::PreparedChannels prepared = scene::placed({.file = file.string()}, [&] {
    const double recorded = fit::even_grid(record.time, steps.longest_gap_s).step;
    check_filters(steps, arguments, steps.resample_hz > 0 ? 1 / steps.resample_hz : recorded);
    steps.window = window_of(part, record.time);
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

std::optional<StepsDone> take_steps_of_part(RunResult& record, const StepArguments& arguments, const RecordPart& part,
                                            const Path& file) {
  const auto cut = [&](RunResult& from_record) {
    if (part.from) drop_before(from_record, *part.from, file);
    if (part.to) drop_after(from_record, *part.to, file);
  };
  RunResult times;  // the part must lie in the record as it was given
  times.time = record.time;
  cut(times);
  auto done = take_steps(record, arguments, part, file);
  if (!done) cut(record);
  return done;
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
