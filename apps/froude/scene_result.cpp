#include "froude/scene_result.hpp"

#include "froude/outputs.hpp"
#include "hydro/base/error.hpp"

namespace froude {

Path checked_output(const SceneArguments& arguments, const std::string& ending,
                    const std::vector<std::pair<std::string, std::optional<Path>>>& tables) {
  const Path file = arguments.output.value_or(arguments.scene.stem().string() + ending);
  require_result(file, "--csv FILE writes a table as well");
  std::vector<std::pair<std::string, std::optional<Path>>> all = {
      {arguments.output ? "-o" : "the result", file}, {"--csv", arguments.csv}, {"--picture", arguments.picture}};
  all.insert(all.end(), tables.begin(), tables.end());
  require_outputs(named(all), files_of_scene(arguments.scene));
  for (const auto& [use, table] : tables) require_csv(table);
  require_picture(arguments.picture);
  return file;
}

void require_asked(bool asked, const scene::Scene& scene, const std::string& what, const std::string& example) {
  if (!asked)
    throw hydro::InputError(fmt::format("the scene does not ask for {}", what), {.file = scene.file.string()},
                            "add to [ask]: " + example);
}

}  // namespace froude
