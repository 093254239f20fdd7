#pragma once
/// \file  The approximations of a scene, and the settings between which each can be moved. Private to apps.
#include <optional>
#include <string>
#include <vector>

#include "scene/edit.hpp"
#include "scene/scene.hpp"

namespace froude {

/// One setting of an approximation.
struct Rung {
  std::string approximation, setting;
  std::vector<scene::TextEdit> edits;
};

/// Settings that are compared with each other: one approximation, or several that exclude each other, such as step and
/// integrator.
struct Ladder {
  /// A setting taken for exact, and the next finest, which tells how exact.
  struct Reference {
    Rung finest, next;
  };
  std::vector<Rung> rungs = {};            ///< coarse ones first, where they can be told apart
  std::size_t own = 0;                     ///< the one that is the scene's
  std::vector<Reference> references = {};  ///< the best first; the first that has an answer is taken
  bool makes_coefficients = false;         ///< a setting has coefficients or fits of its own
};

struct Ladders {
  std::vector<Ladder> all;
  std::vector<std::string> notes;  ///< what has no ladder, and why
};

/// Of [ask.run], for a scene that is stepped with `step`, s, where it is left to itself.
Ladders ladders_of_run(const scene::Scene& scene, double step);
/// Of [ask.rao].
Ladders ladders_of_rao(const scene::Scene& scene);

/// Other numbers of components for a random sea, and a finest one; none for other waves.
struct ComponentsLadder {
  std::vector<Rung> rungs;
  Rung finest;
};
std::optional<ComponentsLadder> components_of_run(const scene::Scene& scene);

/// The same sea with another seed.
scene::TextEdit with_seed(const scene::Scene& scene, int number);

}  // namespace froude
