#include "fit/problem/regular_waves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fit/box.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "hydro/signal/welch.hpp"
#include "hydro/waves/dispersion.hpp"
#include "prepare_steps.hpp"
#include "telling.hpp"
#include "wave_records.hpp"

namespace fit::regular_waves {
namespace {

constexpr double degree = std::numbers::pi / 180;

double period_of(const RegularWaveFit& fit) { return 2 * std::numbers::pi / fit.omega; }
double amplitude_of(const Oscillation& o) { return std::abs(o.harmonics[0]); }

std::string list_of(const Oscillation& o) {
  std::string out;
  for (std::size_t k = 1; k < o.harmonics.size(); ++k)
    out += fmt::format("{}{}: {:.3g} %", k > 1 ? ", " : "", k + 1, 100 * std::abs(o.harmonics[k]) / amplitude_of(o));
  return out;
}

Facts facts_of(const Oscillation& o) {
  std::vector<double> amplitudes, phases;
  for (const auto& a : o.harmonics) {
    amplitudes.push_back(std::abs(a));
    phases.push_back(std::arg(a));
  }
  Facts out{{"mean", o.mean}, {"amplitudes", amplitudes}, {"phases_rad", phases}, {"residual_rms", o.residual_rms}};
  if (!o.half_heights.empty()) append(out, {{"by_peaks", o.by_peaks}, {"by_peaks_error", o.by_peaks_error}});
  return out;
}

Report told(const WaveResponse& r, const std::string& unit) {
  Report out{.key = "response", .one_of_many = true};
  const Oscillation& m = r.motion;
  out.heading = fmt::format(
      "  {}: amplitude {:.4g} {} ± {:.2g}, mean {:.4g}{}{}{}", r.name, amplitude_of(m), unit, m.error, m.mean,
      m.harmonics.size() > 1 ? "; harmonics " : "", list_of(m),
      m.half_heights.empty() ? "" : fmt::format("; by peaks {:.4g} ± {:.2g}", m.by_peaks, m.by_peaks_error));
  out.facts = {{"name", r.name},
               {"unit", unit},
               {"motion", facts_of(m)},
               {"phase_rad", r.phase},
               {"phase_error_rad", r.phase_error}};
  if (std::isfinite(r.rao_by_peaks)) out.facts.emplace_back("rao_by_peaks", r.rao_by_peaks);
  out.estimates = {
      {.coefficient = r.rao,
       .unit = unit + "/m",
       .more = fmt::format("; phase {:.1f} ± {:.1f} deg{}", r.phase / degree, r.phase_error / degree,
                           std::isfinite(r.rao_by_peaks) ? fmt::format("; by peaks {:.4g}", r.rao_by_peaks) : "")}};
  return out;
}

/// How the window came about.
std::string window_of(const FittedRun& run, const Options& options) {
  const RegularWaveFit& fit = run.fit;
  const std::string held = fmt::format("window: {} periods of {:.5g} s, from {:.4g} s to {:.4g} s", fit.cycles,
                                       period_of(fit), run.time[fit.from], run.time[fit.to - 1]);
  if (!fit.times) return held + ", as named";
  const WaveTimes& t = *fit.times;
  return fmt::format(
      "{}: energy goes at {:.4g} m/s, is at gauge and body at {:.4g} s, and with a ramp of {:.3g} s and {:g} "
      "periods "
      "to settle the waves are steady; {}",
      held, t.group_velocity, options.started + t.front, options.ramp, options.settle_periods,
      std::isfinite(t.back_from_end)
          ? fmt::format("from the end they come back at {:.4g} s", options.started + t.back_from_end)
          : std::string("no end of the tank is named from which they come back"));
}

SlopeError slope_error_of(const Problem& problem, std::size_t response) {
  return fit::slope_error_of(problem.elevation_slope, problem.response_slopes, response);
}

/// What filters leave of the harmonics: of both sides of a ratio alike, and so not of it.
void tell_gains(const PrepareOptions& steps, double step, const RegularWaveFit& fit, Report& report) {
  if (steps.filters.empty() && !steps.band_pass) return;
  const std::size_t harmonics = fit.wave.harmonics.size();
  std::string list;
  for (std::size_t k = 1; k <= harmonics; ++k)
    list += fmt::format("{}{:.4f}", k > 1 ? ", " : "", gain_of(steps, step, static_cast<double>(k) * fit.omega));
  report.steps->push_back(fmt::format("filters leave {} of the amplitude{}", list,
                                      harmonics > 1 ? fmt::format("s of harmonics 1 to {}", harmonics) : ""));
  const double first = gain_of(steps, step, fit.omega);
  if (std::abs(first - 1) > 0.01)
    report.warn(
        fmt::format("filters leave {:.3g} of the amplitude of the waves and of what answers to them: amplitudes "
                    "are told with that in them, the ratio of both is free of it",
                    first));
}

/// (F120) Waves break before their height is 0.142 λ tanh(kh) (Miche), so that higher ones are of another unit.
void require_waves_that_stand(const RegularWaveFit& fit, const hydro::Water& water) {
  constexpr double limit = 0.142, slack = 1.1;  // the height of the first harmonic, of sharp crests with higher ones
  const double k = hydro::waves::wavenumber(fit.omega, water),
               in_depth = water.depth.is_infinite() ? 1 : std::tanh(k * water.depth.metres()),
               length = 2 * std::numbers::pi / k, highest = limit * length * in_depth,
               height = 2 * amplitude_of(fit.wave);
  if (height > slack * highest)
    throw hydro::InputError(
        fmt::format("waves of {:.4g} s are {:.4g} m high and {:.4g} m long: waves of that length break above {:.4g} m",
                    period_of(fit), height, length, highest),
        {}, "look at the unit of the elevation in the header, mm under [m], and at the depth");
}

FittedRun fitted(const Problem& problem, const WaveRun& run, Report& report) {
  PrepareOptions steps = with_band(run, problem.options.prepare);
  steps.window = {};  // times are those of the whole record
  FittedRun out{prepared(run, steps, report), {}};
  std::vector<WaveChannel> responses = run.responses;
  for (std::size_t i = 0; i < responses.size(); ++i) responses[i].values = out.responses[i];
  std::optional<std::pair<double, double>> span;
  if (const auto& w = problem.options.prepare.window; w.kind == WindowChoice::Kind::span) span = {w.from, w.to};
  out.fit = fit_regular_waves(out.time, out.elevation, responses, problem.options, span);
  require_waves_that_stand(out.fit, problem.options.tank.water);
  tell_gains(steps, hydro::signal::even_step(out.time), out.fit, report);
  for (std::size_t i = 0; i < out.fit.responses.size(); ++i) {
    Coefficient& rao = out.fit.responses[i].rao;
    count_slope(slope_error_of(problem, i), middle(rao), rao);
  }
  return out;
}

void tell(const Problem& problem, const WaveRun& run, const FittedRun& found, Report& report) {
  const RegularWaveFit& fit = found.fit;
  report.heading = fmt::format("{}: period {:.5g} s, wave amplitude {:.4g} m ± {:.2g}{}{}", run.source.name(),
                               period_of(fit), amplitude_of(fit.wave), fit.wave.error,
                               fit.wave.harmonics.size() > 1 ? "; harmonics " : "", list_of(fit.wave));
  append(report.facts, {{"omega_rad_s", fit.omega},
                        {"period_s", period_of(fit)},
                        {"from_s", found.time[fit.from]},
                        {"to_s", found.time[fit.to - 1]},
                        {"cycles", fit.cycles},
                        {"wave", facts_of(fit.wave)}});
  report.steps->push_back(window_of(found, problem.options));
  for (const std::string& caution : fit.cautions) report.warn(caution);
  const double regular = std::pow(amplitude_of(fit.wave), 2) / 2, rest = std::pow(fit.wave.residual_rms, 2);
  if (rest > regular)
    report.warn(
        fmt::format("{:.0f} % of the variance of the surface is in no harmonic of this period: the waves are not "
                    "regular; records of a sea are fitted by kind \"irregular waves\"",
                    100 * rest / (rest + regular)));
  for (std::size_t i = 0; i < fit.responses.size(); ++i)
    report.parts.push_back(told(fit.responses[i], problem.units[i]));
  add_labels(report, run.source);
}

/// Runs of one period within 1 % and one height within 10 %: two settings of a wavemaker differ by more.
bool same_wave(const RegularWaveFit& a, const RegularWaveFit& b) {
  return std::abs(a.omega / b.omega - 1) < 0.01 && std::abs(amplitude_of(a.wave) / amplitude_of(b.wave) - 1) < 0.1;
}

std::vector<std::vector<std::size_t>> groups_of(const std::vector<FittedRun>& runs) {
  std::vector<std::vector<std::size_t>> out;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto at =
        std::find_if(out.begin(), out.end(), [&](const auto& g) { return same_wave(runs[g[0]].fit, runs[i].fit); });
    if (at == out.end())
      out.push_back({i});
    else
      at->push_back(i);
  }
  return out;
}

Repeats repeats_of(const std::vector<FittedRun>& runs, const std::vector<std::size_t>& group, std::size_t response,
                   const SlopeError& slope, double confidence) {  // (F97)
  Repeats out{.name = runs[group[0]].fit.responses[response].name,
              .period = 0,
              .wave_amplitude = 0,
              .runs = group,
              .mean = 0,
              .deviation = 0,
              .interval = {},
              .lower_quartile = 0,
              .median = 0,
              .upper_quartile = 0};
  const auto n = static_cast<double>(group.size());
  std::vector<double> values;
  for (const std::size_t i : group) {
    const RegularWaveFit& fit = runs[i].fit;
    values.push_back(middle(fit.responses[response].rao));
    out.mean += values.back() / n;
    out.period += period_of(fit) / n;
    out.wave_amplitude += amplitude_of(fit.wave) / n;
  }
  for (const double v : values) out.deviation += (v - out.mean) * (v - out.mean) / (n - 1);
  out.deviation = std::sqrt(out.deviation);
  const double half = out.deviation / std::sqrt(n) * hydro::signal::student_t_quantile((1 + confidence) / 2, n - 1);
  out.interval = with_slope(slope, out.mean, out.mean, {out.mean - half, out.mean + half});  // (F105)
  out.lower_quartile = quantile_of(values, 0.25);
  out.median = quantile_of(values, 0.5);
  out.upper_quartile = quantile_of(values, 0.75);
  return out;
}

void tell(const Repeats& r, const std::string& unit, double confidence, Report& report) {
  Report part{.key = "repeated", .one_of_many = true};
  part.heading = fmt::format(
      "{} runs of {:.4g} s and {:.3g} m: {} median {:.4g} {}/m, quartiles {:.4g} and {:.4g}; mean {:.4g}, {:g} % "
      "interval "
      "{:.4g} to {:.4g}",
      r.runs.size(), r.period, r.wave_amplitude, r.name, r.median, unit, r.lower_quartile, r.upper_quartile, r.mean,
      100 * confidence, r.interval.low, r.interval.high);
  part.facts = {{"response", r.name},
                {"runs", r.runs.size()},
                {"period_s", r.period},
                {"wave_amplitude", r.wave_amplitude},
                {"median", r.median},
                {"lower_quartile", r.lower_quartile},
                {"upper_quartile", r.upper_quartile},
                {"mean", r.mean},
                {"deviation", r.deviation},
                {"interval", r.interval}};
  report.parts.push_back(std::move(part));
}

}  // namespace

Solution solve(const Problem& problem) {
  hydro::require(!problem.runs.empty(), "there are no runs in waves");
  Solution out;
  for (const WaveRun& run : problem.runs) {
    hydro::require(run.responses.size() == problem.units.size(), "{} responses and {} units", run.responses.size(),
                   problem.units.size());
    Report report = begin_run(run.source);
    out.runs.push_back(of_run(run.source, [&] { return fitted(problem, run, report); }));
    tell(problem, run, out.runs.back(), report);
    out.report.parts.push_back(std::move(report));
  }
  for (const auto& group : groups_of(out.runs))
    for (std::size_t i = 0; group.size() > 1 && i < problem.units.size(); ++i) {
      out.repeats.push_back(repeats_of(out.runs, group, i, slope_error_of(problem, i), problem.options.confidence));
      tell(out.repeats.back(), problem.units[i], problem.options.confidence, out.report);
    }
  return out;
}

}  // namespace fit::regular_waves
