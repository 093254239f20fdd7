#include "fit/regular_waves.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "fit/band_pass.hpp"
#include "fit/steady.hpp"
#include "harmonic_series.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"
#include "hydro/signal/welch.hpp"
#include "hydro/waves/dispersion.hpp"
#include "restored_body.hpp"

namespace fit {
namespace {

constexpr double full_circle = 2 * std::numbers::pi;
using Values = std::span<const double>;

Eigen::VectorXd vector_of(Values v) { return Eigen::Map<const Eigen::VectorXd>(v.data(), std::ssize(v)); }

void check(Values time, Values elevation, std::span<const WaveChannel> responses, const RegularWaveOptions& o) {
  hydro::require(time.size() >= 64, "a record of waves needs 64 samples at least, got {}", time.size());
  const auto check_one = [&](const std::string& name, Values values) {
    hydro::require(values.size() == time.size(), "{} has {} samples, time {}", name, values.size(), time.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      hydro::require(std::isfinite(values[i]), "{} is not finite at {:.6g} s", name, time[i]);
  };
  check_one("the elevation", elevation);
  for (const WaveChannel& c : responses) check_one(c.name, c.values);
  hydro::require(o.harmonics >= 1 && o.harmonics <= 20, "1 to 20 harmonics can be fitted, got {}", o.harmonics);
  hydro::require(o.ramp >= 0 && o.settle_periods >= 0,
                 "times of ramp and settling must not be negative, got {} s and {}", o.ramp, o.settle_periods);
  hydro::require(0 < o.band_low && o.band_low < 1 && 1 < o.band_high,
                 "the band of the peaks must hold the frequency of the wave, got {} to {} times it", o.band_low,
                 o.band_high);
}

Values part_of(Values v, Stretch w) { return v.subspan(w.from, w.size()); }

Stretch samples_between(Values time, double from, double to) {
  const double slack = 1e-9 * (time.back() - time.front());
  return {static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), from - slack) - time.begin()),
          static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), to + slack) - time.begin())};
}

double frequency_in(Values elevation, double step) {
  const Eigen::VectorXd v = vector_of(elevation);
  const Eigen::VectorXd about = v.array() - v.mean();
  hydro::require(about.cwiseAbs().maxCoeff() > 1e-12 * v.cwiseAbs().maxCoeff(), "the surface does not move");
  return frequency_of(about, step);
}

/// Steady waves by the times of the tank. (F94)
Stretch by_times(Values time, const WaveTimes& times, double period, const RegularWaveOptions& o) {
  const double begin = std::max(time.front(), o.started + times.front + o.ramp + o.settle_periods * period),
               end = std::min(time.back(), o.started + times.back_from_end);
  hydro::require(begin + 3 * period <= end,
                 "no three periods of {:.4g} s are steady: the front is there at {:.4g} s, with the ramp and {:g} "
                 "periods to settle "
                 "it is {:.4g} s, and {} at {:.4g} s",
                 period, o.started + times.front, o.settle_periods, begin,
                 o.started + times.back_from_end < time.back() ? "waves come back from the end" : "the record ends",
                 end);
  return samples_between(time, begin, end);
}

/// The longest whole number of periods from the beginning.
Stretch whole_periods(Stretch w, double period, double step, std::size_t& cycles) {
  const double samples = period / step;
  hydro::require(samples >= 8, "a period of {:.4g} s has {:.2g} samples, and needs 8 at least", period, samples);
  cycles = static_cast<std::size_t>(static_cast<double>(w.to - w.from) / samples + 1e-6);
  hydro::require(cycles >= 3, "the window holds {} whole periods of {:.4g} s, and needs 3 at least", cycles, period);
  return {w.from, w.from + static_cast<std::size_t>(std::llround(static_cast<double>(cycles) * samples))};
}

/// What lies in a band about `omega`, which keeps its size; empty where the record is shorter than that needs. `lost`:
/// samples given up in front.
std::vector<double> in_band(Values values, double omega, double low_hz, double high_hz, double step,
                            std::size_t& lost) {
  const bool open = high_hz >= 0.45 / step;  // the sampling itself is the upper edge
  const BandPass band(low_hz, open ? std::nullopt : std::optional(high_hz), step);
  lost = band.settling();
  if (values.size() < 2 * lost + 64) return {};
  std::vector<double> out = band.apply(values);
  const double gain = band.gain(omega);
  for (double& v : out) v /= gain;
  return out;
}

/// Half of highest minus lowest sample of each period of the window, by parabolas through the three about each.
std::vector<double> half_heights(Values v, double samples_a_period) {
  const auto extreme = [&](std::size_t at, double sign) {
    if (at == 0 || at + 1 >= v.size()) return v[at];
    const double a = v[at - 1], b = v[at], c = v[at + 1], bend = a - 2 * b + c;
    return sign * bend < 0 ? b - (a - c) * (a - c) / (8 * bend) : b;
  };
  std::vector<double> out;
  for (double from = 0; from + samples_a_period <= static_cast<double>(v.size()) + 0.5; from += samples_a_period) {
    const auto first = v.begin() + static_cast<std::ptrdiff_t>(std::llround(from)),
               last = v.begin() +
                      std::min(std::ssize(v), static_cast<std::ptrdiff_t>(std::llround(from + samples_a_period)));
    const auto [low, high] = std::minmax_element(first, last);
    out.push_back((extreme(static_cast<std::size_t>(high - v.begin()), 1) -
                   extreme(static_cast<std::size_t>(low - v.begin()), -1)) /
                  2);
  }
  return out;
}

/// Amplitudes by peaks, (F96): of the band alone.
void add_peaks(Values all, Stretch w, double omega, double step, const RegularWaveOptions& o, Oscillation& out) {
  std::size_t lost = 0;
  const double hz = omega / full_circle;
  const std::vector<double> band = in_band(all, omega, o.band_low * hz, o.band_high * hz, step, lost);
  const std::size_t from = std::max(w.from, lost), to = std::min(w.to, lost + band.size());
  if (band.empty() || to < from + 64) return;
  out.half_heights = half_heights(Values(band).subspan(from - lost, to - from), full_circle / omega / step);
  const auto n = static_cast<double>(out.half_heights.size());
  if (n < 2) return;
  out.by_peaks = std::accumulate(out.half_heights.begin(), out.half_heights.end(), 0.0) / n;
  double squares = 0;
  for (const double h : out.half_heights) squares += (h - out.by_peaks) * (h - out.by_peaks);
  out.by_peaks_error = std::sqrt(squares / (n - 1) / n);
}

/// Quarters of the window, or halves of a short one. The noise is that of the steadiest of them: what reflected waves
/// leave over would hide them. A range of four is beyond six deviations once in ten thousand times.
void add_change(const Eigen::VectorXd& t, const Eigen::VectorXd& v, double omega, double step, Oscillation& out) {
  const Eigen::Index parts = static_cast<double>(t.size()) * step * omega >= 8 * full_circle ? 4 : 2,
                     size = t.size() / parts;
  double low = std::numeric_limits<double>::infinity(), high = 0, noise = low;
  for (Eigen::Index p = 0; p < parts; ++p) {
    const HarmonicSeries part = fit_series(t.segment(p * size, size), v.segment(p * size, size), omega, 1, step);
    low = std::min(low, std::abs(part.amplitude(1)));
    high = std::max(high, std::abs(part.amplitude(1)));
    noise = std::min(noise, part.error());
  }
  const double whole = std::abs(out.harmonics[0]);
  if (!(whole > 0)) return;
  out.change = (high - low) / whole;
  out.change_allowed = std::max(0.02, 6 * noise / whole);
}

Oscillation oscillation(Values time, Values all, Stretch w, double omega, double step, const RegularWaveOptions& o) {
  const Eigen::VectorXd t = vector_of(part_of(time, w)), v = vector_of(part_of(all, w));
  const int highest =
      std::min(o.harmonics, static_cast<int>(full_circle / omega / step / 4));  // four samples a period of it
  const HarmonicSeries series = fit_series(t, v, omega, highest, step);
  Oscillation out{.mean = series.x[0],
                  .harmonics = {},
                  .error = series.error(),
                  .dof = series.dof,
                  .half_heights = {},
                  .by_peaks = std::nan(""),
                  .by_peaks_error = std::nan(""),
                  .residual_rms = series.rms,
                  .change = 0,
                  .change_allowed = 0,
                  .fitted = {series.fitted.begin(), series.fitted.end()}};
  for (int k = 1; k <= highest; ++k) out.harmonics.push_back(series.amplitude(k));
  add_change(t, v, omega, step, out);
  add_peaks(all, w, omega, step, o, out);
  return out;
}

double wrapped(double phase) { return std::remainder(phase, full_circle); }

WaveResponse response(const WaveChannel& channel, Oscillation motion, const Oscillation& wave, double phase_lag,
                      double confidence) {  // (F95)
  WaveResponse out{
      .name = channel.name, .motion = std::move(motion), .rao = {}, .phase = 0, .phase_error = 0, .rao_by_peaks = 0};
  const std::complex<double> a = out.motion.harmonics[0], zeta = wave.harmonics[0];
  const double size = std::abs(a), height = std::abs(zeta), ratio = size / height;
  const double error = std::hypot(out.motion.error, ratio * wave.error) / height,
               t = hydro::signal::student_t_quantile((1 + confidence) / 2, std::min(out.motion.dof, wave.dof));
  out.rao = judged(with_parts("rao", ratio, error, t, 0, confidence));
  out.phase = wrapped(std::arg(a) - std::arg(zeta) + phase_lag);
  out.phase_error = ratio > 0 ? error / ratio : std::numeric_limits<double>::infinity();
  out.rao_by_peaks = out.motion.by_peaks / wave.by_peaks;
  return out;
}

/// Waves that go on changing are told.
void add_cautions(const std::string& name, const Oscillation& o, std::vector<std::string>& out) {
  if (o.change > o.change_allowed)
    out.push_back(
        fmt::format("the amplitude of {} changes by {:.2g} % within the window: the waves are not steady yet, or "
                    "reflected ones pass",
                    name, 100 * o.change));
}

}  // namespace

WaveTimes wave_times(double omega, const WaveTank& tank) {  // (F94)
  for (const double x : {tank.gauge, tank.body})
    hydro::require(x >= 0 && std::isfinite(x) && x < tank.end,
                   "gauge and body must stand between the wavemaker and the end at {:.4g} m, got {:.4g} m", tank.end,
                   x);
  const double c = hydro::waves::group_velocity(omega, tank.water), far = std::max(tank.gauge, tank.body),
               near = std::min(tank.gauge, tank.body);
  return {.group_velocity = c,
          .front = far / c,
          .back_from_end = (2 * tank.end - far) / c,
          .back_from_maker = (2 * tank.end + near) / c};
}

RegularWaveFit fit_regular_waves(Values time, Values elevation, std::span<const WaveChannel> responses,
                                 const RegularWaveOptions& options, std::optional<std::pair<double, double>> span) {
  check(time, elevation, responses, options);
  const double step = hydro::signal::even_step(time);
  RegularWaveFit out{};
  Stretch w{};
  if (span) {
    w = samples_between(time, span->first, span->second);
    hydro::require(w.to >= w.from + 64, "the window from {:.4g} s to {:.4g} s holds {} samples, and needs 64",
                   span->first, span->second, w.to > w.from ? w.to - w.from : 0);
  } else {
    const double rough = frequency_in(elevation, step);
    out.times = wave_times(rough, options.tank);
    w = by_times(time, *out.times, full_circle / rough, options);
  }
  out.omega = frequency_in(part_of(elevation, w), step);
  w = whole_periods(w, full_circle / out.omega, step, out.cycles);
  out.from = w.from;
  out.to = w.to;
  out.wave = oscillation(time, elevation, w, out.omega, step, options);
  add_cautions("the waves", out.wave, out.cautions);
  const double lag = hydro::waves::wavenumber(out.omega, options.tank.water) * (options.tank.body - options.tank.gauge);
  for (const WaveChannel& channel : responses) {
    out.responses.push_back(response(channel, oscillation(time, channel.values, w, out.omega, step, options), out.wave,
                                     lag, options.confidence));
    add_cautions(channel.name, out.responses.back().motion, out.cautions);
  }
  return out;
}

}  // namespace fit
