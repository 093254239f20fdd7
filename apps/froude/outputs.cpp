#include "froude/outputs.hpp"

#include "answers/picture.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/potential/formats/files.hpp"
#include "scene/document.hpp"
#include "scene/scene.hpp"

namespace froude {
namespace {

namespace fs = std::filesystem;
using scene::Node;

/// Files that a text of a scene leads to; none for a text that is no path. Records alone are named with `*`, which in
/// other keys stands in names of bodies and signals.
std::vector<Path> files_of_text(const std::string& key, const Path& path) {
  if (key != "data.files") return hydro::potential::files_behind(path);
  std::vector<Path> out;
  std::error_code failed;
  for (fs::directory_iterator at(path.parent_path(), failed), end; !failed && at != end; at.increment(failed))
    if (std::error_code unknown;
        at->is_regular_file(unknown) && scene::matches(path.filename().string(), at->path().filename().string()))
      out.push_back(at->path());
  return out;
}

class SceneFiles {
 public:
  void add_scene(const std::string& use, const Path& file) {
    files.push_back({use, file});
    add(scene::parse_document(hydro::io::read_text(file), file.string()), "", file);
  }
  std::vector<NamedFile> files;

 private:
  void add(const Node& node, const std::string& key, const Path& scene) {
    for (const Node& item : node.items) add(item, key, scene);
    for (const Node::Entry& entry : node.entries) add(entry.value, (key.empty() ? "" : key + ".") + entry.key, scene);
    constexpr std::size_t longest_path = 4096;  // a longer text is no name of a file
    if (node.is(Node::Type::text) && !node.text.empty() && node.text.size() < longest_path)
      for (const Path& file : files_of_text(key, fs::absolute(scene).parent_path() / node.text)) add_file(key, file);
  }
  void add_file(const std::string& key, const Path& file) {
    if (key == "model.scene" || key == "data.record.scene") return add_scene("the scene of the key " + key, file);
    files.push_back({"the key " + key + " of the scene", file});
    if (key == "data.runs") add_runs(file);
  }
  void add_runs(const Path& file) {
    const auto table = hydro::io::CsvTable::read(file);
    for (const char* column : {"file", "zero"})
      if (table.has(column) && table.is_text(column))
        for (const std::string& name : table.text_column(column))
          files.push_back({"a run in the table of runs", file.parent_path() / name});
  }
};

[[noreturn]] void refuse(const NamedFile& output, const std::string& why, const std::string& remedy) {
  throw hydro::InputError(
      fmt::format("\"{}\" would be replaced: {} is to write it, {}", output.path.string(), output.use, why), {},
      remedy);
}

}  // namespace

std::vector<NamedFile> named(const std::vector<std::pair<std::string, std::optional<Path>>>& options) {
  std::vector<NamedFile> out;
  for (const auto& [use, path] : options)
    if (path) out.push_back({use, *path});
  return out;
}

void require_csv(const std::optional<Path>& table) {
  if (!table || !table->has_extension() || table->extension() == ".csv") return;
  throw hydro::InputError(fmt::format("a table is CSV, so its file cannot end in \"{}\"", table->extension().string()),
                          {.file = table->string()}, "end it in .csv");
}

void require_result(const Path& file, const std::string& tables) {
  if (file.extension() == ".h5" || file.extension() == ".nc") return;
  throw hydro::InputError(fmt::format("a result is HDF5, so its file cannot end in \"{}\"", file.extension().string()),
                          {.file = file.string()}, "end it in .h5 or .nc; " + tables);
}

void require_picture(const std::optional<Path>& picture) {
  if (picture) plot::require_picture(*picture);
}

void require_outputs(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const NamedFile& output = outputs[i];
    for (const NamedFile& input : inputs)
      if (std::error_code unknown; fs::exists(input.path, unknown) && hydro::io::same_file(output.path, input.path))
        refuse(output, fmt::format("and it is read as {}", input.use), "write to another name with " + output.use);
    for (std::size_t j = 0; j < i; ++j)
      if (hydro::io::same_file(output.path, outputs[j].path))
        refuse(output, fmt::format("and so is {}", outputs[j].use), "give each output a name of its own");
    hydro::io::require_writable(output.path);
  }
}

std::vector<NamedFile> files_of_scene(const Path& scene) {
  SceneFiles found;
  found.add_scene("the scene", scene);
  return found.files;
}

std::vector<NamedFile> files_of_coefficients(const std::vector<Path>& files) {
  std::vector<NamedFile> out;
  for (const Path& given : files)
    for (const Path& file : hydro::potential::files_behind(given)) out.push_back({"the coefficients", file});
  return out;
}

std::vector<NamedFile> files_below(const std::string& use, const Path& folder) {
  std::vector<NamedFile> out;
  std::error_code failed;
  for (fs::recursive_directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed))
    if (std::error_code unknown; at->is_regular_file(unknown)) out.push_back({use, at->path()});
  return out;
}

}  // namespace froude
