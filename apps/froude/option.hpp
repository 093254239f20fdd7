#pragma once
/// \file  An option of the command line that has a unit.
#include <string>

#include "hydro/base/units.hpp"
#include "scene/placed.hpp"

namespace froude {

/// Its value in SI. \throws hydro::InputError at the option
inline double option_si(const std::string& option, const std::string& text, const hydro::Dimension& needed) {
  return scene::placed({.file = option}, [&] { return hydro::parse_si(text, needed); });
}

}  // namespace froude
