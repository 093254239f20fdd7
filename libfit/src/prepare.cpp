#include "fit/prepare.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "fit/correlated.hpp"
#include "fit/cycles.hpp"
#include "fit/delay.hpp"
#include "fit/differentiate.hpp"
#include "fit/sensor.hpp"
#include "hydro/base/error.hpp"
#include "motion_errors.hpp"
#include "prepare_steps.hpp"

namespace fit {
namespace {

using hydro::InputError;

double mean_of(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

/// A run on its way; every step keeps all columns at one length.
struct Work {
  RawRun run;
  double step = 0;
  Prepared out;
  StepLog log;
  std::vector<double> pattern;                    // position or velocity: where cycles are seen
  std::vector<std::optional<Rounding>> rounding;  // of each channel of the force
  std::vector<double> zero_errors;                // of each channel of the force, N

  std::vector<std::vector<double>*> columns() {
    std::vector<std::vector<double>*> all{&run.time,
                                          &run.position,
                                          &run.velocity,
                                          &run.acceleration,
                                          &run.cross_velocity,
                                          &run.elevation,
                                          &run.water_velocity,
                                          &run.water_acceleration,
                                          &out.record.time,
                                          &out.record.force,
                                          &pattern,
                                          &out.record.drag_flow,
                                          &out.record.velocity,
                                          &out.record.acceleration,
                                          &out.record.water_acceleration,
                                          &out.record.linear_flow};
    for (ForceChannel& f : run.force) all.push_back(&f.values);
    for (ForceError& e : out.force_errors) all.push_back(&e.force);
    for (std::vector<double>& draw : out.record.rounding) all.push_back(&draw);
    for (MotionError& e : out.record.motion_errors)
      for (auto* c : {&e.velocity, &e.acceleration, &e.water_acceleration, &e.drag_flow, &e.linear_flow})
        all.push_back(c);
    return all;
  }
  /// Keeps samples [from, from + count) of every column that is there.
  void cut(std::size_t from, std::size_t count) {
    for (auto* c : columns())
      if (!c->empty()) keep_part(*c, from, count);
  }
};

/// The raw columns with their names.
std::vector<NamedColumn> measured(RawRun& run) {
  std::vector<NamedColumn> all;
  for (ForceChannel& f : run.force) all.push_back({f.name, &f.values});
  for (auto& [name, column] : {std::pair{run.position_name.c_str(), &run.position},
                               {"velocity", &run.velocity},
                               {"acceleration", &run.acceleration},
                               {"cross velocity", &run.cross_velocity},
                               {"elevation", &run.elevation},
                               {"water velocity", &run.water_velocity},
                               {"water acceleration", &run.water_acceleration}})
    if (!column->empty()) all.push_back({name, column});
  return all;
}

/// A motion was recorded beside that of the water.
bool moves(const RawRun& run) { return !run.velocity.empty() || !run.position.empty(); }

void check_columns(RawRun& run) {
  for (const auto& [name, column] : measured(run)) {
    hydro::require(column->size() == run.time.size(), "{} has {} samples, time {}", name, column->size(),
                   run.time.size());
    require_signal(name, *column);
  }
}

void check(RawRun& run) {
  hydro::require(!run.force.empty(), "a run needs a force");
  hydro::require(run.velocity.empty() || run.position.empty(), "a run has a position or a velocity, not both");
  hydro::require(run.elevation.empty() || run.water_velocity.empty(),
                 "a run has an elevation or the water's velocity, not both");
  const bool moved = moves(run);
  hydro::require(moved || !run.elevation.empty(), "a run needs a position, a velocity or a surface elevation");
  hydro::require(run.water_acceleration.empty() || !run.water_velocity.empty(),
                 "the water's acceleration needs its velocity beside it");
  hydro::require(run.elevation.empty() == !run.probe, "an elevation needs to know where probe and body are");
  hydro::require(!run.probe || !run.probe->follow || !run.position.empty(),
                 "the water is to be taken where the body is, and its position is not known");
  check_columns(run);
}

RecordColumns record_of(Work& w) { return {w.run.time, w.step, measured(w.run), w.log}; }

/// Channels that carry one body together move together.
void compare_channels(const RawRun& run) {  // (F26)
  for (std::size_t i = 1; i < run.force.size(); ++i) {
    const auto &a = run.force[0].values, &b = run.force[i].values;
    const double mean_a = mean_of(a), mean_b = mean_of(b);
    double ab = 0, aa = 0, bb = 0;
    for (std::size_t j = 0; j < a.size(); ++j) {
      ab += (a[j] - mean_a) * (b[j] - mean_b);
      aa += (a[j] - mean_a) * (a[j] - mean_a);
      bb += (b[j] - mean_b) * (b[j] - mean_b);
    }
    if (ab / std::sqrt(aa * bb) < -0.5)
      throw InputError(fmt::format("{} falls where {} rises (correlation {:.2f}): one of them has the wrong sign",
                                   run.force[i].name, run.force[0].name, ab / std::sqrt(aa * bb)),
                       {}, fmt::format("write \"-{}\" among the channels to turn it", run.force[i].name));
  }
}

/// Standard error of the mean of a record at rest, its memory counted (F3).
double error_of_mean(const std::vector<double>& v, double mean) {
  Eigen::VectorXd e = Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())).array() - mean;
  if (e.squaredNorm() == 0) return 0;
  const Eigen::VectorXd gamma = fit_autoregression(e).autocovariance;
  return std::sqrt(std::max(gamma[0], 2 * gamma.sum() - gamma[0]) / static_cast<double>(v.size()));
}

/// Volts to newtons, zero off; (F26).
void to_force(Work& w, ForceChannel& f) {
  const double slope = f.calibration ? f.calibration->slope : 1;
  double zero = f.calibration ? f.calibration->offset : 0, zero_error = f.calibration ? f.calibration->offset_error : 0;
  if (!f.zero_run.empty()) {
    zero = mean_of(f.zero_run);
    zero_error = error_of_mean(f.zero_run, zero);
  }
  for (double& v : f.values) v = (v - zero) / slope;
  w.zero_errors.push_back(zero_error / std::abs(slope));
  if (f.calibration)
    w.log.tell(
        "calibration: {} has {:.5g} ± {:.2g} {}, {}", f.name, slope, f.calibration->slope_error, f.calibration->unit,
        f.calibration->pairs > 0 ? fmt::format("hysteresis {:.2g} % of its range", 100 * f.calibration->hysteresis)
                                 : std::string("hysteresis not known"));
  if (!f.zero_run.empty())
    w.log.tell("zero: {:.4g} N ± {:.2g} N taken off {}, the mean of {} samples at rest", zero / slope,
               w.zero_errors.back(), f.name, f.zero_run.size());
}

void sum_forces(Work& w) {
  const std::size_t n = w.run.time.size();
  w.out.record.force.assign(n, 0.0);
  for (ForceChannel& f : w.run.force) {
    to_force(w, f);
    for (std::size_t j = 0; j < n; ++j) w.out.record.force[j] += f.values[j];
  }
  if (w.run.force.size() > 1) w.log.tell("force: the sum of {} channels", w.run.force.size());
}

/// Which sensors of the force round with a memory; looked for in their own samples, before anything moves these. (F69)
void look_for_rounding(Work& w) {
  for (const ForceChannel& f : w.run.force) {
    w.rounding.push_back(find_rounding(f.values, w.step));
    if (w.rounding.back())
      w.log.tell("steps: {} has less noise than half of one; what rounding may have done to it is in the intervals",
                 f.name);
  }
}

/// What makes the force, in columns: drag, inertia, linear drag and an offset.
Eigen::MatrixXd force_columns(const ForceRecord& r) {
  const auto n = std::ssize(r.time);
  const auto column = [n](const std::vector<double>& v) { return Eigen::Map<const Eigen::ArrayXd>(v.data(), n); };
  Eigen::MatrixXd out(n, r.water_acceleration.empty() ? 4 : 5);
  const auto u = column(r.velocity);
  out.col(0) = r.drag_flow.empty() ? (u.abs() * u).eval() : column(r.drag_flow).eval();
  out.col(1) = column(r.acceleration);
  out.col(2) = u;
  out.col(3).setOnes();
  if (!r.water_acceleration.empty()) out.col(4) = column(r.water_acceleration);
  return out;
}

/// What the steps of the force's sensors may have done; channels round by themselves. (F69)
void add_rounding(Work& w) {
  auto& sum = w.out.record.rounding;
  std::uint64_t stream = 2;  // after those of the motions
  for (std::size_t i = 0; i < w.run.force.size(); ++i) {
    ++stream;
    if (!w.rounding[i]) continue;
    const std::vector<double>& values = w.run.force[i].values;
    const auto draws = rounding_of(values, force_columns(w.out.record), *w.rounding[i], w.step, stream);
    if (sum.empty()) sum.assign(draws.size(), std::vector<double>(values.size(), 0.0));
    for (std::size_t d = 0; d < draws.size(); ++d)
      for (std::size_t j = 0; j < draws[d].size(); ++j) sum[d][j] += draws[d][j];
  }
}

void take_delay(Work& w, double delay_s) {  // (F24)
  if (delay_s == 0) return;
  const double lag = delay_s / w.step;
  const auto margin = static_cast<std::size_t>(std::ceil(std::abs(lag))) + 3;
  hydro::require(w.run.time.size() > 2 * margin, "the record is shorter than twice the delay of {:.4g} s", delay_s);
  const auto force = later(w.out.record.force, lag, margin);
  std::vector<std::vector<double>> channels;
  for (const ForceChannel& f : w.run.force) channels.push_back(later(f.values, lag, margin));
  w.cut(margin, w.run.time.size() - 2 * margin);
  w.out.record.force = force;
  for (std::size_t i = 0; i < channels.size(); ++i) w.run.force[i].values = channels[i];
  w.log.tell("delay: the force is taken {:.4g} s earlier", delay_s);
}

/// The phase kx that the body's way through the waves makes; (F62).
void tell_excursion(Work& w, const ProbeToBody& probe, double k) {
  double furthest = 0;
  for (const double x : w.run.position) furthest = std::max(furthest, std::abs(x));
  if (probe.follow)
    w.log.tell("water: taken where the body is, up to {:.3g} m from its place at rest: {:.2g} rad of the main wave",
               furthest, k * furthest);
  else if (k * furthest > 0.1)
    w.log.warn(
        "the water is taken where the body is at rest; it moves up to {:.3g} m from there, {:.2g} rad of the main "
        "wave: "
        "with follow = true in [model] wave it is taken where the body is",
        furthest, k * furthest);
}

/// Motion of the water at the body from the surface at a probe.
void add_waves(Work& w) {
  if (w.run.elevation.empty()) return;
  const ProbeToBody& probe = *w.run.probe;
  const WaterMotion m = water_motion(w.run.elevation, w.step, probe, w.run.position);
  const bool body_too = moves(w.run);
  if (!w.run.position.empty()) tell_excursion(w, probe, m.main_wavenumber);
  w.cut(m.first, m.velocity.size());
  (body_too ? w.run.water_velocity : w.run.velocity) = m.velocity;
  (body_too ? w.run.water_acceleration : w.run.acceleration) = m.acceleration;
  w.run.cross_velocity = m.rise;
  if (w.run.probe->regular)
    return w.log.tell(
        "water: one linear wave of {:.4g} s fitted to the probe ({:.2g} % of the surface are not in it), {:.4g} m "
        "under "
        "and {:.4g} m ahead of it",
        m.main_period_s, 100 * m.left, -w.run.probe->level, w.run.probe->ahead);
  w.log.tell(
      "water: linear waves up to {:.3g} Hz from the surface at the probe, {:.4g} m below and {:.4g} m ahead of it",
      m.highest_hz, -w.run.probe->level, w.run.probe->ahead);
}

/// How derivatives were had, with what they are good for.
std::string method_of(const Motion& m, Derivative method) {
  if (method == Derivative::fourier_series)
    return fmt::format(
        "a Fourier series of {:.0f} harmonics of {:.4g} s, to {:.3g} Hz, which leaves {:.2g} % of it out",
        m.bandwidth_hz * m.main_period_s, m.main_period_s, m.bandwidth_hz, 100 * m.left);
  return fmt::format(
      "{} over {} samples (no delay): 1 % to {:.3g} Hz, {:.2g} % at the main frequency",
      method == Derivative::smoothing_spline ? "a smoothing spline of degree 5" : "local polynomials of degree 4",
      2 * m.half_width + 1, m.bandwidth_hz, 100 * m.gain_error_main);
}

void tell_noise(Work& w, const Motion& m) {  // (F6), (F68)
  const auto& a = w.out.record.acceleration;
  const double squares = std::inner_product(a.begin(), a.end(), a.begin(), 0.0) / static_cast<double>(a.size());
  const double share = m.noise_acceleration * m.noise_acceleration / squares;
  if (share <= 0.003) return;
  w.log.warn(
      "noise is {:.2g} % of the derived acceleration's variance: {}; a low pass, or derivatives up to fewer than "
      "{:.3g} "
      "Hz, have less of it",
      100 * share,
      w.out.record.motion_errors.empty()
          ? "inertia comes out too small by as much"
          : "what that takes from inertia is put back as far as the noise is white, or rounding to steps",
      m.bandwidth_hz);
}

/// Velocity and acceleration, measured or derived; (F5), (F6), (F44), (F45).
void add_motion(Work& w, const PrepareOptions& options) {
  const bool from_velocity = !w.run.velocity.empty();
  w.pattern = from_velocity ? w.run.velocity : w.run.position;
  ForceRecord& r = w.out.record;
  r.time = w.run.time;
  if (from_velocity && !w.run.acceleration.empty()) {
    r.velocity = w.run.velocity;
    r.acceleration = w.run.acceleration;
    return;
  }
  const auto derive = from_velocity ? ::fit::from_velocity : from_position;
  const Motion m = derive(w.pattern, w.step, options.derivative_bandwidth_hz, options.derivative);
  auto errors = errors_of(m, w.pattern, from_velocity, 1);
  if (!w.run.acceleration.empty())
    for (MotionError& e : errors) std::fill(e.acceleration.begin(), e.acceleration.end(), 0.0);
  w.cut(m.first, m.velocity.size());
  r.motion_errors = std::move(errors);
  r.velocity = m.velocity;
  r.acceleration = w.run.acceleration.empty() ? m.acceleration : w.run.acceleration;
  w.log.tell("derivatives of the {} by {}; noise of velocity {:.2g} m/s, of acceleration {:.2g} m/s^2",
             from_velocity ? "velocity" : "position", method_of(m, options.derivative), m.noise_velocity,
             m.noise_acceleration);
  if (w.run.acceleration.empty()) tell_noise(w, m);
}

/// From the body's motion to that of the water against it; (F49).
void add_water(Work& w, const PrepareOptions& options) {
  if (w.run.water_velocity.empty()) return;
  if (w.run.water_acceleration.empty()) {
    const Motion m = from_velocity(w.run.water_velocity, w.step, options.derivative_bandwidth_hz, options.derivative);
    const auto errors = errors_of(m, w.run.water_velocity, true, 2);
    w.cut(m.first, m.velocity.size());
    w.out.record.motion_errors = relative_errors(w.out.record.motion_errors, errors);
    w.run.water_velocity = m.velocity;
    w.run.water_acceleration = m.acceleration;
    w.log.tell("acceleration of the water by {}", method_of(m, options.derivative));
  } else {
    w.out.record.motion_errors = relative_errors(w.out.record.motion_errors, {});
  }
  ForceRecord& r = w.out.record;
  for (std::size_t j = 0; j < r.time.size(); ++j) {
    r.velocity[j] = w.run.water_velocity[j] - r.velocity[j];
    r.acceleration[j] = w.run.water_acceleration[j] - r.acceleration[j];
  }
  r.water_acceleration = w.run.water_acceleration;
  w.pattern = r.velocity;
  w.log.tell("flow: velocity and acceleration of the water less those of the body");
}

/// √(u² + w²) u where the water moves across as well; (F7).
void add_cross_flow(Work& w) {
  add_drag_errors(w.out.record.velocity, w.run.cross_velocity, w.out.record.motion_errors);
  if (w.run.cross_velocity.empty()) return;
  for (std::size_t j = 0; j < w.run.time.size(); ++j)
    w.out.record.drag_flow.push_back(std::hypot(w.out.record.velocity[j], w.run.cross_velocity[j]) *
                                     w.out.record.velocity[j]);
  w.log.tell("drag: the velocity across counts, sqrt(u^2 + w^2) u");
}

/// Lines of the force that are no harmonics of the motion, and what the filters leave of them; (F21).
void tell_lines(Work& w, const PrepareOptions& options) {
  const auto [low, high] = std::minmax_element(w.pattern.begin(), w.pattern.end());
  if (w.pattern.size() < 64 || !(*high > *low)) return;
  const auto cycles = find_cycles(w.pattern);
  if (cycles.empty()) return;
  const double main_hz = 1 / ((cycles.back().end - cycles.back().start) * w.step);
  for (const SpectralLine& line : find_lines(w.out.record.force, w.step, 10 * main_hz)) {
    const double left = gain_of(options, w.step, 2 * std::numbers::pi * line.frequency_hz);
    const bool mains = std::abs(line.frequency_hz - 50) < 0.5 || std::abs(line.frequency_hz - 60) < 0.5;
    w.log.tell("line: {:.4g} Hz in the force, amplitude {:.2g} N{}; the filters leave {:.1g} of it", line.frequency_hz,
               line.amplitude, mains ? ", hum of the mains" : "", left);
  }
}

/// Columns that a filter of the force runs over: the force, each channel of it, and the model of both.
std::vector<std::vector<double>*> force_and_model(Work& w) {
  ForceRecord& r = w.out.record;
  std::vector<std::vector<double>*> all{&r.force, &r.acceleration, &r.drag_flow, &r.water_acceleration, &r.linear_flow};
  for (MotionError& e : r.motion_errors)
    for (auto* column : {&e.acceleration, &e.drag_flow, &e.water_acceleration, &e.linear_flow}) all.push_back(column);
  for (std::vector<double>& draw : r.rounding) all.push_back(&draw);
  for (ForceChannel& c : w.run.force) all.push_back(&c.values);
  std::erase_if(all, [](const auto* column) { return column->empty(); });
  return all;
}

/// With the ends that it spoils given up.
template <class Filter>
void filter_force(Work& w, const Filter& f) {
  std::vector<std::pair<std::vector<double>*, std::vector<double>>> smooth;
  for (auto* column : force_and_model(w)) smooth.push_back({column, f.apply(*column)});
  w.cut(f.settling(), w.out.record.time.size() - 2 * f.settling());
  for (auto& [column, values] : smooth) *column = std::move(values);
  w.log.steps.push_back(told(f, f.name() + " over force, acceleration and |u|u alike", w.step));
}

/// A line off force and model alike is a line more in the fit. (F108)
void take_trend(Work& w, const WindowChoice& window) {
  w.log.steps.push_back(Trend(window, w.out.record.time, w.out.record.force).told("the force") +
                        ", and those of acceleration and |u|u");
  for (auto* column : force_and_model(w))
    Trend(window, w.out.record.time, *column).take_off(w.out.record.time, *column);
}

void filter_all(Work& w, const PrepareOptions& options) {  // (F25)
  tell_lines(w, options);
  if (options.filters.empty() && !options.detrend && !options.band_pass) return;
  ForceRecord& r = w.out.record;
  if (r.drag_flow.empty())
    for (const double u : r.velocity) r.drag_flow.push_back(std::abs(u) * u);
  if (options.linear_drag) r.linear_flow = r.velocity;
  for (MotionError& e : r.motion_errors)
    if (options.linear_drag) e.linear_flow = e.velocity;
  if (options.detrend) take_trend(w, options.window);
  for (const FilterChoice& choice : options.filters) filter_force(w, filter_of(choice, w.step));
  if (options.band_pass) filter_force(w, BandPass(options.band_pass->low_hz, options.band_pass->high_hz, w.step));
}

std::vector<double> repeated(const std::vector<double>& cycle, std::size_t times) {
  std::vector<double> out;
  for (std::size_t i = 0; i < times; ++i) out.insert(out.end(), cycle.begin(), cycle.end());
  return out;
}

/// Cycles over each other: what moves becomes its mean, repeated; forces stay each cycle's own, at the same phases.
void lay_cycles(Work& w, const std::vector<Cycle>& cycles) {  // (F47)
  hydro::require(cycles.size() >= 2, "a mean cycle needs two cycles of full amplitude at least, the record has {}",
                 cycles.size());
  ForceRecord& r = w.out.record;
  const double length = (cycles.back().end - cycles.front().start) / static_cast<double>(cycles.size()),
               origin = r.time.front() + w.step * cycles.front().start;
  const auto points = static_cast<std::size_t>(std::lround(length));
  const auto laid = [&](const std::vector<double>& v) { return on_phases(v, cycles, points); };
  const CycleMean velocity = mean_cycle(laid(r.velocity), points);
  hydro::require(velocity.left < 0.1, "the velocity differs from cycle to cycle by {:.2g} %: there is no mean cycle",
                 100 * velocity.left);
  if (r.drag_flow.empty())
    for (const double u : r.velocity) r.drag_flow.push_back(std::abs(u) * u);
  for (auto* column : {&r.velocity, &r.acceleration, &r.drag_flow, &r.water_acceleration, &r.linear_flow, &w.pattern})
    if (!column->empty()) *column = repeated(mean_cycle(laid(*column), points).mean, cycles.size());
  for (MotionError& e : r.motion_errors)
    for (auto* column : {&e.velocity, &e.acceleration, &e.drag_flow, &e.water_acceleration, &e.linear_flow})
      if (!column->empty()) *column = repeated(mean_cycle(laid(*column), points).mean, cycles.size());
  for (std::vector<double>& draw : r.rounding) draw = laid(draw);
  r.force = laid(r.force);
  for (ForceChannel& f : w.run.force) f.values = laid(f.values);
  const CycleMean force = mean_cycle(r.force, points);
  w.step *= length / static_cast<double>(points);
  r.time.resize(r.force.size());
  for (std::size_t k = 0; k < r.time.size(); ++k) r.time[k] = origin + w.step * static_cast<double>(k);
  w.run.time = r.time;
  w.out.mean_force = {.time = {}, .force = force.mean, .standard_error = force.standard_error, .cycles = cycles.size()};
  for (std::size_t k = 0; k < points; ++k) w.out.mean_force->time.push_back(w.step * static_cast<double>(k));
  for (std::size_t g = 0; g <= cycles.size(); ++g)  // all of one length now
    w.out.cycle_starts[g] = origin + w.step * static_cast<double>(g * points);
  w.log.tell(
      "mean cycle: {} cycles of {:.4g} s over each other at {} phases; single ones differ from their mean by {:.2g} % "
      "of the velocity and {:.2g} % of the force",
      cycles.size(), w.step * static_cast<double>(points), points, 100 * velocity.left, 100 * force.left);
}

void cut_cycles(Work& w, const WindowChoice& window, bool average) {  // (F23)
  auto cycles = full_amplitude(find_cycles(w.pattern), window.tolerance);
  const auto wanted = static_cast<std::size_t>(window.cycles);
  hydro::require(cycles.size() >= wanted, "{} cycles of full amplitude are asked for, the record has {}", wanted,
                 cycles.size());
  if (wanted > 0) cycles.erase(cycles.begin(), cycles.end() - static_cast<std::ptrdiff_t>(wanted));
  const double origin = w.run.time.front();
  for (const Cycle& c : cycles) w.out.cycle_starts.push_back(origin + w.step * c.start);
  w.out.cycle_starts.push_back(origin + w.step * cycles.back().end);
  w.log.tell("window: {} cycles of full amplitude within {:g} %, from {:.4g} s to {:.4g} s", cycles.size(),
             100 * window.tolerance, w.out.cycle_starts.front(), w.out.cycle_starts.back());
  if (average) return lay_cycles(w, cycles);
  const auto from = static_cast<std::size_t>(std::ceil(cycles.front().start)),
             to = static_cast<std::size_t>(std::floor(cycles.back().end));
  w.cut(from, to - from + 1);
}

void cut_window(Work& w, const WindowChoice& window, bool average) {
  hydro::require(!average || window.kind == WindowChoice::Kind::full_cycles,
                 "a mean cycle needs a window of full cycles");
  if (window.kind == WindowChoice::Kind::full_cycles) return cut_cycles(w, window, average);
  if (window.kind == WindowChoice::Kind::all) return;
  const SampleSpan part = samples_within(window, w.run.time);
  w.cut(part.from, part.to - part.from);
  w.log.tell("window: from {:.4g} s to {:.4g} s", w.run.time.front(), w.run.time.back());
}

/// What one standard deviation of calibration and zero does to the force; (F26).
void add_force_errors(Work& w) {
  const std::size_t n = w.run.time.size();
  for (const ForceChannel& f : w.run.force) {
    if (!f.calibration) continue;
    const Calibration& c = *f.calibration;
    ForceError slope{"slope of " + f.name, f.values}, loop{"hysteresis of " + f.name, std::vector<double>(n, 0.0)};
    for (double& v : slope.force) v *= c.slope_error / std::abs(c.slope);
    // Half the loop's width on either side of the line, even in between: a deviation of 1/√3 of the half.
    const double half = c.hysteresis * c.range / std::abs(c.slope) / (2 * std::sqrt(3.0));
    for (std::size_t j = 1; j < n; ++j) loop.force[j] = f.values[j] > f.values[j - 1] ? half : -half;
    w.out.force_errors.push_back(std::move(slope));
    w.out.force_errors.push_back(std::move(loop));
  }
}

Work begun(RawRun run) {
  Work w{.run = std::move(run), .step = 0, .out = {}, .log = {}, .pattern = {}, .rounding = {}, .zero_errors = {}};
  hydro::require(w.run.time.size() >= 3, "a record needs at least three samples, got {}", w.run.time.size());
  return w;
}

/// Where what is slow is taken off.
bool straightened(const PrepareOptions& options) {
  return options.detrend || options.band_pass || options.band_about_waves;
}

/// What every record with a force goes through before anything is made of it.
void force_on_grid(Work& w, const PrepareOptions& options, const std::vector<double>* rests = nullptr) {
  compare_channels(w.run);
  RecordColumns record = record_of(w);
  evened_and_cleaned(record, options, rests);
  resample(record, options.resample_hz);
  sum_forces(w);
}

}  // namespace

Prepared prepare(RawRun run, const PrepareOptions& options) {
  hydro::require(!options.band_about_waves, "a band about the waves needs their frequency where no surface tells it");
  Work w = begun(std::move(run));
  check(w.run);
  force_on_grid(w, options);
  look_for_rounding(w);
  take_delay(w, options.delay_s);
  add_waves(w);
  add_motion(w, options);
  add_water(w, options);
  add_cross_flow(w);
  add_rounding(w);
  filter_all(w, options);
  cut_window(w, options.window, options.average_cycles);
  add_force_errors(w);
  w.out.steps = std::move(w.log.steps);
  w.out.cautions = std::move(w.log.cautions);
  return std::move(w.out);
}

PreparedMotion prepare_motion(const std::string& name, std::vector<double> time, std::vector<double> values,
                              const PrepareOptions& options) {
  hydro::require(time.size() == values.size() && time.size() >= 3, "{} has {} samples, time {}: three are needed", name,
                 values.size(), time.size());
  hydro::require(options.filters.empty() && !straightened(options) && options.resample_hz == 0 &&
                     options.delay_s == 0 && options.window.kind != WindowChoice::Kind::full_cycles,
                 "a motion alone is not filtered, straightened, moved in time or cut into cycles");
  Work w;
  w.run.time = std::move(time);
  w.run.position = std::move(values);
  w.run.position_name = name;
  RecordColumns record = record_of(w);
  evened_and_cleaned(record, options);
  cut_window(w, options.window, false);
  return {w.step, std::move(w.run.time), std::move(w.run.position), std::move(w.log.steps), std::move(w.log.cautions)};
}

PreparedTow prepare_towing(RawTow run, const PrepareOptions& options) {
  hydro::require(
      options.delay_s == 0 && !options.average_cycles && options.window.kind != WindowChoice::Kind::full_cycles,
      "a record of towing is not moved in time or cut into cycles");
  hydro::require(!straightened(options),
                 "what a force does on average is sought in a record of towing, which neither a trend nor a band-pass "
                 "leaves");
  hydro::require(!run.force.empty(), "a run needs a force");
  RawRun raw{.time = std::move(run.time),
             .force = std::move(run.force),
             .position = std::move(run.speed),
             .position_name = "speed",
             .velocity = {},
             .acceleration = {}};
  Work w = begun(std::move(raw));
  check_columns(w.run);
  force_on_grid(w, options, &w.run.position);
  double reach_s = 0;
  for (const FilterChoice& choice : options.filters) {
    const ZeroPhaseFilter filter = filter_of(choice, w.step);
    reach_s += static_cast<double>(filter.settling()) * w.step;
    std::vector<double> sum = filter.apply(w.out.record.force);
    std::vector<std::vector<double>> single;
    for (const ForceChannel& f : w.run.force) single.push_back(filter.apply(f.values));
    w.cut(filter.settling(), sum.size());
    w.out.record.force = std::move(sum);
    for (std::size_t i = 0; i < single.size(); ++i) w.run.force[i].values = std::move(single[i]);
    w.log.steps.push_back(told(filter, filter.name() + " over the force", w.step));
  }
  return {.step = w.step,
          .time = std::move(w.run.time),
          .speed = std::move(w.run.position),
          .force = std::move(w.out.record.force),
          .channels = std::move(w.run.force),
          .zero_errors = std::move(w.zero_errors),
          .filter_reach_s = reach_s,
          .steps = std::move(w.log.steps),
          .cautions = std::move(w.log.cautions)};
}

}  // namespace fit
