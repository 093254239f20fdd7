/// \file  Fits of kind "motion": numbers of a scene of motion, by running it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "answers/fit_kind.hpp"
#include "answers/fit_measurements.hpp"
#include "answers/fit_models.hpp"
#include "answers/scene_runs.hpp"
#include "fit/problem/motion.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/override.hpp"
#include "scene/placed.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
namespace fs = std::filesystem;
using hydro::InputError;

const Table& model_parameter() {
  static const Table table{
      .title = "[[model.parameter]]",
      .meaning = "motion: a number of the scene that is fitted",
      .keys = {text("key", "its path: \"line.damping.linear\", \"body[1].initial.heave\", \"load.at.x\""),
               text("first", "where the search begins, \"0.001 kg/s\"; left out: what the scene writes").optional(),
               text("lowest", "bound, with its unit").optional(), text("highest", "bound, with its unit").optional()}};
  return table;
}

/// "0.001 kg/s" in the unit that the scene writes at that place.
double in_unit(const Record& record, const char* key, const std::string& unit) {
  const hydro::Unit written = hydro::parse_unit(unit);
  try {
    const hydro::Quantity q = hydro::parse_quantity(record.text(key));
    if (hydro::compatible(q.dimension, written.dimension)) return q.si / written.factor;
  } catch (const InputError& e) {
    throw e.at(record[key].place);
  }
  throw record.wrong(key, fmt::format("has another dimension than the scene's {}", unit.empty() ? "number" : unit),
                     "write it in that unit");
}

std::vector<MotionModel::Parameter> read_parameters(const Record& model, const fs::path& scene) {
  const std::string text = hydro::io::read_text(scene);
  std::vector<MotionModel::Parameter> out;
  for (const Record& p : model.tables("parameter")) {
    const auto written = number_at(text, scene, p.text("key"), p["key"].place);
    MotionModel::Parameter q{{p.text("key"), written.value}, written.unit, p.place()};
    for (const auto& other : out)
      if (other.number.name == q.number.name) throw p.wrong("key", "stands twice", "fit each number once");
    const auto take = [&](const char* key, double& value) {
      if (p.has(key)) value = in_unit(p, key, q.unit);
    };
    take("first", q.number.first);
    take("lowest", q.number.lowest);
    take("highest", q.number.highest);
    if (q.number.first < q.number.lowest || q.number.first > q.number.highest)
      throw p.refused(fmt::format("begins at {} {}, outside its bounds", q.number.first, q.unit),
                      "widen them, or give first");
    out.push_back(std::move(q));
  }
  if (out.empty())
    throw model.refused("of kind \"motion\" needs a number to fit", "add a [[model.parameter]] with its key");
  return out;
}

constexpr std::int64_t most_iterations = 100'000;

/// How the parameters are searched for.
void check_search(const Record& model, const MotionModel& motion) {
  if (motion.starts && (*motion.starts < 1 || (*motion.starts > 1 && motion.parameters.size() > 12)))
    throw model.wrong("starts", "must be 1 at least, and 1 for more than 12 parameters",
                      "leave it out: where one start fails, others are tried");
  for (const auto& q : motion.parameters)
    if (motion.starts.value_or(1) > 1 && !std::isfinite(q.number.highest - q.number.lowest))
      throw InputError(
          fmt::format("[[model.parameter]] {} has no bounds between which a search could start", q.number.name),
          q.place, "give lowest and highest, or leave out [model] starts");
}

/// The runs of a scene with the record that they follow.
struct FollowedRecord {
  const MeasuredRun measured;
  SceneRuns runs;

  FollowedRecord(const FitScene& scene, const MotionModel& model)
      : measured(MeasuredRun::read(scene, model)), runs(model, measured) {}
};

/// The deviation of a signal's noise, SI, and the dimension of its column against that of the run.
double deviation_of(const MotionModel::Signal& s, const std::string& unit, const hydro::io::CsvTable& table) {
  const hydro::Dimension needed = hydro::parse_unit(unit).dimension;
  table.column(s.column, needed);  // refuses a column of another dimension
  return placed(s.deviation.place, [&] {
    const double out = hydro::parse_si(s.deviation.value, needed);
    hydro::require(out > 0, "the deviation of \"{}\" must be positive, got {}", s.of, out);
    return out;
  });
}

/// Signals and weights of a film, whose angles and places must be what the run's signals are.
void add_film(const MotionModel& model, const MeasuredRun& measured, const std::vector<std::string>& units,
              ::fit::motion::Problem& out) {
  for (std::size_t c = 0; c < units.size(); ++c) {
    const MotionModel::Signal& s = model.signals[c];
    const char* needed = s.marker.empty() ? "rad" : "m";
    if (units[c] != needed)
      throw hydro::InputError(
          fmt::format("\"{}\" is in {}; {} of a film is in {}", s.of, units[c].empty() ? "1" : units[c],
                      s.marker.empty() ? "the angle of a line" : "a coordinate", needed),
          s.deviation.place, "name a signal of the run that is what the film shows");
    // A film tells the angle of a line up to whole turns.
    out.signals.push_back({s.of, units[c], measured.deviations[c], s.marker.empty() ? 2 * std::numbers::pi : 0});
  }
  for (std::size_t w = 0; w < measured.first.size(); ++w) {
    const auto from = measured.whitening.begin() + measured.first[w];
    out.whitening.emplace_back(from, from + measured.rows(w));
  }
}

/// A column of all windows, one after the other.
std::vector<double> joined(const std::vector<Eigen::MatrixXd>& windows, std::size_t column) {
  std::vector<double> out;
  for (const auto& w : windows) {
    const auto own = w.col(static_cast<Eigen::Index>(column));
    out.insert(out.end(), own.begin(), own.end());
  }
  return out;
}

Binding<MotionModel> motion_keys() {
  return Binding<MotionModel>(
             "", "numbers of a scene of motion, by running it: what its run tells against what was measured")
      .key(text("scene", "the scene of motion, relative to this one"), &MotionModel::scene)
      .key(inner_tables("parameter", model_parameter()))
      .optional(
          positive("window", dim::time,
                   "the record is cut into pieces so long, each with a start of its own that is fitted too: for long "
                   "and for chaotic records; left out: one run from the scene's start"),
          &MotionModel::window)
      .optional(
          integer("starts",
                  "the search begins at so many points between the bounds, and the best end is kept; left out: at the "
                  "first values, and where that gives nothing to tell at four points more"),
          &MotionModel::starts)
      .key(integer("iterations", "steps of a search; one that has used them up tells no value")
               .within(Limit::at_least_one)
               .or_default("60", "most need five to twenty"),
           [](const Value& v, MotionModel& motion) {
             if (v.integer > most_iterations)
               throw v.wrong(fmt::format("may be {} at most", most_iterations), "most need five to twenty");
             motion.iterations = static_cast<int>(v.integer);
           })
      .place(&MotionModel::place)
      .then([](const Record& model, MotionModel& motion) {
        std::error_code unknown;
        if (!fs::is_regular_file(motion.scene.value, unknown))
          throw model.wrong("scene", "is no file", fmt::format("looked for {}", motion.scene.value.string()));
        motion.parameters = read_parameters(model, motion.scene.value);
        check_search(model, motion);
      });
}

void check_signal(const Record& record, MotionModel::Signal& out) {
  if (record.has("column") != record.has("deviation"))
    throw record.has("column")
        ? record.refused("needs the key \"deviation\"", "add deviation = \"0.5 deg\": it weighs the columns")
        : record.wrong("deviation", "does not go with a track", "the track's own covariances weigh it: leave it out");
  if (record.has("between") && out.between.size() != 2)
    throw record.wrong("between", "must name two markers",
                       "the angle is that of the line from the first to the second");
  if (record.has("marker") && !record.has("along"))
    throw record.refused("needs the key \"along\"", "add along = \"x\", \"y\" or \"z\"");
  if (!record.has("deviation")) out.deviation.place = record.place();
}

const Table& track_units() {
  static const Table table{
      .title = "[data.units]",
      .meaning = "of a track whose columns do not say",
      .keys = {text("time", "\"s\", \"ms\"").optional(), text("position", "\"px\", or a length: \"mm\"").optional()}};
  return table;
}

const Binding<MotionModel::Signal>& data_signal() {
  using Signal = MotionModel::Signal;
  static const auto table =
      Binding<Signal>("[[data.signal]]", "a column of the files, and what of a run it should be")
          .optional(text("column", "of the files, with its unit"), &Signal::column)
          .optional(
              texts("between",
                    "two markers of a track: the signal is the angle of the line from the first to the second, "
                    "counted as that signal is: below the horizontal (polar), or about the axis across the picture"),
              &Signal::between)
          .optional(text("marker", "a marker of a track: the signal is one of its coordinates"), &Signal::marker)
          .key(text("of", "signal of the run: \"buoy.heave\", \"dropper.link2.polar\""), &Signal::of)
          .optional(text("deviation",
                         "standard deviation of the noise, \"0.5 deg\": weighs the columns; a track has its own"),
                    &Signal::deviation)
          .optional(text("along", "which coordinate").one_of({"x", "y", "z"}).only_beside("marker"), &Signal::along)
          .optional(quantity("zero", dim::angle, "direction of the line where the signal is zero; left out: 0")
                        .only_beside("between"),
                    &Signal::zero)
          .exactly_one_of({"column", "between", "marker"})
          .then(check_signal);
  return table;
}

Binding<MotionModel> data_of_motions() {
  return Binding<MotionModel>("", "")
      .optional(texts("columns", "of a track: names of all its columns, where the file has none"),
                [](const Value& names, MotionModel& motion) { motion.columns = names.texts; })
      .optional(inner_table("units", track_units()),
                [](const Value& units, MotionModel& motion) {
                  const Record& record = units.records.front();
                  if (record.has("time")) motion.time_unit = record.text("time");
                  if (record.has("position")) motion.position_unit = record.text("position");
                })
      .tables("signal", data_signal(), &MotionModel::signals)
      .optional();
}

/// Signals of tracks need [camera], and all signals come from the same file.
void check_track(const FitTables& t, const FitScene& scene, const MotionModel& motion) {
  for (const auto& s : motion.signals) {
    if (s.column.empty() == motion.camera.has_value()) continue;
    throw InputError(motion.camera
                         ? fmt::format("\"{}\" comes from a column, and with [camera] the files are tracks", s.of)
                         : fmt::format("\"{}\" comes from markers, and the scene has no [camera]", s.of),
                     s.deviation.place,
                     motion.camera ? "name a line (between) or a marker"
                                   : "add [camera] with the scale of the picture and what else is known");
  }
  const bool timed = scene.channels.count("time") > 0;
  if (!motion.camera) {
    if (!timed)
      throw t.channels().refused("needs \"time\" for a fit of kind \"motion\"", "add time = \"name of a column\"");
    if (!motion.columns.empty() || t.data().has("units"))
      throw t.data().refused("has columns or units of a track, and the scene has no [camera]", "add [camera]");
    return;
  }
  if (timed == (motion.camera->frame_rate > 0))
    throw t.data().refused(
        timed ? "names a column of time, and [camera] a frame rate" : "does not say when frames were taken",
        timed ? "leave out one of them"
              : "add channels = { time = \"name of a column\" }, or [camera] frame_rate = \"25 Hz\"");
}

Binding<MotionModel> asked_of_motions() {
  return Binding<MotionModel>("", "")
      .key(accept_key("\"residuals\" larger than the stated deviations allow do not keep values back; intervals are "
                      "then as wide as they make them, and the report says by how much"),
           &MotionModel::accept_residuals)
      .key(effect("profile", "intervals of parameters from the likelihood itself, which need not be symmetric"),
           &MotionModel::profile);
}

class MotionFits final : public FitKindOf<MotionModel, ::fit::motion::Problem> {
 public:
  MotionFits()
      : FitKindOf({.word = "motion",
                   .model = motion_keys(),
                   .channels = {text("time", "time").optional()},
                   .data = data_of_motions(),
                   .ask = asked_of_motions()}) {}
  std::vector<std::pair<std::string, std::string>> settings(const FitScene& scene) const override {
    return {{"of", scene.model<MotionModel>().scene.value.filename().string()}};
  }

 private:
  void finish(const FitTables& t, const FitScene& scene, MotionModel& motion) const override {
    check_track(t, scene, motion);
    if (motion.signals.empty())
      throw t.data().refused(
          "needs what was measured",
          "add a [[data.signal]] with its column, the signal of the run, and the deviation of its noise");
    if (motion.profile && motion.starts.value_or(1) > 1 && motion.window > 0)
      throw t.ask().wrong("profile", "cannot be had with several starts of a search in windows",
                          "give each parameter the first value that was found, and leave out [model] starts");
  }

  ::fit::motion::Problem problem(const FitScene& scene, const MotionModel& model) const override {
    const auto followed = std::make_shared<FollowedRecord>(scene, model);
    const MeasuredRun& measured = followed->measured;
    ::fit::motion::Problem out{.source = {scene.files[0].value},
                               .simulation = {followed, &followed->runs},
                               .parameters = {},
                               .signals = {},
                               .time = measured.time,
                               .measured = {},
                               .options = {.confidence = scene.confidence,
                                           .starts = model.starts,
                                           .iterations_reach = model.iterations,
                                           .profile = model.profile,
                                           .accept_residuals = model.accept_residuals}};
    const std::vector<std::string> units = followed->runs.units();
    for (const auto& q : model.parameters) out.parameters.push_back({q.number, q.unit});
    for (std::size_t w = 0; w < measured.first.size(); ++w)
      out.measured.emplace_back(measured.values.middleRows(measured.first[w], measured.rows(w)));
    if (model.camera) {
      add_film(model, measured, units, out);
      return out;
    }
    const auto table = hydro::io::CsvTable::read(scene.files[0].value);
    for (std::size_t c = 0; c < units.size(); ++c)
      out.signals.push_back({model.signals[c].of, units[c], deviation_of(model.signals[c], units[c], table)});
    return out;
  }

  Remedy remedy(const FitScene& scene, const ::fit::motion::Problem& problem, const Solution& solution) const override {
    using enum ::fit::Refusal::Reason;
    if (!solution.trouble.empty()) return {scene.model_place, "Put that right in [[data.signal]] or in the file"};
    const auto& stated = solution.fit.stated;
    switch (solution.report.refused->reason) {
      case search_without_end:
        return {.text = fmt::format("Begin elsewhere (first of a [[model.parameter]]) or at several points ([model] "
                                    "starts), let it take more steps ([model] iterations, now {}), or change the model",
                                    problem.options.iterations_reach)};
      case residuals_too_large:
        break;
      default:
        return {};
    }
    const auto bad = std::find_if(stated.begin(), stated.end(), [](const auto& s) { return !s.hold(); });
    const auto& signals = scene.model<MotionModel>().signals;
    return {signals[static_cast<std::size_t>(bad - stated.begin())].deviation.place,
            "begin elsewhere (first) or at several points (starts), change the model, or state the deviation that the "
            "noise has; to have values all the same: [ask] accept = [\"residuals\"]"};
  }

  Panels panels(const ::fit::motion::Problem& problem, const Solution& solution) const override {
    const ::fit::SimulationFit& fit = solution.fit;
    Panels out;
    for (std::size_t c = 0; c < problem.signals.size(); ++c) {
      const auto& [name, unit, deviation, period] = problem.signals[c];
      Panels both = panels_of(FittedRecord{.legend = "measured",
                                           .axis = {name, unit},
                                           .confidence = problem.options.confidence,
                                           .time = problem.time,
                                           .measured = joined(problem.measured, c),
                                           .fitted = joined(fit.motion, c),
                                           .sample_band = joined(fit.sample_band, c),
                                           .fit_band = joined(fit.fit_band, c)});
      both[1].series[0].line = false;  // windows begin anew: what is left has jumps between them
      both[1].series[0].marks = true;
      out.insert(out.end(), both.begin(), both.end());
    }
    return out;
  }
};

}  // namespace

std::unique_ptr<const FitKind> motion_fit() { return std::make_unique<MotionFits>(); }

}  // namespace froude::scene
