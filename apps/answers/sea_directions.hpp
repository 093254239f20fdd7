#pragma once
/// \file  Private to apps: the directions that a random sea goes along, for responses in it. (Q8)
#include <cstddef>
#include <vector>

#include "scene/scene.hpp"

namespace froude {

/// The random sea of a scene. \throws hydro::InputError for a scene without waves, for waves that are no random sea,
/// and for one with a crest put in
const scene::RandomSea& random_sea(const scene::Scene& scene);

/// A heading of the sea and which share of a frequency's energy goes along it.
struct Direction {
  std::size_t heading;  // of all that responses are computed for
  double from, to;      // from the mean heading, rad: of the sector whose energy goes there
};

/// A wave system, its energy cut into sectors of equal energy at its peak.
struct System {
  const scene::WaveSystem* waves;
  std::vector<Direction> directions;

  double share(const Direction& d, double omega) const;
};

/// With this many sectors where there is spreading; headings that no other system has are put at the end of `headings`.
System system_of(const scene::WaveSystem& waves, int sectors, std::vector<double>& headings);

bool has_spreading(const scene::RandomSea& sea);

/// The frequencies that the scene cuts its spectrum to, rad/s; 0 and +∞ where it says nothing.
struct SeaBand {
  double low, high;
};
SeaBand band_of(const scene::RandomSea& sea);

/// The share of the sea's energy, as the scene cuts it, outside a band, rad/s.
double share_outside(const scene::RandomSea& sea, double low, double high);

}  // namespace froude
