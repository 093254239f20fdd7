#include <fmt/format.h>

#include <algorithm>

#include "scene/scene.hpp"

namespace froude::scene {

bool matches(std::string_view pattern, std::string_view name) {
  // Greedy with one point to come back to: linear in practice, and no deep recursion on many stars.
  std::size_t p = 0, n = 0, star = std::string_view::npos, resume = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p, ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++resume;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

hydro::InputError no_signal(const std::string& name, const Place& place, const std::vector<std::string>& known) {
  const std::string near = hydro::nearest(name, known);
  return hydro::InputError(fmt::format("no signal is called \"{}\"", name), place,
                           near.empty() ? "signals are called like m1.surge, connector1.force, wave.elevation"
                                        : fmt::format("did you mean \"{}\"?", near));
}

void check_patterns(const std::vector<std::string>& of, const std::vector<Place>& places,
                    const std::vector<std::string>& known) {
  for (std::size_t i = 0; i < of.size(); ++i) {
    const auto fits = [&](const std::string& name) { return matches(of[i], name); };
    if (std::none_of(known.begin(), known.end(), fits))
      throw no_signal(of[i], i < places.size() ? places[i] : Place{}, known);
  }
}

void check_patterns(const Scene& scene, const std::vector<std::string>& known) {
  if (scene.rao) check_patterns(scene.rao->of, scene.rao->of_places, known);
  if (scene.run) check_patterns(scene.run->of, scene.run->of_places, known);
}

}  // namespace froude::scene
