#pragma once
/// \file  Where a network of lines hangs, from nothing but its loads and what holds it. (D112)
#include "dynamics/line/line.hpp"

namespace dynamics::line {

/// The rest of `line` under constant loads, to 1e-6 of its lengths where every segment pulls, and floats as if all
/// under water; without its bed. Held nodes stand in `places`; of the others nothing is asked. O(nodes) for trees.
/// \throws hydro::InputError if nothing holds a part of it, or if inextensible lines do not reach
State network_shape(const Line& line, const State& places);

}  // namespace dynamics::line
