#pragma once
/// \file  Private to compile/: gravity and buoyancy of bodies whose restoring matrix is known.
#include <vector>

#include "compile/compile.hpp"
#include "hydro/potential/coefficients.hpp"

namespace froude::compile {

/// Gravity's part of the restoring matrix about the reference point, for a weight W at `c` from it (P12).
hydro::potential::Matrix6 gravity_restoring(double weight, const Eigen::Vector3d& c);
/// True if a joint holds the body.
bool is_jointed(const scene::Scene& scene, int body);
/// Buoyancy less weight at rest: zero for a body that floats by itself; joints carry it where it hangs on others.
/// \throws InputError if it hangs on others and nobody says what it displaces
double lift(const scene::Scene& scene, int body, const hydro::potential::BodyData& facts);
/// Adds what still water does to `bodies`, of coefficients about their centres of gravity. \throws hydro::InputError
/// for data without a restoring matrix, or one with stiffness that still water has not
void add_hydrostatics(const scene::Scene& scene, const hydro::potential::Coefficients& about_centres,
                      const std::vector<int>& bodies, Prepared& prepared);

}  // namespace froude::compile
