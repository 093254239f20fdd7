#pragma once
/// \file  Prescribed motions: what Joint::prescribed may be. (D31)
#include <vector>

#include "dynamics/joint/joint.hpp"

namespace dynamics {

/// a sin(ωt), grown from nothing by half a cosine over `ramp_s`. \throws hydro::InputError unless ω > 0 and ramp ≥ 0
PrescribedMotion prescribed_harmonic(double amplitude, double omega, double ramp_s);

/// The natural cubic spline through values at increasing times; before the first and after the last it stays.
/// \throws hydro::InputError for fewer than two values, times that do not increase, or values that are not finite
PrescribedMotion prescribed_through(std::vector<double> time_s, const std::vector<double>& coordinate);

/// The same counted the other way.
PrescribedMotion reversed(PrescribedMotion motion);

}  // namespace dynamics
