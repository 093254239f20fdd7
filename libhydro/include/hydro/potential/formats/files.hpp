#pragma once
/// \file  Which files belong to coefficients that are named by one path.
#include <filesystem>
#include <vector>

namespace hydro::potential {

/// The files that read(path) may open, of those that are there: `path` itself unless it is a folder, the others of a
/// set of WAMIT or VERES, and what belongs to a run of NEMOH or HAMS. Looks at names only.
std::vector<std::filesystem::path> files_behind(const std::filesystem::path& path);

}  // namespace hydro::potential
