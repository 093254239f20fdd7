#pragma once
/// \file  The principal-value integral of waves in infinitely deep water, without dimension. (G4) to (G6) in
/// docs/theory/panels.md. Not installed.
#include "wave_bessel.hpp"

namespace hydro::panels {

/// F(X, Y) = ⨍₀^∞ e^{−tY} J₀(tX)/(t − 1) dt, X, Y >= 0, not both 0, and its slopes.
struct DeepWave {
  double F, F_X, F_Y;
};
/// From the table, or far away from the asymptotic series. Errors, ρ = √(X² + Y²): 2e-9 of 1 + |ln ρ| in F, 2e-9/min(ρ,
/// 1) in the slopes.
DeepWave deep_wave(double X, double Y);
/// The same where e^{−Y} and `J`, J₀(X) and J₁(X), are at hand: half of the time.
DeepWave deep_wave(double X, double Y, double decay, const BesselPair& J);

/// The same by quadrature, 1e-12, in microseconds: what the table is made of. X > 0.
DeepWave deep_wave_by_quadrature(double X, double Y);

}  // namespace hydro::panels
