/// \file  include = "fit.toml": numbers of another file, under the name of that file.
#include <fmt/format.h>

#include <functional>
#include <map>

#include "hydro/io/atomic_file.hpp"
#include "scene/build.hpp"

namespace froude::scene {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;

/// [coefficients] of one file as "fit.cd" → 1.19, or "decay.damping" → "0.002 kg/s".
void read_coefficients(const Node& name, const fs::path& scene, std::map<std::string, Node>& out) {
  if (!name.is(Node::Type::text))
    throw InputError(fmt::format("include holds {}; a file is needed", type_name(name.type)), name.place,
                     "write include = \"fit.toml\"");
  const fs::path path = beside(scene, name.text);
  std::error_code unknown;
  if (!fs::is_regular_file(path, unknown))
    throw InputError(fmt::format("include = \"{}\" is no file", name.text), name.place,
                     fmt::format("looked for {}", path.string()));
  const Node file = parse_document(hydro::io::read_text(path), path.string());
  const auto* table = file.find("coefficients");
  if (table == nullptr || !table->value.is(Node::Type::table))
    throw InputError(fmt::format("include = \"{}\" holds no table [coefficients]", name.text), name.place,
                     "a fit of one run, or with a law over all, writes it: froude fit scene.toml -o fit.toml");
  for (const auto& entry : table->value.entries) {
    if (!entry.value.is(Node::Type::number) && !entry.value.is(Node::Type::integer) &&
        !entry.value.is(Node::Type::text))
      throw InputError(
          fmt::format("[coefficients] {} is {}; a number is needed", entry.key, type_name(entry.value.type)),
          entry.value.place);
    out[path.stem().string() + "." + entry.key] = entry.value;
  }
}

void replace(Node& node, const std::map<std::string, Node>& numbers) {
  for (auto& item : node.items) replace(item, numbers);
  for (auto& entry : node.entries) replace(entry.value, numbers);
  if (!node.is(Node::Type::text)) return;
  if (const auto found = numbers.find(node.text); found != numbers.end()) {
    node.type = found->second.is(Node::Type::text) ? Node::Type::text : Node::Type::number;
    node.number = found->second.number;
    node.text = found->second.text;
    node.raw = found->second.raw;
    return;
  }
  // "fit.cb": of an included file, but not in it.
  for (const auto& [known, value] : numbers) {
    const std::string file = known.substr(0, known.find('.') + 1);
    if (!node.text.starts_with(file) || node.text.find_first_of(" /*", file.size()) != std::string::npos) continue;
    if (node.text.substr(file.size()) == "toml") continue;  // the name of the file itself
    std::vector<std::string> all;
    for (const auto& [name, unused] : numbers) all.push_back(name);
    const std::string near = hydro::nearest(node.text, all);
    throw InputError(fmt::format("\"{}\" is not among the coefficients of the included file", node.text), node.place,
                     near.empty() ? "" : fmt::format("did you mean \"{}\"?", near));
  }
}

}  // namespace

void resolve_includes(Node& root, const fs::path& scene) {
  const auto* include = root.find("include");
  if (include == nullptr) return;
  std::map<std::string, Node> numbers;
  if (include->value.is(Node::Type::list)) {
    for (const Node& item : include->value.items) read_coefficients(item, scene, numbers);
  } else {
    read_coefficients(include->value, scene, numbers);
  }
  for (auto& entry : root.entries)
    if (entry.key != "include") replace(entry.value, numbers);
}

}  // namespace froude::scene
