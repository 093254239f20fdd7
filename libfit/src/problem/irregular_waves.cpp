#include "fit/problem/irregular_waves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hydro/signal/distributions.hpp"
#include "hydro/signal/resolution.hpp"
#include "hydro/waves/dispersion.hpp"
#include "prepare_steps.hpp"
#include "telling.hpp"
#include "wave_records.hpp"

namespace fit::irregular_waves {
namespace {

namespace hs = hydro::signal;
constexpr double degree = std::numbers::pi / 180;

/// The step of all runs. \throws hydro::InputError, with the run that has another
double common_step(const Problem& problem, const std::vector<WaveRecord>& records) {
  const auto step_of = [](const WaveRecord& r) { return hs::even_step(r.time); };
  const double step = step_of(records[0]);
  for (std::size_t i = 1; i < records.size(); ++i)
    if (std::abs(step_of(records[i]) / step - 1) > 1e-3)
      throw hydro::InputError(fmt::format("it is sampled every {:.6g} s, {} every {:.6g} s: segments of both cannot be "
                                          "put together",
                                          step_of(records[i]), problem.runs[0].source.name(), step),
                              {.file = problem.runs[i].source.file.string()},
                              "bring the records to one rate by resample in [prepare], or fit them apart");
  return step;
}

hs::WelchOptions segments_of(const Problem& problem, const std::vector<WaveRecord>& records, double step) {
  const auto shortest = std::min_element(records.begin(), records.end(),
                                         [](const auto& a, const auto& b) { return a.time.size() < b.time.size(); });
  const std::size_t samples = shortest->time.size();
  if (!problem.options.segment_s) return hs::fifteen_segments(samples);
  const auto half = std::llround(*problem.options.segment_s / step / 2);  // the nearest even number of samples
  if (half < 2 || static_cast<std::size_t>(2 * half) > samples)
    throw hydro::InputError(
        fmt::format("a segment of {:.4g} s has {} samples: it needs 4 at least, and the run has {}",
                    *problem.options.segment_s, 2 * half, samples),
        {.file = problem.runs[static_cast<std::size_t>(shortest - records.begin())].source.file.string()},
        "name a segment of ten periods of the slowest motion that matters, eight of which are in a run");
  return {.segment = static_cast<std::size_t>(2 * half)};
}

/// The mean of the runs' spectra, by their segments.
hs::SpectrumPerHz spectrum_of(const std::vector<WaveRecord>& records, double step, const hs::WelchOptions& options,
                              std::size_t& segments) {
  hs::SpectrumPerHz out;
  segments = 0;
  for (const WaveRecord& r : records) {
    const hs::WelchSpectrum one = hs::welch(r.elevation, step, options);
    out.frequency_hz = one.spectrum.frequency_hz;
    out.density.resize(out.frequency_hz.size(), 0);
    for (std::size_t k = 0; k < out.density.size(); ++k)
      out.density[k] += static_cast<double>(one.segments) * one.spectrum.density[k];
    segments += one.segments;
  }
  for (double& s : out.density) s /= static_cast<double>(segments);
  return out;
}

std::size_t peak_of(const hs::SpectrumPerHz& waves) {
  return static_cast<std::size_t>(std::max_element(waves.density.begin() + 1, waves.density.end()) -
                                  waves.density.begin());
}

/// (F107) Samples by which the energy of the highest waves comes later to the body than to the gauge.
/// \throws hydro::InputError where a run holds no segment of the same waves at both
std::ptrdiff_t samples_between(const Problem& problem, const Solution& so_far, double omega, double step) {
  const auto& tank = problem.options.tank;
  if (!tank) return 0;
  const double later = (tank->body - tank->gauge) / hydro::waves::group_velocity(omega, tank->water);
  for (std::size_t i = 0; i < so_far.records.size(); ++i) {
    const auto samples = static_cast<double>(so_far.records[i].time.size()),
               segment = static_cast<double>(so_far.segment_samples);
    if (!(std::abs(later / step) <= samples - segment))
      throw hydro::InputError(
          fmt::format("gauge and body are so far apart, the highest waves take {:.4g} s, that no segment of {:.4g} s "
                      "within the {:.4g} s of the run holds the same waves at both",
                      std::abs(later), segment * step, samples * step),
          {.file = problem.runs[i].source.file.string()},
          "take longer runs, shorter segments, or a gauge nearer to the body");
  }
  return std::lround(later / step);
}

/// Surface and response of each run, the response so many samples later.
std::vector<hs::InputOutput> moved(const std::vector<WaveRecord>& records, std::size_t response, std::ptrdiff_t later) {
  std::vector<hs::InputOutput> out;
  const auto skip = static_cast<std::size_t>(std::abs(later));
  for (const WaveRecord& r : records) {
    const std::span<const double> x(r.elevation), y(r.responses[response]);
    const std::size_t n = x.size() - skip;
    out.push_back(later < 0 ? hs::InputOutput{x.last(n), y.first(n)} : hs::InputOutput{x.first(n), y.last(n)});
  }
  return out;
}

/// (F107) Against the wave at the body.
void turn_phases(const std::optional<WaveTank>& tank, double moved_s, hs::TransferEstimate& t) {
  if (!tank) return;
  for (std::size_t k = 1; k < t.frequency_hz.size(); ++k) {
    const double omega = 2 * std::numbers::pi * t.frequency_hz[k],
                 ahead = hydro::waves::wavenumber(omega, tank->water) * (tank->body - tank->gauge) - omega * moved_s;
    t.h1[k] *= std::polar(1.0, ahead);
    t.h2[k] *= std::polar(1.0, ahead);
  }
}

/// (F107) Where waves of other frequencies than the peak's are so early or late of the shift that a segment loses them.
std::string loss_of(const Problem& problem, const Solution& found, double step) {
  const auto& tank = problem.options.tank;
  if (!tank) return {};
  constexpr double told = 0.03, heard = 0.05;  // of the gain; of the highest density
  const std::size_t peak = peak_of(found.waves);
  const auto omega = [&](std::size_t k) { return 2 * std::numbers::pi * found.waves.frequency_hz[k]; };
  const double apart = tank->body - tank->gauge, length = static_cast<double>(found.segment_samples) * step,
               shift = apart / hydro::waves::group_velocity(omega(peak), tank->water);
  double most = 0, at = 0;
  for (std::size_t k = 1; k < found.waves.density.size(); ++k) {
    if (found.waves.density[k] < heard * found.waves.density[peak]) continue;
    const double left = apart / hydro::waves::group_velocity(omega(k), tank->water) - shift,
                 loss = std::pow(std::numbers::pi * left / length, 2) * 2 / 3;
    if (loss > most) most = loss, at = found.waves.frequency_hz[k];
  }
  if (most < told) return {};
  return fmt::format(
      "waves go from the gauge to the body at other speeds than the highest ones: at {:.3g} Hz the gain "
      "is {:.2g} % too small; take longer segments, or a gauge nearer to the body",
      at, 100 * std::min(1.0, most));
}

/// What there is at one frequency: what filters leave of both sides, and the density of the waves over its highest.
struct Heard {
  double passed, waves;
};

/// (S9) with the errors of both slopes (F105).
Coefficient gain_at(const hs::TransferEstimate& t, std::size_t k, const SlopeError& slope, Heard heard,
                    double confidence) {
  constexpr double least_passed = 0.5;  // at the edges of a band; beyond, what a segment leaks from within it is seen
  constexpr double least_waves = 1e-3;  // a segment leaks that much beside its peak; noise of a gauge is seldom less
  const double gain = std::abs(t.h1[k]), error = gain * t.gain_relative_error[k];
  Coefficient out = with_parts("gain", gain, error, hs::student_t_quantile((1 + confidence) / 2, 2 * (t.averages - 1)),
                               0, confidence);
  count_slope(slope, gain, out);
  out.effective_samples = t.averages;
  const bool is_coherent = t.coherence[k] >= t.coherence_threshold;
  if (heard.passed >= least_passed && heard.waves >= least_waves && is_coherent) return out;
  out.value.reset();
  if (heard.passed < least_passed) {
    out.why_not = fmt::format("the filters of [prepare] leave {:.2g} of both channels there", heard.passed);
    return out;
  }
  if (heard.waves < least_waves && is_coherent) {
    out.why_not =
        fmt::format("the waves have {:.2g} of their highest density there, which is what segments leak and gauges hear",
                    heard.waves);
    return out;
  }
  out.why_not = fmt::format("its coherence is {:.2g}, and unrelated channels come to {:.2g}", t.coherence[k],
                            t.coherence_threshold);
  return out;
}

Response response_of(const Problem& problem, const Solution& so_far, std::size_t i, double step) {
  const Options& options = problem.options;
  const double peak = 2 * std::numbers::pi * so_far.waves.frequency_hz[peak_of(so_far.waves)];
  const std::ptrdiff_t later = samples_between(problem, so_far, peak, step);
  const std::vector<hs::InputOutput> runs = moved(so_far.records, i, later);
  const hs::WelchOptions segments{.segment = so_far.segment_samples};
  Response out{problem.runs[0].responses[i].name, hs::transfer(runs, step, segments), {}, {}, {}};
  out.resolution = hs::resolution_shift_of_gain(out.transfer, runs, step, segments);
  turn_phases(options.tank, static_cast<double>(later) * step, out.transfer);
  out.transfer.coherence_threshold = hs::coherence_threshold(out.transfer.averages, options.confidence);
  const SlopeError slope = slope_error_of(problem.elevation_slope, problem.response_slopes, i);
  const double highest = so_far.waves.density[peak_of(so_far.waves)];
  for (std::size_t k = 0; k < out.transfer.h1.size(); ++k)
    out.gain.push_back(gain_at(out.transfer, k, slope,
                               {gain_of(options.prepare, step, 2 * std::numbers::pi * out.transfer.frequency_hz[k]),
                                so_far.waves.density[k] / highest},
                               options.confidence));
  for (std::size_t k = 0; k < out.resolution.size(); ++k) {
    Coefficient& gain = out.gain[k];
    out.half_width.push_back(gain.value ? (gain.interval.high - gain.interval.low) / 2
                                        : std::numeric_limits<double>::quiet_NaN());
    count_shift(out.resolution[k], gain);  // (F118)
  }
  return out;
}

Report told(const Response& r, const std::string& unit, const Solution& found) {
  const hs::TransferEstimate& t = r.transfer;
  const std::size_t peak = peak_of(found.waves);
  std::vector<double> h1, h2, phase, low, high;
  for (std::size_t k = 0; k < t.h1.size(); ++k) {
    h1.push_back(std::abs(t.h1[k]));
    h2.push_back(std::abs(t.h2[k]));
    phase.push_back(std::arg(t.h1[k]));
    low.push_back(r.gain[k].interval.low);
    high.push_back(r.gain[k].interval.high);
  }
  Report out{.key = "response", .one_of_many = true};
  out.heading = fmt::format(
      "  {} at the waves' peak, {:.4g} Hz: H1 {:.4g} and H2 {:.4g} {}/m, coherence {:.3f}, phase "
      "{:.1f} ± {:.1f} deg",
      r.name, t.frequency_hz[peak], h1[peak], h2[peak], unit, t.coherence[peak], phase[peak] / degree,
      t.gain_relative_error[peak] / degree);
  out.facts = {{"name", r.name},     {"unit", unit + "/m"},      {"gain_h1", h1},
               {"gain_h1_low", low}, {"gain_h1_high", high},     {"gain_h2", h2},
               {"phase_rad", phase}, {"coherence", t.coherence}, {"phase_error_rad", t.gain_relative_error}};
  out.facts.emplace_back("resolution_shift", r.resolution);
  out.estimates = {{.coefficient = r.gain[peak], .unit = unit + "/m", .key = "at_peak"}};
  out.warn(hs::caution_of_resolution(r.name, t, r.resolution, r.half_width));
  return out;
}

void tell(const Problem& problem, Solution& found, double step) {
  const hs::TransferEstimate& t = found.responses[0].transfer;
  Report& report = found.report;
  report.heading = fmt::format(
      "{} segments of {:.4g} s from {} run{}, Hann, half overlapping, worth {:.3g} independent ones; unrelated "
      "channels "
      "stay below a coherence of {:.2f} at {:g} % of the frequencies",
      found.segments, static_cast<double>(found.segment_samples) * step, problem.runs.size(),
      problem.runs.size() > 1 ? "s" : "", t.averages, t.coherence_threshold, 100 * problem.options.confidence);
  append(report.facts, {{"segments", found.segments},
                        {"segment_s", static_cast<double>(found.segment_samples) * step},
                        {"averages", t.averages},
                        {"coherence_threshold", t.coherence_threshold},
                        {"frequency_hz", t.frequency_hz},
                        {"wave_density_m2_hz", found.waves.density}});
  report.warn(loss_of(problem, found, step));
  for (std::size_t i = 0; i < found.responses.size(); ++i)
    report.parts.push_back(told(found.responses[i], problem.units[i], found));
}

}  // namespace

Solution solve(const Problem& problem) {
  hydro::require(!problem.runs.empty(), "there are no runs in waves");
  Solution out{};
  for (const WaveRun& run : problem.runs) {
    hydro::require(!run.responses.empty() && run.responses.size() == problem.units.size(), "{} responses and {} units",
                   run.responses.size(), problem.units.size());
    Report report = begin_run(run.source);
    out.records.push_back(of_run(run.source, [&] { return prepared(run, problem.options.prepare, report); }));
    report.heading = fmt::format("{}: {} samples", run.source.name(), out.records.back().time.size());
    out.report.parts.push_back(std::move(report));
  }
  const double step = common_step(problem, out.records);
  const hs::WelchOptions options = segments_of(problem, out.records, step);
  out.segment_samples = options.segment;
  out.waves = spectrum_of(out.records, step, options, out.segments);
  for (std::size_t i = 0; i < problem.units.size(); ++i) out.responses.push_back(response_of(problem, out, i, step));
  tell(problem, out, step);
  return out;
}

}  // namespace fit::irregular_waves
