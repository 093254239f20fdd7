#pragma once
/// \file  The start of a run in which lines have ends on bodies. (D91)
#include "dynamics/integrate/integrator.hpp"

namespace dynamics {

/// Starts a run: as Integrator::start(), with accelerations of bodies and lines that belong together (D91).
void start_with_lines(Integrator& integrator, Workspace& workspace);

}  // namespace dynamics
