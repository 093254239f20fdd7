/// \file  Fits of kind "motion": numbers of a scene of motion, by running it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "answers/fit_kind.hpp"
#include "answers/fit_measurements.hpp"
#include "answers/fit_models.hpp"
#include "answers/fit_motion_records.hpp"
#include "answers/fit_motion_values.hpp"
#include "answers/scene_runs.hpp"
#include "fit/problem/motion.hpp"
#include "fit/several_records.hpp"
#include "hydro/io/csv.hpp"
#include "scene/placed.hpp"

namespace froude::scene {
namespace {

namespace dim = hydro::dim;
namespace fs = std::filesystem;
using hydro::InputError;

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

/// All records, and what follows them as one simulation.
struct FollowedRecords {
  /// The runs of a scene with the record that they follow.
  struct One {
    MeasuredRun measured;
    SceneRuns runs;

    One(const FitScene& scene, const MotionModel& model, const MotionModel::Record& record,
        std::shared_ptr<compile::Kept> kept)
        : measured(MeasuredRun::read(scene, model, record)), runs(model, measured, record, std::move(kept)) {}
  };
  std::vector<std::unique_ptr<One>> all;
  std::optional<::fit::SeveralRecords> simulation;

  FollowedRecords(const FitScene& scene, const MotionModel& model) {
    std::vector<::fit::SeveralRecords::Record> simulated;
    const auto shared = std::ssize(model.parameters);
    auto own = shared;  // those of records come after those that all share
    for (const auto& record : model.records) {
      all.push_back(std::make_unique<One>(scene, model, record, all.empty() ? nullptr : all[0]->runs.kept()));
      std::vector<Eigen::Index> takes(static_cast<std::size_t>(shared));
      std::iota(takes.begin(), takes.end(), 0);
      for (std::size_t k = 0; k < record.parameters.size(); ++k) takes.push_back(own++);
      simulated.push_back({&all.back()->runs, all.back()->measured.first.size(), std::move(takes)});
    }
    simulation.emplace(std::move(simulated));
    if (!model.camera) return;
    std::vector<MeasuredRun*> films;
    for (const auto& one : all) films.push_back(&one->measured);
    share_deviations(films);
  }

  /// True if no record's scene gives its steps.
  bool own_steps() const {
    return std::all_of(all.begin(), all.end(), [](const auto& one) { return one->runs.own_steps(); });
  }
};

/// The deviation of a signal's noise, SI, and the dimension of its column against that of the run.
double deviation_of(const MotionModel::Signal& s, const std::string& unit, const Measurements& measured) {
  const hydro::Dimension needed = hydro::parse_unit(unit).dimension;
  measured.column(s.column, needed);  // refuses a column of another dimension
  return placed(s.deviation.place, [&] {
    const double out = hydro::parse_si(s.deviation.value, needed);
    hydro::require(out > 0, "the deviation of \"{}\" must be positive, got {}", s.of, out);
    return out;
  });
}

/// Signals of films, whose angles and places must be what the run's signals are.
void add_signals_of_films(const MotionModel& model, const std::vector<double>& deviations,
                          const std::vector<std::string>& units, ::fit::motion::Problem& out) {
  for (std::size_t c = 0; c < units.size(); ++c) {
    const MotionModel::Signal& s = model.signals[c];
    const char* needed = s.marker.empty() ? "rad" : "m";
    if (units[c] != needed)
      throw hydro::InputError(
          fmt::format("\"{}\" is in {}; {} of a film is in {}", s.of, units[c].empty() ? "1" : units[c],
                      s.marker.empty() ? "the angle of a line" : "a coordinate", needed),
          s.deviation.place, "name a signal of the run that is what the film shows");
    // A film tells the angle of a line up to whole turns.
    out.signals.push_back({s.of, units[c], deviations[c], s.marker.empty() ? 2 * std::numbers::pi : 0});
  }
}

/// A column of some windows, one after the other; empty where there are none.
std::vector<double> joined(const std::vector<Eigen::MatrixXd>& windows, std::size_t first, std::size_t count,
                           std::size_t column) {
  std::vector<double> out;
  for (std::size_t w = first; w < std::min(windows.size(), first + count); ++w) {
    const auto own = windows[w].col(static_cast<Eigen::Index>(column));
    out.insert(out.end(), own.begin(), own.end());
  }
  return out;
}

Binding<MotionModel> motion_keys() {
  return Binding<MotionModel>(
             "", "numbers of a scene of motion, by running it: what its run tells against what was measured")
      .key(text("scene", "the scene of motion, relative to this one"), &MotionModel::scene)
      .key(inner_tables("parameter", model_parameter()).optional())
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
      .optional()
      .tables("record", motion_record(), &MotionModel::records)
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
  for (const auto& record : motion.records)
    if (record.camera && !motion.camera)
      throw InputError("the record has a camera, and the scene has none", record.camera->place,
                       "add [camera], which says that files are tracks: a record's own stands in its place");
  const bool timed = scene.channels.count("time") > 0;
  if (!motion.camera) {
    if (!timed)
      throw t.channels().refused("needs \"time\" for a fit of kind \"motion\"", "add time = \"name of a column\"");
    if (!motion.columns.empty() || t.data().has("units"))
      throw t.data().refused("has columns or units of a track, and the scene has no [camera]", "add [camera]");
    return;
  }
  for (const auto& record : motion.records)
    if (timed == (motion.camera_of(record).frame_rate > 0))
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

/// Windows of a record with their weights, its source, and the parameters that are its own.
void add_record(const MotionModel::Record& record, const FollowedRecords::One& one, ::fit::motion::Problem& out) {
  const MeasuredRun& measured = one.measured;
  for (std::size_t w = 0; w < measured.first.size(); ++w)
    out.measured.emplace_back(measured.values.middleRows(measured.first[w], measured.rows(w)));
  for (std::size_t w = 0; w < measured.first.size() && !measured.whitening.empty(); ++w) {
    const auto from = measured.whitening.begin() + measured.first[w];
    out.whitening.emplace_back(from, from + measured.rows(w));
  }
  out.records.push_back({.source = {record.file.value},
                         .time = measured.time,
                         .windows = measured.first.size(),
                         .name = record.name == record.file.value.stem() ? std::string() : record.name});
  for (const auto& q : record.parameters) {
    ::fit::SimulationParameter number = q.number;
    number.name += " of " + record.name;
    out.parameters.push_back({std::move(number), q.unit, record.name, q.number.name});
  }
}

/// Two panels for each signal of each record: what was measured with what a run tells, and what is left.
Panels panels_of_records(const ::fit::motion::Problem& problem, const std::vector<Eigen::MatrixXd>& motion,
                         const std::vector<Eigen::MatrixXd>& sample_band, const std::vector<Eigen::MatrixXd>& fit_band,
                         const char* told) {
  Panels out;
  std::size_t first = 0;
  for (const auto& record : problem.records) {
    for (std::size_t c = 0; c < problem.signals.size(); ++c) {
      const auto& signal = problem.signals[c];
      const auto all_of = [&](const auto& windows) { return joined(windows, first, record.windows, c); };
      const std::string legend = problem.records.size() > 1 ? record.title() : "measured";
      Panels both = panels_of(FittedRecord{.legend = legend,
                                           .axis = {signal.name, signal.unit},
                                           .confidence = problem.options.confidence,
                                           .time = record.time,
                                           .measured = all_of(problem.measured),
                                           .fitted = all_of(motion),
                                           .sample_band = all_of(sample_band),
                                           .fit_band = all_of(fit_band)});
      both[0].series[1].name = told;
      both[1].series[0].name = fmt::format("measured − {}", told);
      both[1].series[0].line = false;  // windows begin anew: what is left has jumps between them
      both[1].series[0].marks = true;
      out.insert(out.end(), both.begin(), both.end());
    }
    first += record.windows;
  }
  return out;
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
  FitAnswer predict(const FitScene& scene, const std::optional<fs::path>& fitted) const override {
    const auto& model = scene.model<MotionModel>();
    if (model.window > 0)
      throw InputError("a prediction is one run from the scene's start, and [model] has a window", scene.model_place,
                       "leave out `window`: the start of each window is what a fit finds");
    const ::fit::motion::Problem given = followed(scene, model);
    const GivenValues values = fitted ? values_of_fit(given, *fitted) : first_values(given);
    ::fit::motion::Prediction out = ::fit::motion::predict(given, values.at, values.from);
    return {.report = std::move(out.report),
            .panels = panels_of_records(given, out.motion, {}, {}, "predicted"),
            .table = {},
            .remedy = {}};
  }

 private:
  void finish(const FitTables& t, const FitScene& scene, MotionModel& motion) const override {
    read_records(t, scene, motion);
    check_track(t, scene, motion);
    motion.data_place = t.data().place();
    if (motion.profile && motion.starts.value_or(1) > 1 && motion.window > 0)
      throw t.ask().wrong("profile", "cannot be had with several starts of a search in windows",
                          "give each parameter the first value that was found, and leave out [model] starts");
  }

  /// What a track or a prediction does without is missed here, where something is to be fitted.
  ::fit::motion::Problem problem(const FitScene& scene, const MotionModel& model) const override {
    const bool none = std::all_of(model.records.begin(), model.records.end(),
                                  [](const auto& record) { return record.parameters.empty(); });
    if (model.parameters.empty() && none)
      throw InputError("[model] of kind \"motion\" needs a number to fit", scene.model_place,
                       "add a [[model.parameter]] with its key");
    return followed(scene, model);
  }

  /// The scene's runs beside what was measured. \throws hydro::InputError where nothing was
  static ::fit::motion::Problem followed(const FitScene& scene, const MotionModel& model) {
    if (model.signals.empty())
      throw InputError("[data] needs what was measured", model.data_place,
                       "add a [[data.signal]] with its column, the signal of the run, and the deviation of its noise");
    const auto runs = std::make_shared<FollowedRecords>(scene, model);
    ::fit::motion::Problem out{.records = {},
                               .simulation = {runs, &*runs->simulation},
                               .parameters = {},
                               .signals = {},
                               .measured = {},
                               .options = {.confidence = scene.confidence,
                                           .starts = model.starts,
                                           .iterations_reach = model.iterations,
                                           .profile = model.profile,
                                           .accept_residuals = model.accept_residuals,
                                           .own_steps = runs->own_steps()}};
    for (const auto& q : model.parameters) out.parameters.push_back({q.number, q.unit});
    for (std::size_t r = 0; r < model.records.size(); ++r) add_record(model.records[r], *runs->all[r], out);
    const std::vector<std::string> units = runs->all[0]->runs.units();
    if (model.camera) {
      add_signals_of_films(model, runs->all[0]->measured.deviations, units, out);
      return out;
    }
    for (const auto& record : model.records) {
      const Measurements measured(scene, record.file.value);
      out.signals.clear();  // of all records the same: each is looked at for the dimensions of its columns
      for (std::size_t c = 0; c < units.size(); ++c)
        out.signals.push_back({model.signals[c].of, units[c], deviation_of(model.signals[c], units[c], measured), 0,
                               slope_error(scene, model.signals[c].column)});
    }
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
    return panels_of_records(problem, fit.motion, fit.sample_band, fit.fit_band, "fitted");
  }
};

}  // namespace

std::unique_ptr<const FitKind> motion_fit() { return std::make_unique<MotionFits>(); }

}  // namespace froude::scene
