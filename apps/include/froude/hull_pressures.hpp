#pragma once
/// \file  The water's pressure on hulls in one regular wave, as `[ask] field` with `pressure = true` gives it.
#include <string>
#include <vector>

#include "hydro/potential/hull_pressure.hpp"

namespace froude {

struct HullPressures {
  std::vector<std::string> bodies;  ///< names, by WetPanel::body
  hydro::potential::HullPressure on;
};

}  // namespace froude
