/// \file  Fits of kind "motion": numbers of a scene of motion, by running it.
#include <cmath>
#include <cstdint>

#include "hydro/io/atomic_file.hpp"
#include "scene/fit_tables.hpp"
#include "scene/override.hpp"

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

}  // namespace

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

namespace {

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

}  // namespace

void finish(const FitTables& t, FitScene& scene, MotionModel& motion) {
  read_channels(t, {"time"}, motion.camera ? std::vector<std::string>{} : std::vector<std::string>{"time"}, scene);
  check_track(t, scene, motion);
  if (motion.signals.empty())
    throw t.data().refused(
        "needs what was measured",
        "add a [[data.signal]] with its column, the signal of the run, and the deviation of its noise");
  if (motion.profile && motion.starts.value_or(1) > 1 && motion.window > 0)
    throw t.ask().wrong("profile", "cannot be had with several starts of a search in windows",
                        "give each parameter the first value that was found, and leave out [model] starts");
}

}  // namespace froude::scene
