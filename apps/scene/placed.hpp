#pragma once
/// \file  Where something is wrong, told by who knows: a function that reads a value knows the rule, its caller the
/// place.
#include <concepts>

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

/// The same where finding the place is work, which only an error asks for: the line of a table is read again.
template <std::invocable PlaceOf, class Make>
auto placed(const PlaceOf& place_of, Make make) -> decltype(make()) {
  try {
    return make();
  } catch (const hydro::InputError& e) {
    throw e.at(place_of());
  }
}

}  // namespace froude::scene
