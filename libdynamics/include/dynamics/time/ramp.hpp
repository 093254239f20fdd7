#pragma once
/// \file  A beginning without a jump: what acts from the start of a run on grows from nothing. (D6)

namespace dynamics {

/// r(t) of (D6): from 0 at t = 0 to 1 at `over_s` by a half cosine; 1 throughout where over_s is 0.
struct Ramp {
  double value, rate, bend;  ///< r, dr/dt in 1/s, d²r/dt² in 1/s²
};
Ramp ramp(double t_s, double over_s);

}  // namespace dynamics
