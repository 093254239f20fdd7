#include "answers/scene_runs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "answers/camera_track.hpp"
#include "answers/fit_measurements.hpp"
#include "compile/integrator.hpp"
#include "compile/radiation.hpp"
#include "compile/sections.hpp"
#include "dynamics/integrate/newton_integrator.hpp"
#include "fit/sensor.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/signal/welch.hpp"
#include "scene/placed.hpp"

namespace froude {

namespace dim = hydro::dim;
using hydro::InputError;

/// In steps: a sample measured so near to a sample of the run is at it.
constexpr double on_sample = 1e-9;

Eigen::Index MeasuredRun::rows(std::size_t window) const {
  return (window + 1 < first.size() ? first[window + 1] : values.rows()) - first[window];
}

MeasuredRun MeasuredRun::of(std::vector<double> time, Eigen::MatrixXd values, double window_s) {
  MeasuredRun out{std::move(time), std::move(values), 0, 0, {}};
  out.step = hydro::signal::even_step(out.time);
  const double before = out.time.front() / out.step;
  out.before = std::lround(before);
  hydro::require(out.before >= 0 && std::abs(before - std::round(before)) < 0.02,
                 "the record begins at {:.6g} s, which is no whole number of its steps of {:.6g} s after the run's "
                 "start at 0",
                 out.time.front(), out.step);
  const Eigen::Index length = window_s > 0 ? std::lround(window_s / out.step) : out.values.rows();
  hydro::require(length >= 8, "a window of {} s holds {} samples, 8 are needed", window_s, length);
  for (Eigen::Index at = 0; at == 0 || at + length <= out.values.rows(); at += length) out.first.push_back(at);
  return out;
}

namespace {

/// Of samples that are even but for gaps: how many of their distances each comes after the first. Empty: they are
/// uneven.
std::vector<double> whole_periods(const std::vector<double>& time, double& period) {
  std::vector<double> out{0};
  for (std::size_t i = 1; i < time.size(); ++i)
    out.push_back(out.back() + std::max(1.0, std::round((time[i] - time[i - 1]) / period)));
  period = (time.back() - time.front()) / out.back();
  for (std::size_t i = 0; i < time.size(); ++i)
    if (std::abs(time[i] - time.front() - out[i] * period) > 0.02 * period) return {};  // as hydro::signal::even_step()
  return out;
}

}  // namespace

MeasuredRun MeasuredRun::of_uneven(std::vector<double> time, Eigen::MatrixXd values, double window_s) {
  hydro::require(time.size() >= 8, "there are {} samples in the time that is fitted, 8 are needed", time.size());
  std::vector<double> between;
  for (std::size_t i = 1; i < time.size(); ++i) between.push_back(time[i] - time[i - 1]);
  std::nth_element(between.begin(), between.begin() + std::ssize(between) / 2, between.end());
  double period = between[between.size() / 2];
  std::vector<double> at = whole_periods(time, period);
  if (at.empty()) {
    period = between[between.size() / 2];
    for (const double t : time) at.push_back((t - time.front()) / period);
  }
  // The run begins at 0, the first sample may come a part of a period after.
  for (double& one : at) one += time.front() / period;
  MeasuredRun out{std::move(time), std::move(values), period, 0, {}, std::move(at)};
  const double last = out.at.back();
  const auto length = static_cast<Eigen::Index>(window_s > 0 ? std::lround(window_s / period) : std::lround(last) + 1);
  hydro::require(length >= 8, "a window of {} s holds {} samples, 8 are needed", window_s, length);
  for (Eigen::Index k = 0; k == 0 || static_cast<double>(k + length) <= last + 1; k += length) {
    const auto row = std::lower_bound(out.at.begin(), out.at.end(), static_cast<double>(k) - 1e-9) - out.at.begin();
    if (!out.first.empty() && row - out.first.back() < 8)
      throw InputError(fmt::format("the window from {:.6g} s on has {} samples, 8 are needed",
                                   out.time[static_cast<std::size_t>(out.first.back())], row - out.first.back()),
                       {},
                       "take longer windows, or the parts before and after the gap as two [[data.record]]s of one "
                       "file, each with its start and end");
    out.first.push_back(row);
    out.begin.push_back(k);
  }
  return out;
}

Eigen::Index MeasuredRun::run_samples(std::size_t window) const {
  if (at.empty()) return rows(window);
  const auto from = at.begin() + first[window], to = from + rows(window);
  const bool between = std::any_of(from, to, [](double x) { return std::abs(x - std::round(x)) >= on_sample; });
  const Eigen::Index around = between ? 3 : 0;  // a polynomial of degree 5 takes as many on either side
  return static_cast<Eigen::Index>(std::ceil(*(to - 1) - on_sample)) - begin[window] + 1 + around;
}

Eigen::Index MeasuredRun::run_length(std::size_t window) const {
  return begin.empty() ? rows(window) : begin[window + 1] - begin[window];
}

Eigen::VectorXd MeasuredRun::told(std::size_t window, const std::vector<double>& run) const {  // (F102)
  Eigen::VectorXd out(rows(window));
  constexpr int points = 6;
  const auto last = static_cast<double>(std::ssize(run) - points);
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const double x = at[static_cast<std::size_t>(first[window] + i)] - static_cast<double>(begin[window]);
    if (std::abs(x - std::round(x)) < on_sample) {
      out[i] = run[static_cast<std::size_t>(std::lround(x))];
      continue;
    }
    const double from = std::clamp(std::floor(x) - 2, 0.0, last);
    double sum = 0;
    for (int j = 0; j < points; ++j) {
      double weight = 1;
      for (int k = 0; k < points; ++k)
        if (k != j) weight *= (x - from - k) / (j - k);
      sum += weight * run[static_cast<std::size_t>(from) + static_cast<std::size_t>(j)];
    }
    out[i] = sum;
  }
  return out;
}

namespace {

/// Where the samples can be the run's own.
bool on_the_runs_samples(const std::vector<double>& time) {
  try {
    const double before = time.front() / hydro::signal::even_step(time);
    return std::abs(before - std::round(before)) < 0.02;  // as of()
  } catch (const InputError&) {
    return false;
  }
}

/// \throws hydro::InputError where time does not go on
void require_increasing(const hydro::io::CsvTable& table, const std::string& column) {
  const auto& time = table.column(column, dim::time);
  for (std::size_t i = 1; i < time.size(); ++i)
    if (!(time[i] > time[i - 1]))
      throw InputError("time does not go on from one row to the next", table.place_of(column, i),
                       "put the rows in the order of their times, and take out those that stand twice");
}

/// A run that goes on for longer before the record than beside it is one that somebody else's clock made: each step of
/// a search would follow it, and mostly where nothing was measured. Who means it says so, by a start that the file's
/// own time has.
void require_seen(const MeasuredRun& run, std::optional<double> start, const hydro::Place& at) {
  const double unseen = run.time.front(), seen = run.time.back() - unseen;
  if (unseen <= seen || (start && *start >= 0)) return;
  const double first = start.value_or(0) + unseen;
  throw InputError(
      fmt::format(
          "the run begins at {:.6g} s and the first row comes at {:.6g} s: {:.4g} s of it are before a record of "
          "{:.4g} s",
          start.value_or(0), first, unseen, seen),
      at,
      fmt::format("write start = \"{:.6g} s\" in its [[data.record]] if the run begins with the record; {}", first,
                  start
                      ? "if it began so early, let the file's times count from there, and leave start out or write 0 s"
                      : "if it began so early, write start = \"0 s\""));
}

}  // namespace

MeasuredRun MeasuredRun::read(const scene::FitScene& fit, const scene::MotionModel& model,
                              const scene::MotionModel::Record& record) {
  if (model.camera) {
    const ::fit::camera::Track track = track_in_plane(fit, model, record).places;
    return scene::placed({.file = record.file.value.string()}, [&] {
      auto channels = ::fit::camera::channels_of(track, channels_asked(model, model.camera_of(record)));
      MeasuredRun out = of_uneven(track.time, std::move(channels.values), model.window);
      out.whitening = std::move(channels.whitening);
      out.deviations = std::move(channels.deviations);
      const auto& camera = model.camera_of(record);
      require_seen(out, record.start ? record.start : camera.from, record.start ? record.start_place : camera.place);
      return out;
    });
  }
  const scene::Measurements measured(fit, record.file.value);
  const hydro::io::CsvTable& table = measured.table;
  const std::string& clock = fit.channels.at("time");
  require_increasing(table, clock);
  const auto& all = table.column(clock, dim::time);
  // A time that was rounded may come a little before the start that a scene writes.
  const double start = record.start.value_or(0), rounding = 1e-9 * std::max(1.0, std::abs(start));
  const auto from = std::lower_bound(all.begin(), all.end(), start - rounding),
             to = record.end ? std::upper_bound(from, all.end(), *record.end + rounding) : all.end();
  const auto skipped = from - all.begin();
  std::vector<double> time(from, to);
  for (double& t : time) t -= start;
  Eigen::MatrixXd values(std::ssize(time), std::ssize(model.signals));
  for (std::size_t c = 0; c < model.signals.size(); ++c) {
    const std::string& name = model.signals[c].column;
    const std::vector<double> column = measured.column(name);
    // Without anything to follow a search goes on until its steps are used up.
    scene::placed(table.place_of(name, table.rows()),
                  [&] { ::fit::require_signal(fmt::format("\"{}\"", name), column); });
    values.col(static_cast<Eigen::Index>(c)) =
        Eigen::Map<const Eigen::VectorXd>(column.data() + skipped, std::ssize(time));
  }
  return scene::placed({.file = record.file.value.string()}, [&] {
    MeasuredRun out = time.size() >= 8 && on_the_runs_samples(time)
                          ? of(std::move(time), std::move(values), model.window)
                          : of_uneven(std::move(time), std::move(values), model.window);
    require_seen(out, record.start, record.start ? record.start_place : record.file.place);
    return out;
  });
}

void share_deviations(const std::vector<MeasuredRun*>& films) {  // (V12)
  Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(std::ssize(films.front()->deviations));
  double frames = 0;
  for (const MeasuredRun* film : films) {
    const auto own = static_cast<double>(film->values.rows());
    squares += own * Eigen::Map<const Eigen::ArrayXd>(film->deviations.data(), squares.size()).square();
    frames += own;
  }
  const Eigen::ArrayXd shared = (squares / frames).sqrt();
  for (MeasuredRun* film : films) {
    Eigen::Map<Eigen::ArrayXd> own(film->deviations.data(), shared.size());
    const Eigen::VectorXd larger = shared / own;
    for (Eigen::MatrixXd& whitening : film->whitening) whitening = whitening * larger.asDiagonal();
    own = shared;
  }
}

const scene::MotionModel::Record& SceneRuns::as_the_model_says() {
  static const scene::MotionModel::Record record;
  return record;
}

SceneRuns::SceneRuns(const scene::MotionModel& model, const MeasuredRun& measured,
                     const scene::MotionModel::Record& record, std::shared_ptr<compile::Kept> kept)
    : asked_(model),
      measured_(measured),
      record_(record),
      source_(hydro::io::read_text(scene_file().value), scene_file().value) {
  prepared_.kept = std::move(kept);
  compiled({});
  if (model.window > 0) begin_windows();
}

Eigen::Index SceneRuns::coordinates(std::size_t window) {
  return charts_.empty() ? 0 : charts_.at(window).coordinates();
}

Eigen::MatrixXd SceneRuns::follow(std::size_t window, const Eigen::VectorXd& parameters, const Eigen::VectorXd& start) {
  compiled(parameters);
  const bool whole = charts_.empty();
  if (!whole) compile::start_from(charts_.at(window).at(*model_, start), *model_);
  const Eigen::Index skipped = whole ? measured_.before : 0, rows = measured_.rows(window);
  const Run record = run(skipped + measured_.run_samples(window) - 1, nullptr);
  Eigen::MatrixXd out(rows, std::ssize(asked_.signals));
  for (std::size_t c = 0; c < asked_.signals.size(); ++c) {
    const auto& values = record.signal(asked_.signals[c].of);
    auto column = out.col(static_cast<Eigen::Index>(c));
    if (measured_.at.empty())
      column = Eigen::Map<const Eigen::VectorXd>(values.data() + skipped, rows);
    else
      column = measured_.told(window, values);
  }
  return out;
}

void SceneRuns::hand_on(std::size_t window, const Eigen::VectorXd& parameters, const Eigen::VectorXd& start) {
  hydro::ensure(charts_.size() > window, "windows are handed on in their order");
  while (charts_.size() > window + 1) charts_.pop_back();  // of an earlier search
  compiled(parameters);
  compile::start_from(charts_.back().at(*model_, start), *model_);
  compile::MovingState end;
  run(measured_.run_length(window), &end);
  charts_.emplace_back(*model_, std::move(end));
}

std::vector<std::string> SceneRuns::units() {
  const Run record = run(0, nullptr);
  std::vector<std::string> out;
  for (const auto& s : asked_.signals) {
    record.signal(s.of);  // a pattern may have let pass what is no name
    for (const Signal& r : record.signals)
      if (r.name == s.of) out.push_back(r.units);
  }
  return out;
}

const scene::Located<std::filesystem::path>& SceneRuns::scene_file() const {
  return record_.scene ? *record_.scene : asked_.scene;
}

/// What is written over the scene's own.
std::vector<scene::OverriddenValue> SceneRuns::numbers(const Eigen::VectorXd& parameters) const {
  std::vector<scene::OverriddenValue> out;
  for (const auto& one : record_.set) out.push_back({one.number.name, one.number.first});
  const std::size_t shared = asked_.parameters.size();
  for (Eigen::Index j = 0; j < parameters.size(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    const auto& q = k < shared ? asked_.parameters[k] : record_.parameters.at(k - shared);
    out.push_back({q.number.name, parameters[j]});
  }
  return out;
}

/// Compiles the scene with these numbers, unless that is what was compiled last. None: as it is written.
void SceneRuns::compiled(const Eigen::VectorXd& parameters) {
  if (model_ && parameters.size() == numbers_.size() && parameters == numbers_) return;
  scene_ = source_.with(numbers(parameters));
  if (!scene_.run)
    throw InputError("the scene to be fitted asks for no run", scene_file().place,
                     "add [ask] run = { duration = \"60 s\", every = \"0.05 s\" } to it");
  if (scene_.run->steady)
    throw InputError("a steady run has no start and no decay", scene_file().place,
                     "take start = \"steady\" out of its [ask] run");
  // The record says how often and how long; what the scene asks for does not matter here.
  scene_.run->every = measured_.step;
  scene_.run->duration =
      measured_.at.empty()
          ? measured_.step * static_cast<double>(measured_.before + std::ssize(measured_.time) - 1)
          : measured_.step *
                static_cast<double>(measured_.begin.back() + measured_.run_samples(measured_.begin.size() - 1) - 1);
  // The scene's step, or the next smaller one that divides the distance of samples, which a file may have rounded.
  if (auto& step = scene_.solve.step)
    step->value = measured_.step / std::max(1.0, std::ceil(measured_.step / step->value - 1e-3));
  else if (chosen_step_)
    step = {*chosen_step_, {}};
  divide(scene_.solve);
  // Derivatives are differences of runs.
  scene_.solve.newton_tolerance = dynamics::NewtonIntegrator::least_residual_tolerance;
  scene_.run->of.clear();
  scene_.run->of_places.clear();
  for (const auto& s : asked_.signals) {
    scene_.run->of.push_back(s.of);
    scene_.run->of_places.push_back(s.deviation.place);
  }
  compile::require_no_sections(scene_);
  prepared_ = compile::prepare(scene_, prepared_.kept);
  for (std::size_t i = 0; i < memory_methods_.size(); ++i) prepared_.memory[i].method = memory_methods_[i];
  model_.emplace(compile::time_model(scene_, prepared_));
  if (!chosen_step_) chosen_step_ = model_->step;
  numbers_ = parameters;
}

/// (F117) Where a tolerance makes the steps, it falls by as much as companions of a run have it.
void SceneRuns::divide(scene::Solve& solve) const {
  if (divided_ == 1) return;
  const double levels = std::log2(divided_);
  if (solve.step) solve.step->value /= divided_;
  if (compile::has_steps_by_tolerance(solve))
    solve.tolerance = solve.tolerance.value_or(compile::tolerance_of_pair) * std::pow(10, -levels);
  solve.line_tolerance = scene::line_tolerance(scene_) * std::pow(4, -levels);
}

bool SceneRuns::divide_steps(int by) {
  if (by == divided_) return true;
  if (memory_methods_.empty()) {
    compile::hold_memories(prepared_, model_->step);
    for (const auto& memory : prepared_.memory) memory_methods_.push_back(memory.method);
  }
  divided_ = by;
  model_.reset();
  return true;
}

bool SceneRuns::own_steps() const {
  const scene::Solve solve = source_.with({}).solve;
  return compile::has_steps_by_tolerance(solve) ? !solve.tolerance : !solve.step;
}

Run SceneRuns::run(Eigen::Index samples, compile::MovingState* end) {
  model_->steps = static_cast<std::size_t>(samples) * model_->steps_per_sample;
  Run record = run_model(scene_, *model_, {}, end);
  if (!record.stopped.empty()) throw hydro::NumericsError(record.stopped);
  return record;
}

void SceneRuns::begin_windows() {
  if (const std::string kind = compile::kept_memory(*model_); !kind.empty())
    throw InputError(
        fmt::format("a window cannot begin in the middle of this scene: {} has a memory of what was before", kind),
        asked_.place, "leave out `window`, and fit a record that begins with the run");
  compile::MovingState begin = compile::start_of(*model_);
  if (measured_.before > 0) run(measured_.before, &begin);
  charts_.emplace_back(*model_, std::move(begin));
}

}  // namespace froude
