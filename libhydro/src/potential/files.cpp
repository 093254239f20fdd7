#include <algorithm>
#include <array>

#include "readers.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

// What the readers open beside the file that they are given. Sets share a stem, runs share a folder.
constexpr std::array set_endings{".1", ".2", ".3", ".3fk", ".3sc", ".hst", ".out", ".re7", ".re8"};
constexpr std::array run_endings{".cal", ".tec", ".dat", ".in", ".1", ".3", ".hst"};

template <class Endings>
bool ends_in(const fs::path& path, const Endings& endings) {
  return std::find(endings.begin(), endings.end(), path.extension().string()) != endings.end();
}

/// The folder of a run of NEMOH or HAMS of which `path` is the whole or a part, or an empty path.
fs::path run_folder(const fs::path& path) {
  fs::path at = fs::absolute(path).lexically_normal();
  if (!fs::is_directory(at) && !ends_in(at, run_endings)) return {};
  for (int up = 0; up <= 3; ++up, at = at.parent_path())  // HAMS: Output/Wamit_format/buoy.1
    if (!entry_of(at, "Nemoh.cal").empty() || fs::exists(at / "Input" / "ControlFile.in")) return at;
  return {};
}

}  // namespace

std::vector<fs::path> files_behind(const fs::path& path) {
  std::vector<fs::path> out;
  const auto add = [&](const fs::path& file) {
    std::error_code unknown;
    if (fs::is_regular_file(file, unknown)) out.push_back(file);
  };
  add(path);
  const std::string stem = ends_in(path, set_endings) ? fs::path(path).replace_extension().string() : path.string();
  for (const char* ending : set_endings) add(stem + ending);
  if (const fs::path folder = run_folder(path); !folder.empty()) {
    std::error_code failed;
    for (fs::recursive_directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
      if (at.depth() >= 2) at.disable_recursion_pending();  // results lie two folders below at most
      if (ends_in(at->path(), run_endings)) add(at->path());
    }
  }
  return out;
}

}  // namespace hydro::potential
