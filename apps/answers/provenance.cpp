#include "answers/provenance.hpp"

#include <fmt/format.h>

namespace froude {

Provenance provenance_of(const scene::Scene& scene) {
  Provenance p;
  p.scene_file = scene.file.filename().string();
  p.scene_text = scene.text;
  if (scene.uncompressed) p.packing = hydro::io::Packing::none;
  for (const auto& e : scene.echo) p.settings.emplace_back(e.key, e.value + (e.defaulted ? " (default)" : ""));
  if (scene.waves)
    if (const auto* sea = std::get_if<scene::RandomSea>(&scene.waves->kind))
      p.seeds.emplace_back("waves", static_cast<double>(sea->seed));
  return p;
}

void add_notes(const std::vector<std::string>& notes, Provenance& provenance, const std::string& kind) {
  for (std::size_t i = 0; i < notes.size(); ++i)
    provenance.notes.emplace_back(fmt::format("{}{}", kind, i + 1), notes[i]);
}

}  // namespace froude
