#include "froude/sweep_task.hpp"

#include <fmt/format.h>

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

/// Without the scene itself.
std::vector<Path> paths_beside_scene(const std::vector<NamedFile>& files) {
  std::vector<Path> out;
  for (std::size_t i = 1; i < files.size(); ++i) out.push_back(files[i].path);
  return out;
}

}  // namespace

SweepTask::SweepTask(const Path& file)
    : study(sweep::read_study(file)),
      inputs(scene::placed(study.scene.place, [&] { return files_of_scene(study.scene.value); })),
      cases(study, scene_text(), paths_beside_scene(inputs)) {
  inputs.push_back({"the study", file});
}

std::string SweepTask::scene_text() const { return hydro::io::read_text(study.scene.value); }

sweep::Identity SweepTask::identity() const {
  return {cases.definition(), study.file.filename().string(), study.text, scene_text(), cases.count(), cases.columns()};
}

void SweepTask::require_folder(const Path& folder) const {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed)
    throw hydro::InputError(fmt::format("cannot make the folder \"{}\": {}", folder.string(), failed.message()), {},
                            "name another one with -o");
  std::vector<NamedFile> outputs{{"the table", folder / "table.csv"}, {"the database", sweep::database_of(folder)}};
  for (const sweep::Picture& picture : study.pictures) {
    outputs.push_back({"[[picture]] file", folder / picture.file.value});
    outputs.push_back({"its table", (folder / picture.file.value).replace_extension(".csv")});
  }
  require_outputs(outputs, inputs);
}

}  // namespace froude
