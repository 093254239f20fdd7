#pragma once
/// \file  Lines at rest: the closed-form discrete catenary, and rest under any loads. (D85), (D86)
#include "dynamics/line/line.hpp"

namespace dynamics::line {

/// How each span between held nodes hangs under constant loads (weight, lasting buoyancy, given forces) alone, and what
/// is beyond the last held node: the discrete catenary (D85), exact for inextensible segments and for
/// springs. Held nodes stand in `places` where they are; its other nodes are not looked at. Where a segment would have
/// to be pressed (ends closer than it), the shape is near and not exact: equilibrium() goes on from there. Of a
/// network, or a line with a float, it is near too, and free nodes need no place to begin at (D112). \throws
/// hydro::InputError if a span that cannot stretch is shorter than the way between its ends, saying by how much, or if
/// nothing holds it
State hanging_shape(const Line& line, const State& places);

/// What rest took.
struct RestReport {
  int steps = 0, newton_iterations = 0;
};

/// Rest under all loads at the time of `guess` with velocities zero: steps of steepest descent made implicit, longer
/// and longer, then Newton (D86). `guess` has its held nodes in place and its lengths kept or nearly so. A shape that
/// would fall over or buckle is none: from there the line is let down to one that stays (D157). \throws
/// hydro::NumericsError saying why there is none, and which node is worst
State equilibrium(const Line& line, const State& guess, RestReport* report = nullptr);

/// What the held nodes `prescribed` need at rest; by places it follows the static stiffness of the line, by velocities
/// not at all (D90). `rest` is an equilibrium().
Response pulls_at_rest(const Line& line, const State& rest, const std::vector<int>& prescribed);

}  // namespace dynamics::line
