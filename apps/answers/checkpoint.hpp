#pragma once
/// \file  What a run leaves on disk on its way, so that whoever kills it loses little. Decision 0033. Private to apps.
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "answers/interruption.hpp"
#include "scene/scene.hpp"

namespace froude {

/// The checkpoints of one result: a folder beside it, with a file for each run that the result takes, those that tell
/// its error among them. Each file is put on disk whole and says by what scene, files and program it was made; threads
/// may keep runs of different names.
class Checkpoints {
 public:
  /// Looks at what is there. `data`: the files that the scene reads. \throws hydro::InputError naming a file that is
  /// damaged, or that another scene, other data or another version has made
  Checkpoints(std::filesystem::path folder, const scene::Scene& scene, const std::vector<std::filesystem::path>& data);

  /// The state that a run was left in; nothing if none is kept.
  std::optional<std::string> find(const std::string& run) const;
  /// \throws hydro::InputError if it cannot be written
  void keep(const std::string& run, const std::string& state) const;
  /// The damage of a file whose numbers are not those of the run. \throws hydro::InputError always
  [[noreturn]] void refuse(const std::string& run) const;
  /// The result is written: nobody needs them any more.
  void remove() const;
  /// Of the runs, those that have gone on from here.
  void went_on(const std::string& run, double time_s);
  std::vector<std::string> sentences() const;

 private:
  std::filesystem::path file_of(const std::string& run) const;
  std::string state_in(const std::filesystem::path& file) const;

  std::filesystem::path folder_;
  std::string made_by_;  // lines that begin each file
  mutable std::mutex mutex_;
  std::vector<std::string> sentences_;
};

/// One run among them; without checkpoints only the instants are those of them. What is computed is kept as well where
/// a signal ends it.
struct KeptRun {
  Checkpoints* in = nullptr;
  std::string name = {};
  const Interruption* interruption = nullptr;
};

}  // namespace froude
