#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "hydro/io/atomic_file.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;

const std::vector<std::string> all_channels{"time",     "force", "velocity", "acceleration",
                                            "position", "speed", "speed_sd", "force_sd"};

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
  for (const auto& entry : data["files"].texts) expand(data, entry, scene, out);
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  const auto twice =
      std::adjacent_find(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.value == b.value; });
  if (twice != out.end())
    throw InputError(fmt::format("{} files holds {} twice", data.title(), twice->value.string()),
                     std::next(twice)->place, "name each file once, or the fit counts it twice");
  return out;
}

std::map<std::string, std::string> read_channels(const Record& channels, const std::string& kind) {
  const bool towing = kind == "towing";
  const std::vector<std::string> known =
      towing ? std::vector<std::string>{"speed", "force", "speed_sd", "force_sd"}
             : std::vector<std::string>{"time", "force", "velocity", "acceleration", "position"};
  const std::vector<std::string> needed =
      towing ? std::vector<std::string>{"speed", "force"} : std::vector<std::string>{"time", "force"};
  std::map<std::string, std::string> out;
  for (const std::string& role : all_channels) {
    if (!channels.has(role)) continue;
    if (std::find(known.begin(), known.end(), role) == known.end())
      throw channels.wrong(role, fmt::format("has no part in a fit of kind \"{}\"", kind),
                           fmt::format("its channels are {}", fmt::join(known, ", ")));
    if (channels.text(role).empty()) throw channels.wrong(role, "is empty", "write the name of a column");
    out[role] = channels.text(role);
  }
  for (const std::string& role : needed)
    if (out.count(role) == 0)
      throw channels.refused(fmt::format("needs \"{}\" for a fit of kind \"{}\"", role, kind),
                             fmt::format("add {} = \"name of a column\"", role));
  if (!towing && out.count("velocity") + out.count("position") == 0)
    throw channels.refused("needs velocity or position for a fit of kind \"morison\": drag needs the velocity",
                           "add one of them; an acceleration alone does not give it, its integral drifts");
  if (out.count("velocity") > 0 && out.count("position") > 0)
    throw channels.wrong("position", "does not act beside the velocity", "keep one of the two");
  return out;
}

FitScene::Model read_model(const Record& model) {
  const Record& water = model.table("water");
  FitScene::Model out{.kind = model.text("kind"),
                      .diameter = model.si("diameter"),
                      .length = model.si("length"),
                      .density = water.si("density"),
                      .viscosity = {},
                      .motion = {},
                      .place = model.place()};
  if (water.has("viscosity")) out.viscosity = water.si("viscosity");
  if (out.kind != "morison") return out;
  out.motion = model.text("motion");
  const bool given = model.has("mass_beyond_load_cells"), moves = out.motion == "body moves";
  if (given && !moves)
    throw model.wrong("mass_beyond_load_cells", "does not act: the body does not move",
                      "leave it out, or set motion = \"body moves\"");
  if (!given && moves)
    throw model.refused(
        "needs \"mass_beyond_load_cells\" where the body moves: its inertia is part of the measured force",
        "add mass_beyond_load_cells = \"5.9 kg\", contained water included; \"0 kg\" if it is taken off already");
  if (given) out.mass_beyond_load_cells = model.si("mass_beyond_load_cells");
  return out;
}

std::vector<std::string> read_coefficients(const Record& ask, const std::string& kind) {
  std::vector<std::string> out;
  for (const auto& c : ask["coefficients"].texts) {
    if (kind == "towing" && c.value != "cd")
      throw InputError(fmt::format("[ask] coefficients: \"{}\" cannot come from towing at steady speed", c.value),
                       c.place, "ask for \"cd\" alone");
    out.push_back(c.value);
  }
  return out;
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
  scene.model = read_model(root.table("model"));
  scene.channels = read_channels(root.table("data").table("channels"), scene.model.kind);
  scene.coefficients = read_coefficients(root.table("ask"), scene.model.kind);
  scene.confidence = root.table("ask").table("intervals").si("level");
  scene.files = read_files(root.table("data"), file);
  return scene;
}

FitScene read_fit(const fs::path& file) { return parse_fit(hydro::io::read_text(file), file); }

}  // namespace froude::scene
