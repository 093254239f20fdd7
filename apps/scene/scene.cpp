#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"
#include "scene/build.hpp"
#include "scene/override.hpp"

namespace froude::scene {
namespace {

using hydro::InputError;

void read_of(const Record& asked, std::vector<std::string>& of, std::vector<Place>& places) {
  if (asked["of"].defaulted) return;  // empty means everything
  for (const auto& pattern : asked["of"].texts) {
    of.push_back(pattern.value);
    places.push_back(pattern.place);
  }
}

std::vector<double> read_omega(const Record& rao) {
  if (rao.has("omega")) return rao["omega"].range;
  std::vector<double> omega = rao["periods"].range;
  for (double& value : omega) value = 2 * std::numbers::pi / value;
  std::reverse(omega.begin(), omega.end());
  return omega;
}

/// The heading that an RAO takes over from [waves] is echoed like any other value that was filled in.
void read_headings(const Record& rao, Scene& scene) {
  const char* key = rao.has("headings") ? "headings" : "heading";
  if (rao.has(key)) {
    scene.rao->headings = rao.has("headings") ? rao[key].range : std::vector{rao.si(key)};
    scene.rao->headings_place = rao[key].place;
    return;
  }
  if (!scene.waves)
    throw rao.refused("needs a heading, as there is no [waves] to take it from",
                      "add heading = \"0 deg\" to [ask.rao]");
  scene.rao->headings = {scene.waves->heading.radians()};
  scene.rao->headings_place = scene.waves->place;
  const auto before =
      std::find_if(scene.echo.begin(), scene.echo.end(), [](const Echo& e) { return e.key == "ask.rao.of"; });
  const auto waves =
      std::find_if(scene.echo.begin(), scene.echo.end(), [](const Echo& e) { return e.key == "waves.heading"; });
  const std::string value = waves->value;
  scene.echo.insert(before, {"ask.rao.heading", value, true});
}

std::optional<AskRao::DragIn> read_drag(const Record& rao, const Scene& scene) {
  if (!rao.has("drag")) return std::nullopt;
  const Record& drag = rao.table("drag");
  if (std::none_of(scene.members.begin(), scene.members.end(), [](const Member& m) { return m.cd.has_value(); }))
    throw drag.refused("makes drag linear, but no member names drag", "leave it out, or add a [[member]] with drag");
  AskRao::DragIn out{.height = {}, .steepness = {}, .place = drag.place()};
  if (drag.has("height")) out.height = drag.si("height");
  if (drag.has("steepness")) out.steepness = drag.si("steepness");
  return out;
}

About read_about(const Record& asked) { return {asked.text("about") == "equilibrium", asked.place()}; }

/// `duration` of a series must be a whole multiple of `every`.
void check_whole(const Record& asked) {
  const double every = asked.si("every"), steps = asked.si("duration") / every, whole = std::round(steps);
  if (whole < 1 || std::abs(steps - whole) > 1e-9 * steps)  // far above the round-off of the two, far below a sample
    throw asked.wrong("duration",
                      fmt::format("is {:.10g} times every = {}; a whole number is needed", steps, asked["every"].shown),
                      fmt::format("write duration = \"{:.10g} s\"", std::max(1.0, std::ceil(steps)) * every));
}

AskRun read_run(const Record& run) {
  check_whole(run);
  return {.duration = run.si("duration"),
          .every = run.si("every"),
          .from_equilibrium = run.text("start") == "equilibrium",
          .steady = run.text("start") == "steady",
          .of = {},
          .of_places = {},
          .place = run.place()};
}

/// Equilibrium finds where bodies begin; `initial` says it.
void check_start(const Record& root, const Scene& scene) {
  if (!scene.run || !scene.run->from_equilibrium) return;
  for (const Record& body : root.tables("body"))
    if (body.has("initial"))
      throw body.table("initial").refused("places a body that is to begin in equilibrium",
                                          "leave it out, or take start = \"equilibrium\" out of [ask.run]");
}

AskWaves read_ask_waves(const Record& asked, const Scene& scene) {
  check_whole(asked);
  if (!scene.waves) throw asked.refused("asks for waves, but there are none", "add a [waves] table");
  if (scene.probes.empty())
    throw asked.refused("needs a point at which the water is told", "add a [[probe]] with at = \"(0, 0, 0) m\"");
  return {
      .from = asked.si("from"), .duration = asked.si("duration"), .every = asked.si("every"), .place = asked.place()};
}

/// Motions need something that moves.
void check_bodies(const Record& root, const Scene& scene) {
  if (!scene.bodies.empty()) return;
  const Record& ask = root.table("ask");
  for (const char* what : {"rao", "run"}) {
    if (!ask.has(what) || (what == std::string_view("run") && !scene.chains.empty())) continue;
    throw ask.table(what).refused("asks for motion, but the scene has no body", "add a [[body]]");
  }
}

void check_excitation(const Record& root, const Scene& scene) {
  bool excited = false;
  for (const Record& body : root.tables("body")) {
    if (!body.has("hydrodynamics") || !body.table("hydrodynamics").has("excitation")) continue;
    excited = true;
    if (scene.run && !scene.waves)
      throw body.table("hydrodynamics")
          .wrong("excitation", "needs waves for a run", "add a [waves] table, or leave the key out");
  }
  if (scene.rao && !excited)
    throw root.table("ask").table("rao").refused("asks how bodies answer waves, but no body names excitation",
                                                 "add excitation = true to [body.hydrodynamics]");
}

}  // namespace

void build_ask(const Record& ask, Scene& scene) {
  scene.accuracy = ask.si("accuracy");
  if (ask.has("rao")) {
    const Record& rao = ask.table("rao");
    scene.rao = AskRao{.omega = read_omega(rao),
                       .headings = {},
                       .headings_place = {},
                       .of = {},
                       .of_places = {},
                       .drag = read_drag(rao, scene),
                       .about = read_about(rao),
                       .place = rao.place()};
    read_headings(rao, scene);
    read_of(rao, scene.rao->of, scene.rao->of_places);
  }
  if (ask.has("modes")) {
    const Record& modes = ask.table("modes");
    scene.ask_modes.emplace();
    scene.ask_modes->about = read_about(modes);
    if (modes.has("shortest")) scene.ask_modes->shortest = modes.si("shortest");
    if (modes.has("longest")) scene.ask_modes->longest = modes.si("longest");
    if (!(scene.ask_modes->shortest < scene.ask_modes->longest))
      throw modes.wrong("longest", "must be longer than the shortest period", "exchange the two, or leave one out");
  }
  if (ask.has("run")) {
    scene.run = read_run(ask.table("run"));
    read_of(ask.table("run"), scene.run->of, scene.run->of_places);
  }
  if (ask.has("waves")) scene.ask_waves = read_ask_waves(ask.table("waves"), scene);
}

// (D132)
bool acts_one_way(const Scene& scene) {
  const auto axial = [](const Connector& c) {
    const auto* law = std::get_if<AxialConnector>(&c.kind);
    return law != nullptr && (law->tension_only || !law->table_x.empty());
  };
  const auto line = [&](const Line& l) {
    return l.common.tension_only && (l.fastened() || scene.solve.line_scheme == "generalized_alpha");
  };
  return std::any_of(scene.connectors.begin(), scene.connectors.end(), axial) ||
         std::any_of(scene.joints.begin(), scene.joints.end(),
                     [](const Joint& j) { return j.pto && j.pto->has_stops(); }) ||
         std::any_of(scene.chains.begin(), scene.chains.end(), line);
}

Solve build_solve(const Record& solve) {
  Solve out;
  if (solve.text("step").empty()) out.step = {solve.si("step"), solve["step"].place};
  const Record& integrator = solve.table("integrator");
  out.integrator = integrator.text("name");
  out.integrator_place = integrator["name"].place;
  if (integrator.has("rho_infinity")) out.rho_infinity = integrator.si("rho_infinity");
  if (integrator.has("tolerance")) out.tolerance = integrator.si("tolerance");
  const bool lines_alike = integrator.has("lines") && integrator.text("lines") == "generalized_alpha";
  const auto only_of = [&](std::string_view key, std::string_view method) {
    if (!integrator.has(key) || out.integrator == method) return;
    throw integrator.wrong(key, fmt::format("acts only with name = \"{}\"", method), "leave it out");
  };
  if (!lines_alike) only_of("rho_infinity", "generalized_alpha");
  if (integrator.has("lines")) {
    out.line_scheme = integrator.text("lines");
    out.line_scheme_place = integrator["lines"].place;
  }
  if (integrator.has("gamma")) {
    if (out.line_scheme != "gamma")
      throw integrator.wrong("gamma", "acts only with lines = \"gamma\"", "leave it out, or add lines = \"gamma\"");
    out.gamma = integrator.si("gamma");
    if (out.gamma > 1) throw integrator.wrong("gamma", "is above 1", "0.5 is the trapezium rule, 1 implicit Euler");
  }
  return out;
}

std::filesystem::path beside(const std::filesystem::path& scene, const std::string& relative) {
  return std::filesystem::absolute(scene.parent_path() / relative).lexically_normal();
}

std::vector<double> rising_times(const Record& record, const hydro::io::CsvTable& table) {
  std::vector<double> time = table.column("time", hydro::dim::time);
  if (time.size() < 2) throw record.wrong("file", "holds fewer than two places of the path");
  for (std::size_t i = 1; i < time.size(); ++i)
    if (!(time[i] > time[i - 1])) throw InputError("times of a path must increase", table.place_of("time", i));
  if (time.front() > 0) throw record.wrong("file", "begins after t = 0", "let the path begin at t = 0 or before");
  return time;
}

void check_version(const Node& root) {
  const auto* schema = root.find("schema");
  if (schema == nullptr)
    throw InputError("a scene needs the key \"schema\"", root.place, "begin the file with schema = 1");
  if (!schema->value.is(Node::Type::integer) || schema->value.integer != 1)
    throw InputError(
        fmt::format("schema = {} is not a version of the grammar that this program knows", schema->value.raw),
        schema->value.place, "write schema = 1");
}

ChangeableScene::ChangeableScene(std::string_view text, std::filesystem::path file)
    : text_(text), file_(std::move(file)) {
  auto document = std::make_shared<Node>(parse_document(text_, file_.string()));
  check_version(*document);
  resolve_includes(*document, file_);
  document_ = std::move(document);
}

Scene ChangeableScene::with(const std::vector<OverriddenNumber>& numbers) const {
  Node document = *document_;
  override_numbers(document, numbers);
  if (const auto* model = document.find("model"))
    throw InputError("this scene has a [model]: it asks for a fit, not for motion", model->place,
                     "use `froude fit`, or take the table out");
  Scene scene;
  scene.file = file_;
  scene.text = text_;
  const Record root = read_record(document, motion_schema(), scene.echo);
  if (root.has("title")) scene.title = root.text("title");
  scene.water = build_water(root.table("water"));
  if (root.has("waves")) scene.waves = build_waves(root.table("waves"), scene);
  if (root.has("current")) {
    scene.current = build_current(root.table("current"), file_);
    scene.current_place = root.table("current").place();
  }
  Names names;
  build_probes(root, names, scene);
  scene.bodies = build_bodies(root, names);
  build_signals(root, names, scene);
  build_members(root, names, scene);
  build_chains(root, names, scene);
  build_moorings(root, names, scene);
  build_connectors(root, names, scene);
  build_contacts(root, names, scene);
  build_joints(root, names, scene);
  build_elements(root, names, scene);
  check_bodies(root, scene);
  build_ask(root.table("ask"), scene);
  scene.solve = build_solve(root.table("solve"));
  if (!root.table("solve").table("integrator").has("rho_infinity") && acts_one_way(scene)) scene.solve.rho_infinity = 0;
  check_excitation(root, scene);
  check_start(root, scene);
  return scene;
}

Scene parse_with(std::string_view text, const std::filesystem::path& file,
                 const std::vector<OverriddenNumber>& numbers) {
  return ChangeableScene(text, file).with(numbers);
}

Scene parse(std::string_view text, const std::filesystem::path& file) { return parse_with(text, file, {}); }

Scene read(const std::filesystem::path& file) { return parse(hydro::io::read_text(file), file); }

}  // namespace froude::scene
