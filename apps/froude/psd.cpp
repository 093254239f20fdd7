#include <algorithm>
#include <cmath>

#include "froude/outputs.hpp"
#include "froude/psd_report.hpp"
#include "froude/record_file.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/scene.hpp"

namespace froude {
namespace {

namespace hs = hydro::signal;
using spectra::Analysis;
using spectra::Estimate;

std::vector<Signal> chosen(const RunResult& record, const PsdArguments& arguments) {
  std::vector<std::string> known, patterns = arguments.signals;
  for (const Signal& s : record.signals) known.push_back(s.name);
  if (patterns.empty()) patterns.push_back("*");
  if (arguments.input) patterns.push_back(*arguments.input);
  for (const std::string& pattern : patterns) {
    if (std::any_of(known.begin(), known.end(), [&](const auto& name) { return scene::matches(pattern, name); }))
      continue;
    const std::string near = hydro::nearest(pattern, known);
    throw hydro::InputError(fmt::format("no signal is called \"{}\"", pattern), {.file = arguments.file.string()},
                            near.empty() ? fmt::format("signals are: {}", fmt::join(known, ", "))
                                         : fmt::format("did you mean \"{}\"?", near));
  }
  std::vector<Signal> out;
  for (const Signal& s : record.signals)
    if (std::any_of(patterns.begin(), patterns.end(),
                    [&](const auto& pattern) { return scene::matches(pattern, s.name); }))
      out.push_back(s);
  return out;
}

// ---- computing ----

hs::WelchOptions welch_options(const PsdArguments& arguments, std::size_t samples, double step) {
  if (!arguments.segment) return hs::fifteen_segments(samples);
  const double length = hydro::parse_si(*arguments.segment, hydro::dim::time);
  const auto half = std::llround(length / step / 2);  // the nearest even number of samples
  hydro::require(half >= 2, "a segment of {} holds fewer than 4 samples at {:.4g} s each", *arguments.segment, step);
  return {.segment = 2 * static_cast<std::size_t>(half)};
}

Estimate estimate(const Signal& signal, const RunResult& record, const Analysis& analysis, const Signal* input) {
  Estimate e{.signal = signal,
             .welch = hs::welch(signal.values, analysis.step, analysis.options),
             .moments = {},
             .peak = {},
             .statistics = {},
             .transfer = {}};
  // Rounding of a large mean is no motion.
  if (e.welch.variance <= 1e-28 * e.welch.mean * e.welch.mean) return e;
  e.moments = hs::moments(e.welch.spectrum, hs::whole(e.welch.spectrum));
  e.peak = hs::peak(e.welch.spectrum, hs::whole(e.welch.spectrum));
  const auto waves = hs::single_waves(record.time, signal.values);
  e.waves = waves.size();
  if (e.waves >= 3) e.statistics = hs::wave_statistics(waves);
  if (input != nullptr && input->name != signal.name)
    e.transfer = hs::transfer(input->values, signal.values, analysis.step, analysis.options);
  return e;
}

Analysis analyse(const PsdArguments& arguments) {
  RunResult record = read_record(arguments.file);
  record.signals = chosen(record, arguments);
  hydro::require(!record.time.empty(), "the record has no samples");
  if (arguments.from) drop_before(record, hydro::parse_si(*arguments.from, hydro::dim::time), arguments.file);
  Analysis a{.samples = record.time.size(),
             .step = 0,
             .options = {},
             .band = {},
             .confidence = arguments.confidence,
             .input = arguments.input.value_or(""),
             .estimates = {}};
  try {
    a.step = hs::even_step(record.time);
    a.options = welch_options(arguments, a.samples, a.step);
    const auto at =
        std::find_if(record.signals.begin(), record.signals.end(), [&](const Signal& s) { return s.name == a.input; });
    for (const Signal& s : record.signals)
      a.estimates.push_back(estimate(s, record, a, at == record.signals.end() ? nullptr : &*at));
  } catch (const hydro::InputError& e) {
    throw e.at({.file = arguments.file.string()});
  }
  a.band = hs::confidence_band(a.estimates.front().welch.dof, arguments.confidence);
  return a;
}

}  // namespace

void psd(const PsdArguments& arguments, const Console& console) {
  require_outputs(named({{"-o", arguments.output}, {"--picture", arguments.picture}}),
                  {{"the record", arguments.file}});
  const Analysis analysis = analyse(arguments);
  if (arguments.output) spectra::write_table(*arguments.output, analysis);
  if (arguments.picture)
    hydro::io::write_atomically(*arguments.picture,
                                plot::svg(spectra::figure(analysis, arguments.file.filename().string())));
  if (console.json) {
    console.out << spectra::as_json(analysis).dump(1) << '\n';
    return;
  }
  spectra::tell(analysis, console);
  if (arguments.output) console.out << "wrote " << arguments.output->string() << '\n';
  if (arguments.picture) console.out << "wrote " << arguments.picture->string() << '\n';
}

}  // namespace froude
