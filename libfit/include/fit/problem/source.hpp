#pragma once
/// \file  Where a run of a fit comes from.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace fit {

struct Source {
  std::filesystem::path file;                                    ///< errors of the run begin with it
  std::vector<std::pair<std::string, std::string>> labels = {};  ///< carried along: "day", "Monday"
  std::string name() const { return file.filename().string(); }  ///< of the run in reports
};

}  // namespace fit
