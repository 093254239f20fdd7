#pragma once
/// \file  The course of a given load: it rises straight, acts in full, and falls straight or stops at once. (D150)
#include <limits>

namespace dynamics {

/// Times in s, with from + ramp_up <= until and ramps >= 0; as it is made, in full at all times.
struct LoadHistory {
  double from = 0;                                         ///< it begins to rise
  double ramp_up = 0;                                      ///< over so long; 0: it is there at once
  double until = std::numeric_limits<double>::infinity();  ///< it begins to fall
  double ramp_down = 0;                                    ///< over so long; 0: it stops at once

  /// Which of the five pieces between corners t lies in, 0 … 4; a corner belongs to the piece that begins there.
  int piece(double t) const;
  /// The share that acts at t by the straight piece in which `within` lies, which goes on beyond its corners: so a step
  /// from corner to corner sees the side of a jump that is its own.
  double share(double t, double within) const;
  double share(double t) const { return share(t, t); }
  /// The first corner after t; ∞: there is none.
  double next_corner(double t) const;
  /// What is asked of its times. NaN: false.
  bool is_ordered() const { return ramp_up >= 0 && ramp_down >= 0 && from + ramp_up <= until; }
  /// Acts in full from t = 0 on, and never ends.
  bool is_constant() const { return share(0) == 1 && until == std::numeric_limits<double>::infinity(); }
};

}  // namespace dynamics
