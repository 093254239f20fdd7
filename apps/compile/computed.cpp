#include "compile/computed.hpp"

#include <algorithm>

namespace froude::compile {

std::vector<double> headings_asked(const scene::Scene& scene) {
  std::vector<double> headings;
  if (scene.rao) headings = scene.rao->headings;
  if (scene.field) headings.push_back(scene.field->heading);
  if (scene.waves) headings.push_back(scene.waves->heading.radians());
  if (scene.waves)
    if (const auto* sea = std::get_if<scene::RandomSea>(&scene.waves->kind))
      for (const scene::WaveSystem& system : sea->systems) headings.push_back(system.heading.radians());
  std::sort(headings.begin(), headings.end());
  const auto same = [](double a, double b) { return b - a < 1e-9; };
  headings.erase(std::unique(headings.begin(), headings.end(), same), headings.end());
  return headings;
}

}  // namespace froude::compile
