#pragma once
/// \file  What the doctor finds in coefficients, as far as a scene uses them.
#include <array>
#include <span>
#include <vector>

#include "hydro/potential/doctor/check.hpp"

namespace froude::compile {

/// What a scene takes of coefficients.
struct TakenCoefficients {
  std::vector<int> bodies;                 ///< of the file, from 0
  std::vector<std::array<bool, 6>> modes;  ///< of each of them, those whose A, B and X have an effect
  bool radiation = true;                   ///< A and B are used
};

/// The findings of hydro::potential::check(). An error that lies in bodies or modes that are not taken gives place to
/// what the same check finds in those that are: each check tells its worst finding only.
std::vector<hydro::potential::Finding> findings_in(const hydro::potential::Coefficients& c,
                                                   const TakenCoefficients& taken);

}  // namespace froude::compile
