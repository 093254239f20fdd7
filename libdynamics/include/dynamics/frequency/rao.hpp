#pragma once
/// \file  Response amplitude operators of coupled bodies, linear, in the frequency domain.
#include <Eigen/Core>

#include <optional>
#include <vector>

#include "dynamics/force/drag.hpp"
#include "dynamics/frequency/small_motions.hpp"
#include "hydro/potential/operations/operations.hpp"

namespace dynamics::frequency {

/// Bodies of a model that share a set of coefficients, about their centres of gravity and in the model's global frame.
struct PotentialGroup {
  std::vector<int> bodies;
  hydro::potential::FrequencyTable table;
  bool radiation, excitation;  ///< which effects the scene named
};

/// Linear drag on pieces of members at rest, one coefficient each at every frequency; made by linearised_drag(). (Q5)
struct LinearDrag {
  std::vector<DragPiece> pieces;
  Eigen::MatrixXcd velocity;    ///< of the undisturbed water, m/s per metre of wave, (3 pieces, Nω)
  Eigen::MatrixXd coefficient;  ///< (pieces, Nω), N s/m

  /// What the water's motion exerts, (modes), N and N m per metre.
  Eigen::VectorXcd excitation(Eigen::Index w, Eigen::Index modes) const;
};

/// Complex amplitude of every body's displacement about its centre of gravity per metre of wave amplitude, (6N, Nω),
/// m/m and rad/m, Re(ξ e^{iωt}) against a wave of zero phase at the global origin.
///
/// Solves (Q1) at each frequency: [−ω²(M + A(ω)) + iω(B(ω) + D) + K] ξ = X(ω, β), K and D from every force of the model
/// that is linear at rest, about where the bodies are still, in the motions that joints leave (D17). Modes that are not
/// free stay zero. Several headings and threads: amplitudes.hpp. Error: round-off, plus what
/// FrequencyTable::interpolation_error() says of the data. `drag`: made for the same frequencies, or none. \throws
/// hydro::InputError outside the data, hydro::NumericsError naming the frequency if the matrix is singular
Eigen::MatrixXcd response_amplitudes(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                                     const std::vector<double>& omega, double heading,
                                     const LinearDrag* drag = nullptr);

/// The matrix of (Q1) at one frequency, (6N, 6N).
Eigen::MatrixXcd impedance(const SmallMotions& about, const std::vector<PotentialGroup>& groups, double omega);

/// The right-hand side of (Q1), (6N): potential flow and the inertia of members.
Eigen::VectorXcd excitation(const SmallMotions& about, const std::vector<PotentialGroup>& groups, double omega,
                            double heading);

}  // namespace dynamics::frequency
