#include <algorithm>
#include <cmath>

#include "answers/picture.hpp"
#include "froude/outputs.hpp"
#include "froude/psd/report.hpp"
#include "froude/record_file.hpp"
#include "froude/record_looks.hpp"
#include "froude/record_steps.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "hydro/signal/lomb_scargle.hpp"
#include "hydro/signal/multitaper.hpp"
#include "hydro/signal/resolution.hpp"
#include "scene/placed.hpp"
#include "scene/scene.hpp"

namespace froude {
namespace {

namespace hs = hydro::signal;
using spectra::Analysis;
using spectra::Estimate;

std::vector<Signal> chosen(const RunResult& record, const PsdArguments& arguments) {
  std::vector<std::string> patterns = arguments.signals;
  if (patterns.empty()) patterns.push_back("*");
  if (arguments.input) patterns.push_back(*arguments.input);
  return signals_like(record, patterns, arguments.file);
}

// ---- computing ----

/// What a record that drifts does to its single waves: a straight line is taken off, of anything else is told.
std::string drift_of(const hs::Trend& trend, double duration, const std::optional<hs::WaveStatistics>& waves,
                     double tm02) {
  if (trend.is_drift())
    return fmt::format(
        "drifts by {:.4g} over the record, {:.2g} of its variance: its waves are counted about that line",
        trend.slope * duration, trend.share);
  constexpr double usual = 1.5;  // Tz of a broad sea is near Tm02, which its own tail shortens
  if (waves && waves->mean_period > usual * tm02)
    return fmt::format(
        "has waves of {:.4g} s from one crossing of the mean to the next, where its spectrum has {:.4g} s: either it "
        "drifts slowly, so that waves miss the mean (take the drift off first), or noise, spikes or bridged gaps above "
        "the waves' frequencies shorten the period of the spectrum (bridge spikes, or cut the band)",
        waves->mean_period, tm02);
  return "";
}

hs::WelchOptions welch_options(const PsdArguments& arguments, std::size_t samples, double step) {
  if (!arguments.segment) return hs::fifteen_segments(samples);
  const double length = hydro::parse_si(*arguments.segment, hydro::dim::time);
  const auto half = std::llround(length / step / 2);  // the nearest even number of samples
  hydro::require(half >= 2, "a segment of {} holds fewer than 4 samples at {:.4g} s each", *arguments.segment, step);
  return {.segment = 2 * static_cast<std::size_t>(half)};
}

hs::WelchSpectrum spectrum_of(const Signal& signal, const RunResult& record, const Analysis& a) {
  if (a.tapers) return hs::multitaper(signal.values, a.step, *a.tapers);
  if (a.uneven_segment)
    return hs::lomb_scargle(record.time, signal.values, *a.uneven_segment, hs::usual_nyquist_hz(record.time));
  return hs::welch(signal.values, a.step, a.options);
}

Estimate estimate(const Signal& signal, const RunResult& record, const Analysis& analysis, const Signal* input) {
  Estimate e{.signal = signal,
             .welch = spectrum_of(signal, record, analysis),
             .moments = {},
             .peak = {},
             .statistics = {},
             .drift = {},
             .transfer = {}};
  // Rounding of a large mean is no motion.
  if (e.welch.variance <= 1e-28 * e.welch.mean * e.welch.mean) return e;
  e.moments = hs::moments(e.welch.spectrum, hs::whole(e.welch.spectrum));
  e.peak = hs::peak(e.welch.spectrum, hs::whole(e.welch.spectrum));
  if (analysis.uneven_segment) e.leaked = hs::leaked_shares(record.time, *analysis.uneven_segment, e.welch.spectrum);
  const auto waves = hs::single_waves(record.time, signal.values);
  e.waves = waves.size();
  if (e.waves >= 3) e.statistics = hs::wave_statistics(waves);
  e.drift = drift_of(hs::trend_of(record.time, signal.values), record.time.back() - record.time.front(), e.statistics,
                     e.moments->tm02());
  if (input != nullptr && input->name != signal.name)
    e.transfer = hs::transfer(input->values, signal.values, analysis.step, analysis.options);
  if (e.transfer) {
    const hs::InputOutput both{input->values, signal.values};
    e.resolution = hs::resolution_shift_of_gain(*e.transfer, {&both, 1}, analysis.step, analysis.options);
  }
  if (e.transfer) e.transfer->coherence_threshold = hs::coherence_threshold(e.transfer->averages, analysis.confidence);
  return e;
}

/// Transfer functions are made of segments, not of tapers.
void require_one_way(const PsdArguments& arguments) {
  if (arguments.tapers && (arguments.segment || arguments.input))
    throw hydro::InputError("--tapers takes the whole record at once, --segment and --input cut it into segments",
                            {.file = "command line"}, "leave out --tapers, or the other");
  if (arguments.uneven && (arguments.tapers || arguments.input))
    throw hydro::InputError("--tapers and --input need even samples, --uneven is for those that are not",
                            {.file = "command line"}, "leave out --uneven, or the other");
  if (arguments.uneven && names_a_step(arguments.steps))
    throw hydro::InputError("steps before the spectrum bring the record to an even grid, --uneven takes it as it is",
                            {.file = "command line"}, "leave out --uneven, or the steps");
}

/// Of a record with gaps: as asked, or an eighth of it.
double uneven_segment(const PsdArguments& arguments, const RunResult& record) {
  return arguments.segment ? hydro::parse_si(*arguments.segment, hydro::dim::time)
                           : (record.time.back() - record.time.front()) / 8;
}

}  // namespace

spectra::Analysis spectra::analyse(RunResult record, const PsdArguments& arguments) {
  require_one_way(arguments);
  record.signals = chosen(record, arguments);
  hydro::require(!record.time.empty(), "the record has no samples");
  auto steps = take_steps_of_part(record, arguments.steps, record_part(arguments.from, arguments.to), arguments.file);
  Analysis a{.samples = record.time.size(),
             .step = 0,
             .options = {},
             .tapers = arguments.tapers,
             .uneven_segment = {},
             .band = {},
             .confidence = arguments.confidence,
             .prepared = std::move(steps),
             .input = arguments.input.value_or(""),
             .cautions = {},
             .estimates = {}};
  scene::placed({.file = arguments.file.string()}, [&] {
    if (arguments.uneven) {
      a.uneven_segment = uneven_segment(arguments, record);
      a.step = 0.5 / hs::usual_nyquist_hz(record.time);
    } else {
      a.step = a.prepared ? a.prepared->step : hs::even_step(record.time);
      if (!a.tapers) a.options = welch_options(arguments, a.samples, a.step);
    }
    if (!a.prepared) a.cautions = cautions_of_stops(record.signals);
    const auto at =
        std::find_if(record.signals.begin(), record.signals.end(), [&](const Signal& s) { return s.name == a.input; });
    for (const Signal& s : record.signals)
      a.estimates.push_back(estimate(s, record, a, at == record.signals.end() ? nullptr : &*at));
  });
  a.band = hs::confidence_band(a.estimates.front().welch.dof, arguments.confidence);
  return a;
}

void psd(const PsdArguments& arguments, const Console& console) {
  require_outputs(named({{"-o", arguments.output}, {"--picture", arguments.picture}}),
                  {{"the record", arguments.file}});
  require_picture(arguments.picture);
  const Analysis analysis = spectra::analyse(read_record(arguments.file), arguments);
  if (arguments.output) spectra::write_table(*arguments.output, analysis);
  if (arguments.picture)
    plot::write_picture(*arguments.picture, spectra::figure(analysis, arguments.file.filename().string()));
  tell(spectra::report_of(analysis).wrote(arguments.output).wrote(arguments.picture), console);
}

}  // namespace froude
