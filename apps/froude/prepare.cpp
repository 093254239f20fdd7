// `froude prepare`: a record after the steps that fits have, with rates of its signals.
#include <algorithm>
#include <numbers>

#include "answers/picture.hpp"
#include "fit/differentiate.hpp"
#include "froude/commands.hpp"
#include "froude/option.hpp"
#include "froude/outputs.hpp"
#include "froude/record_file.hpp"
#include "froude/record_looks.hpp"
#include "froude/record_steps.hpp"
#include "froude/report.hpp"
#include "froude/series.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/welch.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

/// A rate, and what of the samples has one.
struct SignalRate {
  Signal signal;
  std::size_t first, count;
  double bandwidth_hz, noise;
};

SignalRate rate_of(const Signal& s, double step, double bandwidth_hz) {
  const fit::Motion motion = fit::from_position(s.values, step, bandwidth_hz);
  return {{s.name + ".rate", s.units.empty() ? "1/s" : s.units + "/s", "rate of " + s.name, motion.velocity},
          motion.first,
          motion.velocity.size(),
          motion.bandwidth_hz,
          motion.noise_velocity};
}

/// Rates beside the signals, and the samples that all of them have.
std::vector<SignalRate> add_rates(RunResult& record, const PrepareArguments& a) {
  if (a.rates.empty()) {
    if (a.bandwidth)
      throw hydro::InputError("--bandwidth is of rates, and none is asked for", {.file = "command line"},
                              "add --rate SIGNAL, or leave it out");
    return {};
  }
  const double bandwidth =
      a.bandwidth ? option_si("--bandwidth", *a.bandwidth, hydro::dim::angular_velocity) / (2 * std::numbers::pi) : 0;
  std::vector<SignalRate> out;
  scene::placed({.file = a.file.string()}, [&] {
    const double step = hydro::signal::even_step(record.time);
    for (const Signal& s : signals_like(record, a.rates, a.file)) out.push_back(rate_of(s, step, bandwidth));
  });
  std::size_t first = 0, end = record.time.size();
  for (const SignalRate& r : out) {
    first = std::max(first, r.first);
    end = std::min(end, r.first + r.count);
  }
  const auto keep = [&](std::vector<double>& values, std::size_t begins) {
    values = {values.begin() + static_cast<std::ptrdiff_t>(first - begins),
              values.begin() + static_cast<std::ptrdiff_t>(end - begins)};
  };
  keep(record.time, 0);
  for (Signal& s : record.signals) keep(s.values, 0);
  for (const SignalRate& r : out) {
    record.signals.push_back(r.signal);
    keep(record.signals.back().values, r.first);
  }
  return out;
}

Report report_of(const RunResult& record, const std::vector<SignalRate>& rates) {
  Report out;
  out.say("{} samples from {:.6g} to {:.6g} s", fact("samples", record.time.size()),
          fact("from_s", record.time.front()), fact("to_s", record.time.back()));
  add_series(out, record.signals);
  for (const SignalRate& r : rates) {
    Report one;
    one.say("{}: right to 1 % up to {:.4g} Hz; noise of {} makes {:.2g} {} of it", fact("signal", r.signal.name),
            fact("bandwidth_hz", r.bandwidth_hz), r.signal.name.substr(0, r.signal.name.size() - 5),
            fact("noise", r.noise), r.signal.units);
    out.one_of("rates", one);
  }
  return out;
}

}  // namespace

void prepare(const PrepareArguments& a, const Console& console) {
  require_outputs(named({{"-o", a.output}, {"--picture", a.picture}}), {{"the record", a.file}});
  require_csv(a.output);
  require_picture(a.picture);
  RunResult record = read_record(a.file);
  hydro::require(!record.time.empty(), "the record has no samples");
  record.signals = signals_like(record, a.signals.empty() ? std::vector<std::string>{"*"} : a.signals, a.file);
  const std::vector<std::string> stops =
      names_a_step(a.steps) ? std::vector<std::string>() : cautions_of_stops(record.signals);
  const auto done = take_steps_of_part(record, a.steps, record_part(a.from, a.to), a.file);
  const std::vector<SignalRate> rates = add_rates(record, a);
  write_series_csv(a.output, record.time, record.signals);
  if (a.picture)
    plot::write_picture(*a.picture, series_figure(a.file.filename().string(), record.time, record.signals));
  Report report;
  if (done) report.part("prepared", froude::report_of(*done));
  report.part("", report_of(record, rates));
  report.sentences("cautions", "caution: {}", stops);
  tell(report.wrote(a.output).wrote(a.picture), console);
}

}  // namespace froude
