#include "compile/computed.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace froude::compile {
namespace {

/// So far apart that straight lines between them miss little: as of data that ask for it (`turning`).
constexpr double spacing_deg = 5;

/// Where the waves of a system go: along its heading, or, with spreading, all round the circle.
void add_headings(const scene::WaveSystem& system, std::vector<double>& headings) {
  const double mean = system.heading.radians();
  headings.push_back(mean);
  if (!system.spreading) return;
  for (double beside = spacing_deg; beside < 360; beside += spacing_deg)
    headings.push_back(std::remainder(mean + hydro::Angle::from_degrees(beside).radians(), 2 * std::numbers::pi));
}

}  // namespace

std::vector<double> headings_asked(const scene::Scene& scene) {
  std::vector<double> headings;
  if (scene.rao) headings = scene.rao->headings;
  if (scene.field) headings.push_back(scene.field->heading);
  if (scene.waves) headings.push_back(scene.waves->heading.radians());
  if (scene.waves)
    if (const auto* sea = std::get_if<scene::RandomSea>(&scene.waves->kind))
      for (const scene::WaveSystem& system : sea->systems) add_headings(system, headings);
  std::sort(headings.begin(), headings.end());
  const auto same = [](double a, double b) { return b - a < 1e-9; };
  headings.erase(std::unique(headings.begin(), headings.end(), same), headings.end());
  return headings;
}

}  // namespace froude::compile
