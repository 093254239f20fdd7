#pragma once
/// \file  Private to compile/: radiation of one group of bodies in a run.
#include "compile/compile.hpp"
#include "dynamics/force/wave_loads.hpp"

namespace froude::compile {

/// Added mass on the left, the memory that goes with it, and what the plan says: the method that runs, then the
/// alternatives with their errors and costs.
struct RadiationParts {
  dynamics::AddedMass added_mass;
  dynamics::RadiationMemory memory;
  std::vector<PlanLine> lines;
};

/// Of group `group` of `prepared`, at the run's step. `sea`: null in calm water.
/// \throws hydro::InputError if constant coefficients are asked for in anything but one regular wave
RadiationParts radiation(const Prepared& prepared, std::size_t group, double step, const hydro::waves::Sea* sea,
                         std::vector<std::string>& notes);

}  // namespace froude::compile
