#pragma once
/// \file  Where something is wrong, told by who knows: a function that reads a value knows the rule, its caller the
/// place.
#include "hydro/base/error.hpp"

namespace froude::scene {

/// What `make` returns; what it throws without a place of its own gets this one: a value of the scene, a file, an
/// option such as {.file = "--level"}.
template <class Make>
auto placed(const hydro::Place& place, Make make) -> decltype(make()) {
  try {
    return make();
  } catch (const hydro::InputError& e) {
    throw e.at(place);
  }
}

}  // namespace froude::scene
