#include "scene/fit_models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>

#include "hydro/io/atomic_file.hpp"
#include "scene/build.hpp"
#include "scene/override.hpp"

namespace froude::scene {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;

constexpr FitWord<::fit::Experiment> experiments[] = {{"water moves", ::fit::Experiment::water_moves},
                                                      {"body moves", ::fit::Experiment::body_moves},
                                                      {"both move", ::fit::Experiment::both_move}};
constexpr FitWord<::fit::IntervalMethod> interval_methods[] = {
    {"effective samples", ::fit::IntervalMethod::effective_samples},
    {"cycle clusters", ::fit::IntervalMethod::cycle_clusters},
    {"block bootstrap", ::fit::IntervalMethod::block_bootstrap}};
constexpr FitWord<std::optional<::fit::Law>> laws[] = {
    {"constant", ::fit::Law::constant},   {"kc", ::fit::Law::kc}, {"re", ::fit::Law::re}, {"beta", ::fit::Law::beta},
    {"kc and re", ::fit::Law::kc_and_re}, {"best", std::nullopt}};

bool accepts_residuals(const FitTables& t) { return t.ask().has("accept"); }

::fit::Cylinder read_cylinder(const Record& model) {
  const Record& water = model.table("water");
  return {.diameter = model.si("diameter"),
          .length = model.si("length"),
          .density = water.si("density"),
          .viscosity = water.has("viscosity") ? std::optional(water.si("viscosity")) : std::nullopt,
          .experiment = ::fit::Experiment::water_moves};
}

/// Mass and stiffness of a translation, or inertia and rotational stiffness of a turn, as the channels have it.
::fit::RestoredBody read_restored(const Record& body, bool turns) {
  for (const char* other : turns ? std::array{"mass", "stiffness"} : std::array{"inertia", "rotational_stiffness"})
    if (body.has(other))
      throw body.wrong(other, fmt::format("does not go with the channel {}", turns ? "angle" : "position"),
                       turns ? "give inertia and rotational_stiffness" : "give mass and stiffness");
  return {body.si(turns ? "inertia" : "mass"), body.si(turns ? "rotational_stiffness" : "stiffness"),
          given(body, "mass_error"), given(body, "stiffness_error")};
}

/// What is asked for. \throws hydro::InputError where nothing is, with an `example`
const std::vector<Located<std::string>>& wanted(const FitTables& t, const char* example) {
  if (!t.ask().has("coefficients"))
    throw t.ask().refused("needs the key \"coefficients\"", fmt::format("add coefficients = {}", example));
  return t.ask()["coefficients"].texts;
}

bool of_force(const std::string& coefficient) {
  return coefficient == "cd" || coefficient == "cm" || coefficient == "ca";
}

InputError no_coefficient(const FitTables& t, const Located<std::string>& c, const char* remedy) {
  return InputError(
      fmt::format("[ask] coefficients: \"{}\" does not apply to a fit of kind \"{}\"", c.value, t.model().text("kind")),
      c.place, remedy);
}

void read_delay(const Record& prepare, MorisonModel& out) {
  if (!prepare.has("delay")) return;
  const bool estimate = prepare.text("delay") == "estimate";
  if (estimate && prepare.has("delay_error"))
    throw prepare.wrong("delay_error", "does not act where the delay is estimated: its error is then estimated too",
                        "leave it out");
  if (!estimate && prepare.has("longest_delay"))
    throw prepare.wrong("longest_delay", "does not act where the delay is given",
                        "leave it out, or set delay = \"estimate\"");
  if (!estimate) out.prepare.delay_s = prepare.si("delay");
  out.options.delay_error_s = given(prepare, "delay_error");
  if (!estimate) return;
  if (!prepare.has("longest_delay"))
    throw prepare.wrong(
        "delay", "needs \"longest_delay\"",
        "add longest_delay = \"1 s\": less than half the main period, which would be the force turned round");
  out.longest_delay = prepare.si("longest_delay");
}

// Morison

/// What only moving water, or only a moving body, has.
void check_water_channels(const Record& channels, ::fit::Experiment experiment) {
  using enum ::fit::Experiment;
  if (experiment == body_moves)
    for (const char* role : {"cross_velocity", "elevation"})
      if (channels.has(role))
        throw channels.wrong(role, "has no part where the body moves in still water", "leave it out");
  for (const char* role : {"water_velocity", "water_acceleration"})
    if (channels.has(role) && experiment != both_move)
      throw channels.wrong(role, fmt::format("has no part with motion = \"{}\"", word_of(experiment)),
                           "leave it out, or set motion = \"both move\"");
  if (experiment == both_move && channels.has("elevation") == channels.has("water_velocity"))
    throw channels.refused("needs either water_velocity or elevation where both move",
                           "name the column of the water's motion; velocity and position are the body's");
}

/// Exactly one of the motion's channels, which others must not contradict.
void check_motion_channels(const Record& channels, ::fit::Experiment experiment) {
  check_water_channels(channels, experiment);
  const auto refuse_beside_elevation = [&](std::initializer_list<const char*> others) {
    for (const char* other : others)
      if (channels.has(other)) throw channels.wrong(other, "does not act beside the elevation", "keep one of the two");
  };
  if (channels.has("elevation") && experiment != ::fit::Experiment::both_move)
    return refuse_beside_elevation({"velocity", "position", "acceleration", "cross_velocity"});
  if (channels.has("elevation")) refuse_beside_elevation({"water_acceleration", "cross_velocity"});
  if (!channels.has("velocity") && !channels.has("position"))
    throw channels.refused("needs velocity or position for a fit of kind \"morison\": drag needs the velocity",
                           "add one of them; an acceleration alone does not give it, its integral drifts");
  if (channels.has("velocity") && channels.has("position"))
    throw channels.wrong("position", "does not act beside the velocity", "keep one of the two");
}

::fit::Cylinder read_cylinder_in_force(const Record& model) {
  ::fit::Cylinder out = read_cylinder(model);
  out.experiment = value_of_word(experiments, model.text("motion"));
  const bool known = model.has("mass_beyond_load_cells"), moves = out.experiment != ::fit::Experiment::water_moves;
  if (known && !moves)
    throw model.wrong("mass_beyond_load_cells", "does not act: the body does not move",
                      "leave it out, or set motion = \"body moves\"");
  if (!known && moves)
    throw model.refused(
        "needs \"mass_beyond_load_cells\" where the body moves: its inertia is part of the measured force",
        "add mass_beyond_load_cells = \"5.9 kg\", contained water included; \"0 kg\" if it is taken off already");
  out.mass_beyond_load_cells = given(model, "mass_beyond_load_cells");
  return out;
}

::fit::CylinderErrors read_errors(const Record& model, ::fit::Experiment experiment) {
  if (!model.has("uncertainty")) return {};
  const Record& e = model.table("uncertainty");
  if (e.has("mass") && experiment == ::fit::Experiment::water_moves)
    throw e.wrong("mass", "does not act: the body does not move", "leave it out");
  return {given(e, "diameter"), given(e, "length"), given(e, "density"), given(e, "mass")};
}

std::optional<::fit::ProbeToBody> read_probe(const FitTables& t, const ::fit::Cylinder& cylinder) {
  const Record &model = t.model(), &channels = t.channels();
  if (!model.has("wave") && channels.has("elevation"))
    throw model.refused("needs \"wave\" for the channel elevation",
                        "add wave = { depth = \"1.25 m\", level = \"0.48 m\" }");
  if (!model.has("wave")) return {};
  const Record& wave = model.table("wave");
  ::fit::ProbeToBody out{.water = {.density = cylinder.density, .gravity = wave.si("gravity")},
                         .level = -wave.si("level"),
                         .ahead = wave.si("ahead"),
                         .regular = wave.has("regular"),
                         .follow = wave.has("follow")};
  if (out.follow && !(cylinder.experiment == ::fit::Experiment::both_move && channels.has("position")))
    throw wave.wrong("follow", "needs to know where the body is",
                     "set motion = \"both move\" with the channel position, or leave it out");
  if (wave.text("depth").empty()) out.water.depth = hydro::WaterDepth::from_metres(wave.si("depth"));
  if (!out.water.depth.is_infinite() && -out.level >= out.water.depth.metres())
    throw wave.wrong("level", "lies below the bottom", "give the depth of the axis below still water");
  if (!channels.has("elevation"))
    throw model.wrong("wave", "does not act: there is no channel elevation", "leave it out");
  return out;
}

::fit::MorisonOptions read_morison_options(const FitTables& t, const ::fit::Cylinder& cylinder) {
  const Record& model = t.model();
  ::fit::MorisonOptions out{.confidence = t.confidence(),
                            .method = value_of_word(interval_methods, t.ask().table("intervals").text("method")),
                            .force_offset = model.has("offset"),
                            .linear_drag = model.has("linear_drag"),
                            .bands = true,
                            .robust = t.ask().has("robust"),
                            .cylinder_errors = read_errors(model, cylinder.experiment)};
  for (const Record& line : model.tables("line"))
    out.lines.push_back({line.has("frequency") ? hertz(line, "frequency") : 0.0, given(line, "multiple")});
  return out;
}

// Decay

::fit::DecayMemoryOptions read_decay_memory(const FitTables& t, const ::fit::DecayOptions& options) {
  const Record& model = t.model();
  if (!model.has("start"))
    throw model.refused("needs \"start\" for a memory: what does the radiation memory hold at the first sample?",
                        "add start = \"let go from rest\" if the record begins there, or start = \"in motion\"");
  if (options.terms.coulomb)
    throw t.ask().wrong("coefficients",
                        "may not hold coulomb beside memory: a body at rest would not be at rest for good",
                        "leave one of them out");
  if (options.pendulum)
    throw model.wrong("restoring", "must be linear with a memory: radiation is known for small motions",
                      "leave it out");
  return {.terms = options.terms,
          .starts_empty = model.text("start") == "let go from rest",
          .confidence = options.confidence};
}

// Motion

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

/// How the parameters are searched for.
void read_search(const Record& model, MotionModel& out) {
  if (model.has("starts")) out.starts = static_cast<int>(model["starts"].integer);
  if (model.has("starts") && (out.starts < 2 || out.parameters.size() > 12))
    throw model.wrong("starts", "must be 2 at least, for 12 parameters at most", "leave it out for one start");
  constexpr std::int64_t most_iterations = 100'000;
  if (model["iterations"].integer > most_iterations)
    throw model.wrong("iterations", fmt::format("may be {} at most", most_iterations), "most need five to twenty");
  out.iterations = static_cast<int>(model["iterations"].integer);
  for (const auto& q : out.parameters)
    if (out.starts > 1 && !std::isfinite(q.number.highest - q.number.lowest))
      throw InputError(
          fmt::format("[[model.parameter]] {} has no bounds between which a search could start", q.number.name),
          q.place, "give lowest and highest, or leave out [model] starts");
}

}  // namespace

std::string word_of(::fit::Experiment experiment) { return word_of_value(experiments, experiment); }
std::string word_of(::fit::IntervalMethod method) { return word_of_value(interval_methods, method); }

FitModel read_morison(const FitTables& t) {
  const Record& ask = t.ask();
  MorisonModel out;
  out.cylinder = read_cylinder_in_force(t.model());
  out.prepare = read_steps(t.root);
  out.options = read_morison_options(t, out.cylinder);
  check_motion_channels(t.channels(), out.cylinder.experiment);
  out.probe = read_probe(t, out.cylinder);
  if (t.data().has("zero")) out.zero_run = {{beside(t.file, t.data().text("zero")), t.data()["zero"].place}};
  out.prepare.linear_drag = out.options.linear_drag;
  if (t.root.has("prepare")) read_delay(t.root.table("prepare"), out);
  for (const auto& c : wanted(t, "[\"cd\"]")) {
    if (!of_force(c.value)) throw no_coefficient(t, c, "ask for cd, cm or ca");
    out.coefficients.push_back(c.value);
  }
  if (ask.has("law")) out.law = {value_of_word(laws, ask.text("law"))};
  out.cycles = ask.has("cycles");
  out.sensitivity = ask.has("sensitivity");
  if (out.cycles && out.prepare.window.kind != ::fit::WindowChoice::Kind::full_cycles)
    throw ask.wrong("cycles", "needs cycles", "set [prepare] window = { kind = \"full cycles\" }");
  if (out.cycles && out.longest_delay)
    throw ask.wrong("cycles", "cannot be had while the delay is being estimated", "give the delay that was estimated");
  return out;
}

FitModel read_towing(const FitTables& t) {
  for (const auto& c : wanted(t, "[\"cd\"]")) {
    if (!of_force(c.value)) throw no_coefficient(t, c, "ask for cd, cm or ca");
    if (c.value != "cd")
      throw InputError(fmt::format("[ask] coefficients: \"{}\" cannot come from towing at steady speed", c.value),
                       c.place, "ask for \"cd\" alone");
  }
  return TowingModel{read_cylinder(t.model()), accepts_residuals(t)};
}

FitModel read_decay(const FitTables& t) {
  const Record &model = t.model(), &channels = t.channels(), &ask = t.ask();
  DecayModel out;
  out.prepare = read_steps(t.root);
  if (out.prepare.window.kind == ::fit::WindowChoice::Kind::full_cycles)
    throw t.root.table("prepare").table("window").wrong(
        "kind", "must be \"span\" for a decay, which has no cycles of full amplitude");
  out.options.pendulum = model.text("restoring") == "sine";
  if (out.options.pendulum && channels.has("position"))
    throw model.wrong("restoring", "is by the sine of an angle, and the channel position is a length",
                      "name the channel angle, or take restoring = \"linear\"");
  if (channels.has("angle") == channels.has("position"))
    throw channels.refused("needs either position or angle for a fit of kind \"decay\"",
                           "name the column of the motion");
  if (model.has("body")) out.body = read_restored(model.table("body"), channels.has("angle"));
  if (out.body && !(out.body->stiffness > 0))
    throw model.table("body").refused("needs a stiffness: without one there is no natural period",
                                      "give what brings the body back");
  out.options.confidence = t.confidence();
  ::fit::DampingTerms& terms = out.options.terms = {.linear = false};
  bool memory = false;
  const std::vector<std::pair<std::string_view, bool*>> known{{"linear", &terms.linear},
                                                              {"quadratic", &terms.quadratic},
                                                              {"cubic", &terms.cubic},
                                                              {"coulomb", &terms.coulomb},
                                                              {"memory", &memory}};
  for (const auto& c : wanted(t, "[\"linear\", \"quadratic\"]")) {
    if (of_force(c.value)) throw no_coefficient(t, c, "a decay knows linear, quadratic, cubic, coulomb and memory");
    for (const auto& [name, asked] : known)
      if (c.value == name) *asked = true;
  }
  if (memory) out.memory = read_decay_memory(t, out.options);
  if (!memory && model.has("start"))
    throw model.wrong("start", "does not act without a memory",
                      "add \"memory\" to [ask] coefficients, or leave it out");
  out.profile = ask.has("profile");
  out.sensitivity = ask.has("sensitivity");
  out.accept_residuals = accepts_residuals(t);
  out.together = ask.has("together");
  return out;
}

FitModel read_radiation(const FitTables& t) {
  const Record& channels = t.channels();
  if (channels.has("angle") == channels.has("position"))
    throw channels.refused("needs either position or angle for a fit of kind \"radiation\"",
                           "name the column of the motion");
  if (channels.has("position") != channels.has("force") || channels.has("angle") != channels.has("torque"))
    throw channels.refused("needs force beside a position, torque beside an angle", "name what moved the body");
  return RadiationModel{read_restored(t.model().table("body"), channels.has("angle"))};
}

FitModel read_friction_ramp(const FitTables& t) {
  const Record& channels = t.channels();
  if (channels.has("torque") == channels.has("force"))
    throw channels.refused("needs either torque or force for a fit of kind \"friction ramp\"",
                           "name the torque on a hinge, or the force on a slider");
  const Record& model = t.model();
  return FrictionRampModel{{.ramp_s = model.si("ramp"),
                            .slide_s = model.si("slide"),
                            .drop_s = model.si("drop"),
                            .confidence = t.confidence()}};
}

FitModel read_motion(const FitTables& t) {
  const Record &model = t.model(), &ask = t.ask(), &data = t.data();
  MotionModel out{.scene = {beside(t.file, model.text("scene")), model["scene"].place},
                  .window = given(model, "window"),
                  .profile = ask.has("profile"),
                  .accept_residuals = accepts_residuals(t),
                  .place = model.place()};
  std::error_code unknown;
  if (!fs::is_regular_file(out.scene.value, unknown))
    throw model.wrong("scene", "is no file", fmt::format("looked for {}", out.scene.value.string()));
  out.parameters = read_parameters(model, out.scene.value);
  read_search(model, out);
  for (const Record& s : data.tables("signal"))
    out.signals.push_back({s.text("column"), s.text("of"), {s.text("deviation"), s["deviation"].place}});
  if (out.signals.empty())
    throw data.refused("needs what was measured",
                       "add a [[data.signal]] with its column, the signal of the run, and the deviation of its noise");
  if (out.profile && out.starts > 1 && out.window > 0)
    throw ask.wrong("profile", "cannot be had with several starts of a search in windows",
                    "give each parameter the first value that was found, and leave out [model] starts");
  return out;
}

}  // namespace froude::scene
