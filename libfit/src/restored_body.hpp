#pragma once
/// \file  Checks of a body that is brought back, and coefficients with two kinds of error; private to libfit.
#include <cmath>

#include "fit/forced_radiation.hpp"
#include "fit/parts.hpp"
#include "hydro/base/error.hpp"

namespace fit {

inline void check(const RestoredBody& body) {
  hydro::require(body.mass >= 0 && std::isfinite(body.mass), "a mass must not be negative, got {}", body.mass);
  hydro::require(body.stiffness >= 0 && std::isfinite(body.stiffness), "a stiffness must not be negative, got {}",
                 body.stiffness);
  hydro::require(body.mass_error >= 0 && body.stiffness_error >= 0, "uncertainties must not be negative, got {} and {}",
                 body.mass_error, body.stiffness_error);
}

/// A coefficient that may as well be zero is not told.
Coefficient judged(Coefficient c);

}  // namespace fit
