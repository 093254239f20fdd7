#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>

#include "hydro/io/atomic_file.hpp"
#include "scene/build.hpp"
#include "scene/fit_scene.hpp"
#include "scene/override.hpp"

namespace froude::scene {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;

const std::vector<std::string> all_channels{
    "time",      "force", "angle",    "velocity", "acceleration",   "position",           "cross_velocity",
    "elevation", "speed", "speed_sd", "force_sd", "water_velocity", "water_acceleration", "torque"};
constexpr double two_pi = 2 * std::numbers::pi;

/// Files that fit one entry of `files`, in alphabetical order. A `*` may stand in the file's name, not in a folder's.
void expand(const Record& data, const Located<std::string>& entry, const fs::path& scene,
            std::vector<Located<fs::path>>& out) {
  const fs::path path = beside(scene, entry.value);
  const std::string pattern = path.filename().string(), folder = path.parent_path().string();
  const auto refuse = [&](const std::string& rule, const std::string& remedy) {
    throw InputError(fmt::format("{} files: \"{}\" {}", data.title(), entry.value, rule), entry.place, remedy);
  };
  if (fs::path(entry.value).parent_path().string().find('*') != std::string::npos)
    refuse("has a * in the name of a folder", "list the folders one by one");
  std::error_code failed;
  std::vector<fs::path> found;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
    std::error_code unknown;
    if (at->is_regular_file(unknown) && matches(pattern, at->path().filename().string())) found.push_back(at->path());
  }
  if (failed) refuse(fmt::format("cannot be looked up: {}", failed.message()), fmt::format("the folder is {}", folder));
  if (found.empty()) refuse("is no file", fmt::format("looked in {}", folder));
  std::sort(found.begin(), found.end());
  for (const fs::path& file : found) out.push_back({file, entry.place});
}

std::vector<Located<fs::path>> read_files(const Record& data, const fs::path& scene) {
  std::vector<Located<fs::path>> out;
  if (!data.has("files")) return out;
  for (const auto& entry : data["files"].texts) expand(data, entry, scene, out);
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  const auto twice =
      std::adjacent_find(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.value == b.value; });
  if (twice != out.end())
    throw InputError(fmt::format("{} files holds {} twice", data.title(), twice->value.string()),
                     std::next(twice)->place, "name each file once, or the fit counts it twice");
  return out;
}

struct Channels {
  std::vector<std::string> known, needed;
};
Channels channels_of(const std::string& kind) {
  if (kind == "towing") return {{"speed", "force", "speed_sd", "force_sd"}, {"speed", "force"}};
  if (kind == "decay") return {{"time", "position", "angle"}, {"time"}};
  if (kind == "motion") return {{"time"}, {"time"}};
  if (kind == "radiation") return {{"time", "position", "angle", "force", "torque"}, {"time"}};
  if (kind == "friction ramp") return {{"time", "torque", "force"}, {"time"}};
  return {{"time", "force", "velocity", "acceleration", "position", "cross_velocity", "elevation", "water_velocity",
           "water_acceleration"},
          {"time", "force"}};
}

/// What only moving water, or only a moving body, has.
void check_water(const Record& channels, const std::string& motion) {
  const auto has = [&](const char* role) { return channels.has(role); };
  const bool both = motion == "both move";
  if (motion == "body moves")
    for (const char* role : {"cross_velocity", "elevation"})
      if (has(role)) throw channels.wrong(role, "has no part where the body moves in still water", "leave it out");
  for (const char* role : {"water_velocity", "water_acceleration"})
    if (has(role) && !both)
      throw channels.wrong(role, fmt::format("has no part with motion = \"{}\"", motion),
                           "leave it out, or set motion = \"both move\"");
  if (!both) return;
  if (has("elevation") == has("water_velocity"))
    throw channels.refused("needs either water_velocity or elevation where both move",
                           "name the column of the water's motion; velocity and position are the body's");
  if (has("elevation"))
    for (const char* other : {"water_acceleration", "cross_velocity"})
      if (has(other)) throw channels.wrong(other, "does not act beside the elevation", "keep one of the two");
}

/// Exactly one of the motion's channels, which others must not contradict.
void check_motion(const Record& channels, const std::string& kind, const std::string& motion) {
  const auto has = [&](const char* role) { return channels.has(role); };
  if (kind == "morison") check_water(channels, motion);
  if (kind == "morison" && has("elevation") && motion != "both move") {
    for (const char* other : {"velocity", "position", "acceleration", "cross_velocity"})
      if (has(other)) throw channels.wrong(other, "does not act beside the elevation", "keep one of the two");
    return;
  }
  if (kind == "morison" && !has("velocity") && !has("position"))
    throw channels.refused("needs velocity or position for a fit of kind \"morison\": drag needs the velocity",
                           "add one of them; an acceleration alone does not give it, its integral drifts");
  if (has("velocity") && has("position"))
    throw channels.wrong("position", "does not act beside the velocity", "keep one of the two");
  if ((kind == "decay" || kind == "radiation") && has("angle") == has("position"))
    throw channels.refused(fmt::format("needs either position or angle for a fit of kind \"{}\"", kind),
                           "name the column of the motion");
  if (kind == "radiation" && (has("position") != has("force") || has("angle") != has("torque")))
    throw channels.refused("needs force beside a position, torque beside an angle", "name what moved the body");
  if (kind == "friction ramp" && has("torque") == has("force"))
    throw channels.refused("needs either torque or force for a fit of kind \"friction ramp\"",
                           "name the torque on a hinge, or the force on a slider");
}

std::map<std::string, std::string> read_channels(const Record& channels, const std::string& kind,
                                                 const std::string& motion) {
  const auto [known, needed] = channels_of(kind);
  std::map<std::string, std::string> out;
  for (const std::string& role : all_channels) {
    if (!channels.has(role)) continue;
    if (std::find(known.begin(), known.end(), role) == known.end())
      throw channels.wrong(role, fmt::format("has no part in a fit of kind \"{}\"", kind),
                           fmt::format("its channels are {}", fmt::join(known, ", ")));
    if (role == "force") continue;  // may be several, see read_force()
    if (channels.text(role).empty()) throw channels.wrong(role, "is empty", "write the name of a column");
    out[role] = channels.text(role);
  }
  for (const std::string& role : needed)
    if (!channels.has(role))
      throw channels.refused(fmt::format("needs \"{}\" for a fit of kind \"{}\"", role, kind),
                             fmt::format("add {} = \"name of a column\"", role));
  check_motion(channels, kind, motion);
  return out;
}

/// The force channels, each with its sign and, where they are given, its calibration.
std::vector<FitScene::ForceChannel> read_force(const Record& data, const std::string& kind, const fs::path& scene) {
  const Record& channels = data.table("channels");
  std::vector<FitScene::ForceChannel> out;
  if (kind != "morison" && kind != "towing" && data.has("calibration"))
    throw data.wrong("calibration", fmt::format("has no part in a fit of kind \"{}\"", kind), "leave it out");
  if (!channels.has("force")) return out;
  for (const auto& name : channels["force"].texts) {
    const bool turned = name.value.starts_with('-');
    const std::string column = turned ? name.value.substr(1) : name.value;
    if (column.empty()) throw channels.wrong("force", "is empty", "write the name of a column");
    for (const auto& other : out)
      if (other.column == column) throw channels.wrong("force", fmt::format("holds \"{}\" twice", column));
    out.push_back({column, turned, {}});
  }
  if (out.empty()) throw channels.wrong("force", "is empty", "write the name of a column");
  if (kind != "morison" && out.size() > 1)
    throw channels.wrong("force", fmt::format("may hold one column only in a fit of kind \"{}\"", kind));
  if (!data.has("calibration")) return out;
  const auto& files = data["calibration"].texts;
  if (kind == "towing") throw data.wrong("calibration", "has no part in a fit of kind \"towing\"");
  if (files.size() != out.size())
    throw data.wrong("calibration", fmt::format("names {} files for {} force channels", files.size(), out.size()),
                     "name one for each, in the order of the channels");
  for (std::size_t i = 0; i < files.size(); ++i) out[i].calibration = {{beside(scene, files[i].value), files[i].place}};
  return out;
}

std::vector<FitScene::Filter> read_filters(const Record& prepare) {
  std::vector<FitScene::Filter> out;
  for (const Record& n : prepare.tables("notch"))
    out.push_back({.kind = "notch", .hz = n.si("centre") / two_pi, .width_hz = n.si("width") / two_pi});
  if (prepare.has("moving_average")) out.push_back({.kind = "moving average", .seconds = prepare.si("moving_average")});
  if (!prepare.has("low_pass")) return out;
  const Record& low = prepare.table("low_pass");
  FitScene::Filter f{.kind = low.text("kind"), .hz = low.si("cutoff") / two_pi};
  if (low.has("order")) {
    f.order = static_cast<int>(low["order"].integer);
    if (f.order < 1 || f.order > 10) throw low.wrong("order", "must lie between 1 and 10");
  }
  out.push_back(f);
  return out;
}

void read_delay(const Record& prepare, FitScene::Prepare& out) {
  if (!prepare.has("delay")) return;
  const bool estimate = prepare.text("delay") == "estimate";
  if (estimate && prepare.has("delay_error"))
    throw prepare.wrong("delay_error", "does not act where the delay is estimated: its error is then estimated too",
                        "leave it out");
  if (!estimate && prepare.has("longest_delay"))
    throw prepare.wrong("longest_delay", "does not act where the delay is given",
                        "leave it out, or set delay = \"estimate\"");
  if (!estimate) out.delay = prepare.si("delay");
  if (prepare.has("delay_error")) out.delay_error = prepare.si("delay_error");
  if (!estimate) return;
  if (!prepare.has("longest_delay"))
    throw prepare.wrong(
        "delay", "needs \"longest_delay\"",
        "add longest_delay = \"1 s\": less than half the main period, which would be the force turned round");
  out.longest_delay = prepare.si("longest_delay");
}

FitScene::Prepare read_prepare(const Record& root, const std::string& kind) {
  FitScene::Prepare out;
  if (!root.has("prepare")) return out;
  const Record& prepare = root.table("prepare");
  if (kind != "morison" && kind != "decay")
    throw prepare.refused(fmt::format("has no part in a fit of kind \"{}\"", kind),
                          "leave it out: its steps are those of a force, or of a decay");
  for (const char* key : {"resample", "delay", "derivative_bandwidth", "derivative_method", "low_pass", "notch",
                          "moving_average", "mean_cycle"})
    if (kind == "decay" && prepare.has(key) && !prepare[key].defaulted)
      throw prepare.wrong(key, "has no part in a fit of kind \"decay\"",
                          "leave it out: what is fitted is the motion as it was recorded");
  if (prepare.has("longest_gap")) out.longest_gap = prepare.si("longest_gap");
  if (prepare.has("outliers")) {
    out.outlier_window = prepare.table("outliers").si("window");
    out.outlier_deviations = prepare.table("outliers").si("deviations");
    if (out.outlier_deviations < 3)
      throw prepare.table("outliers").wrong("deviations", "must be 3 at least: noise itself comes so far");
  }
  if (prepare.has("resample")) out.resample_hz = prepare.si("resample") / two_pi;
  read_delay(prepare, out);
  if (prepare.has("derivative_bandwidth")) out.derivative_bandwidth = prepare.si("derivative_bandwidth") / two_pi;
  out.derivative_method = prepare.text("derivative_method");
  out.filters = read_filters(prepare);
  out.mean_cycle = prepare.has("mean_cycle");
  if (out.mean_cycle && !(prepare.has("window") && prepare.table("window").text("kind") == "full cycles"))
    throw prepare.wrong("mean_cycle", "needs cycles", "set window = { kind = \"full cycles\" }");
  if (!prepare.has("window")) return out;
  const Record& window = prepare.table("window");
  out.window = window.text("kind");
  if (kind == "decay" && out.window != "span")
    throw window.wrong("kind", "must be \"span\" for a decay, which has no cycles of full amplitude");
  if (window.has("last") && window["last"].integer < 1) throw window.wrong("last", "must be 1 at least");
  if (window.has("last")) out.cycles = static_cast<int>(window["last"].integer);
  if (window.has("tolerance")) out.tolerance = window.si("tolerance");
  if (window.has("from")) out.from = window.si("from");
  if (window.has("to")) out.to = window.si("to");
  if (window.has("to") && !(out.from < out.to)) throw window.wrong("to", "must be later than from");
  return out;
}

void read_errors(const Record& model, FitScene::Model& out) {
  if (!model.has("uncertainty")) return;
  const Record& e = model.table("uncertainty");
  const auto of = [&](const char* key) { return e.has(key) ? e.si(key) : 0.0; };
  out.diameter_error = of("diameter");
  out.length_error = of("length");
  out.density_error = of("density");
  out.mass_error = of("mass");
  if (out.mass_error > 0 && out.motion == "water moves")
    throw e.wrong("mass", "does not act: the body does not move", "leave it out");
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

FitScene::Motion read_motion(const Record& model, const fs::path& file) {
  FitScene::Motion out;
  out.scene = {beside(file, model.text("scene")), model["scene"].place};
  std::error_code unknown;
  if (!fs::is_regular_file(out.scene.value, unknown))
    throw model.wrong("scene", "is no file", fmt::format("looked for {}", out.scene.value.string()));
  const std::string text = hydro::io::read_text(out.scene.value);
  if (model.has("window")) out.window = model.si("window");
  for (const Record& p : model.tables("parameter")) {
    const auto written = number_at(text, out.scene.value, p.text("key"), p["key"].place);
    FitScene::Motion::Parameter q{.key = p.text("key"),
                                  .unit = written.unit,
                                  .first = written.value,
                                  .lowest = {},
                                  .highest = {},
                                  .place = p.place()};
    for (const auto& other : out.parameters)
      if (other.key == q.key) throw p.wrong("key", "stands twice", "fit each number once");
    if (p.has("first")) q.first = in_unit(p, "first", q.unit);
    if (p.has("lowest")) q.lowest = in_unit(p, "lowest", q.unit);
    if (p.has("highest")) q.highest = in_unit(p, "highest", q.unit);
    if ((q.lowest && q.first < *q.lowest) || (q.highest && q.first > *q.highest))
      throw p.refused(fmt::format("begins at {} {}, outside its bounds", q.first, q.unit), "widen them, or give first");
    out.parameters.push_back(std::move(q));
  }
  if (model.has("starts")) out.starts = static_cast<int>(model["starts"].integer);
  if (model.has("starts") && (out.starts < 2 || out.parameters.size() > 12))
    throw model.wrong("starts", "must be 2 at least, for 12 parameters at most", "leave it out for one start");
  constexpr std::int64_t most_iterations = 100'000;
  if (model["iterations"].integer > most_iterations)
    throw model.wrong("iterations", fmt::format("may be {} at most", most_iterations), "most need five to twenty");
  out.iterations = static_cast<int>(model["iterations"].integer);
  for (const auto& q : out.parameters)
    if (out.starts > 1 && !(q.lowest && q.highest))
      throw InputError(fmt::format("[[model.parameter]] {} has no bounds between which a search could start", q.key),
                       q.place, "give lowest and highest, or leave out [model] starts");
  if (out.parameters.empty())
    throw model.refused("of kind \"motion\" needs a number to fit", "add a [[model.parameter]] with its key");
  return out;
}

std::vector<FitScene::Motion::Signal> read_signals(const Record& data, const std::string& kind) {
  std::vector<FitScene::Motion::Signal> out;
  for (const Record& s : data.tables("signal"))
    out.push_back({s.text("column"), s.text("of"), {s.text("deviation"), s["deviation"].place}});
  if (kind == "motion" && out.empty())
    throw data.refused("needs what was measured",
                       "add a [[data.signal]] with its column, the signal of the run, and the deviation of its noise");
  if (kind != "motion" && !out.empty())
    throw data.wrong("signal", fmt::format("has no part in a fit of kind \"{}\"", kind),
                     "name [data.channels] instead");
  return out;
}

/// Mass and stiffness of a translation, or inertia and rotational stiffness of a turn, as the channels have it.
std::optional<FitScene::Model::Body> read_body(const Record& model, bool turns) {
  if (!model.has("body")) return {};
  const Record& body = model.table("body");
  for (const char* other : turns ? std::array{"mass", "stiffness"} : std::array{"inertia", "rotational_stiffness"})
    if (body.has(other))
      throw body.wrong(other, fmt::format("does not go with the channel {}", turns ? "angle" : "position"),
                       turns ? "give inertia and rotational_stiffness" : "give mass and stiffness");
  const auto of = [&](const char* key) { return body.has(key) ? body.si(key) : 0.0; };
  return FitScene::Model::Body{body.si(turns ? "inertia" : "mass"),
                               body.si(turns ? "rotational_stiffness" : "stiffness"), of("mass_error"),
                               of("stiffness_error")};
}

FitScene::Model read_model(const Record& model, const Record& channels) {
  FitScene::Model out{.kind = model.text("kind"), .place = model.place()};
  if (out.kind == "motion") return out;
  if (out.kind == "decay" || out.kind == "radiation") {
    out.sine = out.kind == "decay" && model.text("restoring") == "sine";
    if (out.sine && channels.has("position"))
      throw model.wrong("restoring", "is by the sine of an angle, and the channel position is a length",
                        "name the channel angle, or take restoring = \"linear\"");
    out.starts_empty = out.kind == "decay" && model.has("start") && model.text("start") == "let go from rest";
    out.body = read_body(model, channels.has("angle"));
    if (out.kind == "decay" && out.body && !(out.body->stiffness > 0))
      throw model.table("body").refused("needs a stiffness: without one there is no natural period",
                                        "give what brings the body back");
    return out;
  }
  if (out.kind == "friction ramp") {
    out.ramp = model.si("ramp");
    out.slide = model.si("slide");
    out.drop = model.si("drop");
    return out;
  }
  const Record& water = model.table("water");
  out.diameter = model.si("diameter");
  out.length = model.si("length");
  out.density = water.si("density");
  if (water.has("viscosity")) out.viscosity = water.si("viscosity");
  if (out.kind != "morison") return out;
  out.motion = model.text("motion");
  const bool given = model.has("mass_beyond_load_cells"), moves = out.motion != "water moves";
  if (given && !moves)
    throw model.wrong("mass_beyond_load_cells", "does not act: the body does not move",
                      "leave it out, or set motion = \"body moves\"");
  if (!given && moves)
    throw model.refused(
        "needs \"mass_beyond_load_cells\" where the body moves: its inertia is part of the measured force",
        "add mass_beyond_load_cells = \"5.9 kg\", contained water included; \"0 kg\" if it is taken off already");
  if (given) out.mass_beyond_load_cells = model.si("mass_beyond_load_cells");
  out.linear_drag = model.has("linear_drag");
  out.offset = model.has("offset");
  for (const Record& line : model.tables("line"))
    out.lines.push_back({line.has("frequency") ? line.si("frequency") / two_pi : 0.0,
                         line.has("multiple") ? line.si("multiple") : 0.0});
  read_errors(model, out);
  if (!model.has("wave")) return out;
  const Record& wave = model.table("wave");
  FitScene::Model::Wave w{.level = -wave.si("level"),
                          .ahead = wave.si("ahead"),
                          .gravity = wave.si("gravity"),
                          .regular = wave.has("regular"),
                          .follow = wave.has("follow")};
  if (w.follow && !(out.motion == "both move" && channels.has("position")))
    throw wave.wrong("follow", "needs to know where the body is",
                     "set motion = \"both move\" with the channel position, or leave it out");
  if (wave.text("depth").empty()) w.depth = hydro::WaterDepth::from_metres(wave.si("depth"));
  if (!w.depth.is_infinite() && -w.level >= w.depth.metres())
    throw wave.wrong("level", "lies below the bottom", "give the depth of the axis below still water");
  out.wave = w;
  return out;
}

std::vector<std::string> read_coefficients(const Record& ask, const std::string& kind) {
  std::vector<std::string> out;
  if (kind == "motion" || kind == "radiation" || kind == "friction ramp") {
    if (ask.has("coefficients"))
      throw ask.wrong("coefficients", fmt::format("has no part in a fit of kind \"{}\"", kind),
                      kind == "motion" ? "leave it out: what is fitted are the [[model.parameter]]" : "leave it out");
    return out;
  }
  if (!ask.has("coefficients"))
    throw ask.refused("needs the key \"coefficients\"", kind == "decay"
                                                            ? "add coefficients = [\"linear\", \"quadratic\"]"
                                                            : "add coefficients = [\"cd\"]");
  const std::vector<std::string> forces{"cd", "cm", "ca"};
  for (const auto& c : ask["coefficients"].texts) {
    const bool of_force = std::find(forces.begin(), forces.end(), c.value) != forces.end();
    if (of_force == (kind == "decay"))
      throw InputError(
          fmt::format("[ask] coefficients: \"{}\" has no part in a fit of kind \"{}\"", c.value, kind), c.place,
          of_force ? "a decay knows linear, quadratic, cubic, coulomb and memory" : "ask for cd, cm or ca");
    if (kind == "towing" && c.value != "cd")
      throw InputError(fmt::format("[ask] coefficients: \"{}\" cannot come from towing at steady speed", c.value),
                       c.place, "ask for \"cd\" alone");
    out.push_back(c.value);
  }
  return out;
}

/// What a decay with a memory, and several decays, may ask for.
void read_decay(const Record& root, FitScene& scene) {
  const Record &model = root.table("model"), &ask = root.table("ask"), &data = root.table("data");
  scene.together = ask.has("together");
  if (scene.model.kind != "decay") {
    if (scene.together)
      throw ask.wrong("together", fmt::format("has no part in a fit of kind \"{}\"", scene.model.kind), "leave it out");
    return;
  }
  if (scene.together && data.has("files") && scene.files.size() < 2)
    throw ask.wrong("together", "needs two files at least", "name more files, or leave it out");
  const auto asks = [&](const char* term) {
    return std::find(scene.coefficients.begin(), scene.coefficients.end(), term) != scene.coefficients.end();
  };
  if (!asks("memory")) {
    if (model.has("start"))
      throw model.wrong("start", "does not act without a memory",
                        "add \"memory\" to [ask] coefficients, or leave it out");
    return;
  }
  if (!model.has("start"))
    throw model.refused("needs \"start\" for a memory: what does the water remember at the first sample?",
                        "add start = \"let go from rest\" if the record begins there, or start = \"in motion\"");
  if (asks("coulomb"))
    throw ask.wrong("coefficients", "may not hold coulomb beside memory: a body at rest would not be at rest for good",
                    "leave one of them out");
  if (scene.model.sine)
    throw model.wrong("restoring", "must be linear with a memory: radiation is known for small motions",
                      "leave it out");
}

/// What concerns several runs, and how a run is looked at.
void read_batch(const Record& root, const fs::path& file, FitScene& scene) {
  const Record &data = root.table("data"), &ask = root.table("ask"), &intervals = ask.table("intervals");
  const auto for_morison = [&](const Record& record, const char* key) {
    if (scene.model.kind != "morison" && record.has(key) && !record[key].defaulted)
      throw record.wrong(key, fmt::format("has no part in a fit of kind \"{}\"", scene.model.kind), "leave it out");
  };
  if (scene.model.kind != "decay") for_morison(data, "runs");
  for (const char* key : {"robust", "cycles", "law"}) for_morison(ask, key);
  if (scene.model.kind != "decay") for_morison(ask, "sensitivity");
  for_morison(intervals, "method");
  if (data.has("runs")) scene.run_table = {{beside(file, data.text("runs")), data["runs"].place}};
  scene.interval_method = intervals.text("method");
  if (ask.has("profile") && scene.model.kind != "decay" && scene.model.kind != "motion")
    throw ask.wrong("profile", fmt::format("has no part in a fit of kind \"{}\"", scene.model.kind),
                    "leave it out: that model is linear, and its intervals are those of the likelihood");
  if (ask.has("profile") && scene.motion.starts > 1 && scene.motion.window > 0)
    throw ask.wrong("profile", "cannot be had with several starts of a search in windows",
                    "give each parameter the first value that was found, and leave out [model] starts");
  if (ask.has("accept") && scene.model.kind != "motion" && scene.model.kind != "towing" && scene.model.kind != "decay")
    throw ask.wrong("accept", fmt::format("has no part in a fit of kind \"{}\"", scene.model.kind),
                    "leave it out: nothing is kept back there for its residuals");
  scene.accept_residuals = ask.has("accept");
  scene.profile = ask.has("profile");
  scene.robust = ask.has("robust");
  scene.cycles = ask.has("cycles");
  scene.sensitivity = ask.has("sensitivity");
  if (ask.has("law")) scene.law = ask.text("law");
  if (scene.cycles && scene.prepare.window != "full cycles")
    throw ask.wrong("cycles", "needs cycles", "set [prepare] window = { kind = \"full cycles\" }");
  if (scene.cycles && scene.prepare.longest_delay)
    throw ask.wrong("cycles", "cannot be had while the delay is being estimated", "give the delay that was estimated");
}

}  // namespace

bool is_fit(const fs::path& file) {
  return parse_document(hydro::io::read_text(file), file.string()).find("model") != nullptr;
}

FitScene parse_fit(std::string_view text, const fs::path& file) {
  const Node document = parse_document(text, file.string());
  check_version(document);
  if (const auto* body = document.find("body"); body != nullptr && document.find("model") == nullptr)
    throw InputError("this scene has a [[body]] and no [model]: it asks for motion, not for a fit", body->place,
                     "use `froude rao` or `froude run`");
  FitScene scene;
  scene.file = file;
  scene.text = text;
  const Record root = read_record(document, fit_schema(), scene.echo);
  if (root.has("title")) scene.title = root.text("title");
  scene.model = read_model(root.table("model"), root.table("data").table("channels"));
  if (scene.model.kind == "motion") scene.motion = read_motion(root.table("model"), file);
  scene.motion.signals = read_signals(root.table("data"), scene.model.kind);
  scene.channels = read_channels(root.table("data").table("channels"), scene.model.kind, scene.model.motion);
  const bool surface = scene.channels.count("elevation") > 0;
  if (surface != scene.model.wave.has_value())
    throw surface ? root.table("model").refused("needs \"wave\" for the channel elevation",
                                                "add wave = { depth = \"1.25 m\", level = \"0.48 m\" }")
                  : root.table("model").wrong("wave", "does not act: there is no channel elevation", "leave it out");
  scene.force = read_force(root.table("data"), scene.model.kind, file);
  if (root.table("data").has("zero")) {
    const Value& zero = root.table("data")["zero"];
    if (scene.model.kind != "morison")
      throw root.table("data").wrong("zero", fmt::format("has no part in a fit of kind \"{}\"", scene.model.kind),
                                     "leave it out");
    scene.zero_run = {{beside(file, zero.text), zero.place}};
  }
  scene.prepare = read_prepare(root, scene.model.kind);
  scene.coefficients = read_coefficients(root.table("ask"), scene.model.kind);
  scene.confidence = root.table("ask").table("intervals").si("level");
  scene.files = read_files(root.table("data"), file);
  read_batch(root, file, scene);
  read_decay(root, scene);
  return scene;
}

FitScene read_fit(const fs::path& file) { return parse_fit(hydro::io::read_text(file), file); }

}  // namespace froude::scene
