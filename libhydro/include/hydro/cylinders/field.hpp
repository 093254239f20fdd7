#pragma once
/// \file  The water's surface about vertical cylinders in a regular wave.
#include <vector>

#include "hydro/cylinders/solve.hpp"
#include "hydro/potential/wave_field.hpp"

namespace hydro::cylinders {

/// Elevations about `bodies` by the waves that each cylinder sends out, (C22). Nothing is told within the circle of a
/// cylinder, nor above one whose top is under water. Evanescent modes are taken as far as they reach the nearest point,
/// up to a number; `estimate` is six times what the last fifth of them adds, with the tolerance of `options` for the
/// rest. With `drift` that of each body by itself, (C24). Infinite depth as of solve(). \throws InputError as solve(),
/// as potential::check(), and for a radius of more than 20 wavelengths or so
potential::WaveField wave_field(const std::vector<CylinderBody>& bodies, const Water& water,
                                const potential::FieldQuestion& question, const Options& options = {});

}  // namespace hydro::cylinders
