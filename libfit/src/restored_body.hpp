#pragma once
/// \file  Checks of a body that is brought back, and coefficients with two kinds of error; private to libfit.
#include <cmath>
#include <string>

#include "fit/forced_radiation.hpp"
#include "hydro/base/error.hpp"
#include "hydro/signal/distributions.hpp"

namespace fit {

inline void check(const RestoredBody& body) {
  hydro::require(body.mass >= 0 && std::isfinite(body.mass), "a mass must not be negative, got {}", body.mass);
  hydro::require(body.stiffness >= 0 && std::isfinite(body.stiffness), "a stiffness must not be negative, got {}",
                 body.stiffness);
  hydro::require(body.mass_error >= 0 && body.stiffness_error >= 0, "uncertainties must not be negative, got {} and {}",
                 body.mass_error, body.stiffness_error);
}

/// Student's t of the scatter and the normal quantile of what is the same throughout, in one half width (F26).
inline Coefficient with_parts(const std::string& name, double value, double scatter, double t, double systematic,
                              double confidence) {
  Coefficient c;
  c.name = name;
  c.value = value;
  c.systematic_error = systematic;
  c.standard_error = std::hypot(scatter, systematic);
  const double half = std::hypot(t * scatter, hydro::signal::normal_quantile((1 + confidence) / 2) * systematic);
  c.interval = {value - half, value + half};
  c.white_interval = c.interval;
  return c;
}

/// A coefficient that may as well be zero is not told.
Coefficient judged(Coefficient c);

}  // namespace fit
