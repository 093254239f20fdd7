#pragma once
/// \file  How fast a model can move by itself: what a time step has to follow, waves or none.
#include "dynamics/model/model.hpp"

namespace dynamics::frequency {

struct FastestMotion {
  double omega = 0;  ///< rad/s
  int mode = 0;      ///< the one that moves most in it, by √mass
};

/// The fastest of the free motions about a state, where its velocities are left out: √|λ| of the largest eigenvalue of
/// (M + A∞)⁻¹ K in the motions that joints leave (Q6), |λ| also where rest topples. A body that its loads begin to turn
/// with the angular acceleration α, as a rod let go level, at which nothing restores it, is counted with √α.
///
/// K from every kind that is linear at rest. By iteration, which comes from below: within a per cent or two, far nearer
/// where the fastest motion stands alone. O(N) an iteration. \throws hydro::NumericsError if the masses cannot be
/// factored
FastestMotion fastest_motion(const Model& model, const State& about);

}  // namespace dynamics::frequency
