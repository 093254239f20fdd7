#pragma once
/// \file  What bodies have alike whose coefficients the program computes: of cylinders and of hulls.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "hydro/base/error.hpp"
#include "scene/scene.hpp"

namespace froude::compile {

/// Bodies of the scene whose [body.hydrodynamics] is such a one, in its order.
template <class Is>
std::vector<int> bodies_where(const scene::Scene& scene, const Is& is) {
  std::vector<int> bodies;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (scene.bodies[b].hydrodynamics && is(*scene.bodies[b].hydrodynamics)) bodies.push_back(static_cast<int>(b));
  return bodies;
}

inline const scene::Hydrodynamics& hydrodynamics_of(const scene::Scene& scene, int body) {
  return *scene.bodies[static_cast<std::size_t>(body)].hydrodynamics;
}

/// Where waves go in this scene, each heading once: those that differ by the rounding of a unit are one.
std::vector<double> headings_asked(const scene::Scene& scene);

/// What solving takes, in words, of which nothing is left to do where it is kept.
inline std::string left_to_do(const std::string& size, bool kept) {
  return kept ? size + ", none of which is to be done again" : size;
}

/// "39 frequencies", or those that are solved first and about how many there will be.
inline std::string frequencies_in_words(std::size_t stated, int expected) {
  if (static_cast<int>(stated) == expected) return fmt::format("{} frequencies", stated);
  return fmt::format("{} frequencies and more where they are needed, about {} in all", stated, expected);
}

/// Bodies that are solved together have one table. \throws hydro::InputError at the second if theirs differ
template <class Table>
void require_same_table(const std::string& kind, const Table& first, const Table& other, const hydro::Place& place) {
  if (other.omega != first.omega || other.headings != first.headings ||
      other.frequency_tolerance != first.frequency_tolerance)
    throw hydro::InputError(fmt::format("bodies of {} state different frequencies or headings", kind), place,
                            "they are solved together: give all the same");
}

}  // namespace froude::compile
