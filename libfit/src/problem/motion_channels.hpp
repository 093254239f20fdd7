#pragma once
/// \file  What may be wrong with the record of a motion that no fit explains. Private to libfit.
#include <string>

#include "fit/problem/motion.hpp"

namespace fit::motion {

/// "x1 and x2 are exchanged: with each in the other's place …"; "x1 has the wrong sign: …"; "x1 is recorded 0.12 s
/// late: …". Said where with that put right the search ends at residuals that the deviations allow (F77). Empty:
/// nothing of the kind explains it. `failed` is the fit of `search` that was refused.
std::string trouble_of_channels(const Problem& problem, const SimulationProblem& search, const SimulationFit& failed);

}  // namespace fit::motion
