#pragma once
/// \file  Keys of the six motions of a body. Private to apps/scene.
#include "hydro/base/types.hpp"
#include "scene/schema.hpp"

namespace froude::scene {

inline bool rotates(std::size_t mode) { return hydro::is_rotation(static_cast<hydro::Mode>(mode)); }

/// A table in which each key names one thing that acts, so an empty one is a slip.
inline Table at_least_one_of(std::string title, std::string meaning, std::vector<Key> keys) {
  std::vector<std::string> names;
  for (const Key& key : keys) names.push_back(key.name);
  return {.title = std::move(title),
          .meaning = std::move(meaning),
          .keys = std::move(keys),
          .groups = {{Group::Count::at_least_one, names}}};
}

}  // namespace froude::scene
