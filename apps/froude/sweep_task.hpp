#pragma once
/// \file  A study as a sweep takes it up: its cases, the files that they read, and the folder that they are kept in.
#include <string>
#include <vector>

#include "froude/outputs.hpp"
#include "sweep/cases.hpp"
#include "sweep/store.hpp"

namespace froude {

struct SweepTask {
  /// \throws hydro::InputError as read_study() and Cases
  explicit SweepTask(const Path& file);
  SweepTask(const SweepTask&) = delete;  // the cases refer to the study
  SweepTask& operator=(const SweepTask&) = delete;

  sweep::Identity identity() const;
  /// Makes the folder. \throws hydro::InputError where that fails, or what is written there would replace what is read
  void require_folder(const Path& folder) const;

  sweep::Study study;
  std::vector<NamedFile> inputs;  ///< the scene, what it names, the study
  sweep::Cases cases;

 private:
  std::string scene_text() const;
};

}  // namespace froude
