#pragma once
/// \file  Free motions of coupled bodies about where they are still: eigenperiods, damping and shapes, with the added
/// mass and damping
///        of each motion's own frequency. Equations (Q2)-(Q4), docs/theory/frequency.md.
#include <Eigen/Core>

#include <optional>
#include <vector>

#include "dynamics/frequency/rao.hpp"

namespace dynamics::frequency {

/// The motion that radiation damping and linear dampers leave of an undamped mode, Re(shape e^{st}).
struct DampedMode {
  std::complex<double> s;  ///< 1/s; Im s > 0
  Eigen::VectorXcd shape;  ///< (6N), as Mode::shape

  double damping_ratio() const { return -s.real() / std::abs(s); }  ///< ζ; negative for a motion that grows
};

struct Mode {
  double omega;           ///< undamped, rad/s
  Eigen::VectorXd shape;  ///< (6N) displacements about the centres of gravity, m and rad, the largest number 1 after
                          ///< rotations are multiplied by the body's radius of gyration; that number is positive
  bool outside_data;      ///< ω lies outside a table of coefficients, and A and B of the table's nearest end were used
  std::optional<DampedMode>
      damped;  ///< empty if no swinging motion is like this mode: it creeps back, or radiation leaves nothing of it

  /// Share of the bodies' kinetic energy in each of the 6N motions; sum 1. The water's share is not counted.
  Eigen::VectorXd energy_share(const SmallMotions& about) const;
};

struct ModeList {
  std::vector<Mode> modes;                ///< by rising frequency
  std::vector<Eigen::VectorXd> adrift;    ///< shapes that nothing restores, to 1e-9 of what restores the stiffest
  std::vector<Eigen::VectorXd> toppling;  ///< shapes with negative stiffness: rest is no stable equilibrium
  std::vector<double> indefinite_at;  ///< rad/s of the data where M + A is not positive definite, as near a resonance
                                      ///< of water between bodies
};

/// All free motions about where the bodies are still: det(K − ω²(M + A(ω))) = 0 (Q2), every root above 1e-6 rad/s for
/// which an eigenvalue of that matrix changes sign between two frequencies of the tables, and then (Q3) from each root.
///
/// Undamped frequencies: to round-off of the stiffest motion, ω² ± 1e-15 ω_max², beside the error of interpolating the
/// table. The damping ratio takes A and B at the damped frequency as for a steady oscillation; what that neglects is of
/// order ζ² (Q4). Cost O((6N)³) for each frequency of the table.
ModeList free_motions(const SmallMotions& about, const std::vector<PotentialGroup>& groups);

/// ModeList::toppling alone: sparse factors of the stiffness, and the cost of free_motions() only where something does.
std::vector<Eigen::VectorXd> toppling_motions(const SmallMotions& about);

}  // namespace dynamics::frequency
