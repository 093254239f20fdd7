#include "froude/scene_result.hpp"

#include "froude/outputs.hpp"
#include "hydro/base/error.hpp"

namespace froude {

Path checked_output(const SceneArguments& arguments, const std::string& ending) {
  const Path file = arguments.output.value_or(arguments.scene.stem().string() + ending);
  if (file.extension() != ".h5" && file.extension() != ".nc")
    throw hydro::InputError(
        fmt::format("a result is HDF5, so its file cannot end in \"{}\"", file.extension().string()),
        {.file = file.string()}, "end it in .h5 or .nc; --csv FILE writes a table as well");
  require_outputs(
      named(
          {{arguments.output ? "-o" : "the result", file}, {"--csv", arguments.csv}, {"--picture", arguments.picture}}),
      files_of_scene(arguments.scene));
  return file;
}

Provenance provenance_of(const scene::Scene& scene, const std::vector<std::string>& notes) {
  Provenance p;
  p.scene_file = scene.file.filename().string();
  p.scene_text = scene.text;
  for (const auto& e : scene.echo) p.settings.emplace_back(e.key, e.value + (e.defaulted ? " (default)" : ""));
  if (scene.waves)
    if (const auto* sea = std::get_if<scene::RandomSea>(&scene.waves->kind))
      p.seeds.emplace_back("waves", static_cast<double>(sea->seed));
  for (std::size_t i = 0; i < notes.size(); ++i) p.notes.emplace_back(fmt::format("note{}", i + 1), notes[i]);
  return p;
}

void require_asked(bool asked, const scene::Scene& scene, const std::string& what, const std::string& example) {
  if (!asked)
    throw hydro::InputError(fmt::format("the scene does not ask for a {}", what), {.file = scene.file.string()},
                            "add to [ask]: " + example);
}

}  // namespace froude
