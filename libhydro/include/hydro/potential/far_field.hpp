#pragma once
/// \file  Waves far from bodies in a regular wave, and what they tell of power and mean drift. (P38), (P39) in
/// docs/theory/conventions.md.
#include <Eigen/Core>

#include <complex>
#include <vector>

#include "hydro/base/types.hpp"

namespace hydro::potential {

/// What bodies add to the surface far away, per metre of wave amplitude:
///   η → A(θ) √(2/(πkr)) e^{−i(kr − π/4)}
/// in polar coordinates r, θ about the global origin. Angles are evenly spaced over a whole turn from the heading on,
/// so many that sums over them are integrals to rounding.
struct FarField {
  std::vector<double> angle;   ///< rad; the first is the heading
  Eigen::VectorXcd scattered;  ///< A, m/m, of bodies held still
  Eigen::VectorXcd radiated;   ///< of their motion
};

/// To second order, per m² of wave amplitude.
struct MeanDrift {
  Eigen::Vector2d force;  ///< N/m², mean horizontal force of the waves on all bodies together, along x and y
  double taken;           ///< W/m², mean power that the bodies take from the waves; negative: they make waves
  double scattered;       ///< W/m², mean power of the waves that they add
};

/// From what the incident wave loses and what the added waves carry away (Maruo 1960, Newman 1967; (P39)). Of `far`:
/// what is scattered and radiated, or of bodies held still what is scattered.
/// \throws InputError unless omega is finite and positive
MeanDrift mean_drift(const FarField& far, double omega, const Water& water, bool held = false);

/// So many angles that the square of a far field of waves number `k` from within a circle of radius `extent` is summed
/// to rounding, `orders` more than that: the trapezium rule of a periodic function that holds its harmonics. A multiple
/// of four: quarter turns and mirrors bring them onto each other.
std::vector<double> angles_around(double heading, double k, double extent, int orders);

}  // namespace hydro::potential
