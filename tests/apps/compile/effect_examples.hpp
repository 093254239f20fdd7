#pragma once
// A small scene for every table, kind and effect of the grammar, and which kinds of force it is to have.
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace effects {

struct Example {
  std::string name;
  std::string text;                ///< of the scene, which lasts forty steps
  std::vector<std::string> kinds;  ///< of force that the scene names, and no other
  std::size_t lines = 0;           ///< systems of lines
};

/// A scene that names no effect: a body alone.
Example without_effects();
const std::vector<Example>& examples();
/// What responses tell and runs do not.
Example of_responses_alone();
/// What examples do not show of friction and contacts, which begin there at rest and apart: a module that slips on a
/// slider, that stands on a plane, that slips on it; and many modules, one of which friction holds.
std::vector<Example> held_by_laws();

/// Where the examples find their files: coefficients, and tables that are written there.
class Files {
 public:
  Files();
  ~Files();
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
  std::filesystem::path scene() const { return folder_ / "scene.toml"; }

 private:
  std::filesystem::path folder_;
};

}  // namespace effects
