#pragma once
/// \file  Lines by SUNDIALS' CVODE, as an outside reference. Only in builds configured with FROUDE_SUNDIALS.
#include "dynamics/line/stepper.hpp"

namespace dynamics::line {

/// Takes `state` on by `duration` seconds by backward differences of variable order, the local errors of places within
/// `tolerance` metres and of velocities within as many metres a second. Lengths that are kept drift with these errors;
/// nothing puts them right. The matrices are dense, so it is for some hundred nodes. Accelerations are those of
/// Stepper::balance(). \throws hydro::InputError unless the tolerance is positive; hydro::NumericsError where CVODE
/// gives up
void run_by_sundials(const Line& line, State& state, double duration, double tolerance);

}  // namespace dynamics::line
