#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"
#include "scene/binding.hpp"
#include "scene/build.hpp"
#include "scene/override.hpp"

namespace froude::scene {
namespace {

using hydro::InputError;

/// Equilibrium finds where bodies begin; `initial` says it.
void check_start(const Record& root, const Scene& scene) {
  if (!scene.run || !scene.run->from_equilibrium) return;
  for (const Record& body : root.tables("body"))
    if (body.has("initial"))
      throw body.table("initial").refused("places a body that is to begin in equilibrium",
                                          "leave it out, or take start = \"equilibrium\" out of [ask.run]");
}

void check_excitation(const Record& root, const Scene& scene) {
  bool excited =
      std::any_of(scene.members.begin(), scene.members.end(), [](const Member& m) { return m.morison || m.ends; });
  for (const Record& body : root.tables("body")) {
    if (!body.has("hydrodynamics") || !body.table("hydrodynamics").has("excitation")) continue;
    excited = true;
    if (scene.run && !scene.waves)
      throw body.table("hydrodynamics")
          .wrong("excitation", "needs waves for a run", "add a [waves] table, or leave the key out");
  }
  if (scene.rao && !excited)
    throw root.table("ask").table("rao").refused(
        "asks how bodies answer waves, but no body names excitation, and no member Morison's loads or those of ends",
        "add excitation = true to [body.hydrodynamics]");
}

}  // namespace

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

Scene ChangeableScene::with(const std::vector<OverriddenValue>& values) const {
  Node document = *document_;
  override_values(document, values);
  if (const auto* model = document.find("model"))
    throw InputError("this scene has a [model]: it asks for a fit, not for motion", model->place,
                     "use `froude fit`, or take the table out");
  Scene scene;
  scene.file = file_;
  scene.text = text_;
  const Record root = read_record(document, motion_schema(), scene.echo);
  if (root.has("title")) scene.title = root.text("title");
  scene.water = build_water(root.table("water"));
  if (root.has("current")) {
    scene.current = build_current(root.table("current"), file_);
    scene.current_place = root.table("current").place();
  }
  if (root.has("waves")) scene.waves = build_waves(root.table("waves"), scene);
  Names names;
  build_probes(root, names, scene);
  scene.bodies = build_bodies(root, names);
  build_signals(root, names, scene);
  build_members(root, names, scene);
  build_lines(root, names, scene);
  build_moorings(root, names, scene);
  build_connectors(root, names, scene);
  build_contacts(root, names, scene);
  build_joints(root, names, scene);
  build_elements(root, names, scene);
  ask_binding().read_into(root.table("ask"), scene);
  build_solve(root.table("solve"), scene);
  check_excitation(root, scene);
  check_start(root, scene);
  return scene;
}

Scene parse_with(std::string_view text, const std::filesystem::path& file, const std::vector<OverriddenValue>& values) {
  return ChangeableScene(text, file).with(values);
}

Scene parse(std::string_view text, const std::filesystem::path& file) { return parse_with(text, file, {}); }

Scene read(const std::filesystem::path& file) { return parse(hydro::io::read_text(file), file); }

}  // namespace froude::scene
