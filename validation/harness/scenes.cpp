#include "harness/scenes.hpp"

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::validation {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace

scene::Scene read_scene(const Folders& folders, const std::string& needs, const std::string& from,
                        const std::string& to, const std::string& name) {
  const std::string found = folders.shared(needs).string();
  const auto file = folders.own() / name;
  std::string text =
      replaced(hydro::io::read_text(file), "../../../shared/data/", found.substr(0, found.size() - needs.size()));
  if (!from.empty()) {
    hydro::ensure(text.find(from) != std::string::npos, "read_scene: the text to replace is not in the scene");
    text = replaced(std::move(text), from, to);
  }
  return scene::parse(text, file);
}

}  // namespace froude::validation
