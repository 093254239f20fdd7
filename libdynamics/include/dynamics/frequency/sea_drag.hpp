#pragma once
/// \file  Drag in responses to a random sea: linear, losing on average as much power as quadratic drag. (D143)
#include <Eigen/Core>

#include <vector>

#include "dynamics/force/drag.hpp"
#include "dynamics/frequency/rao.hpp"
#include "dynamics/state/signal.hpp"

namespace dynamics::frequency {

/// β = ⟨|w|³⟩/⟨|w|²⟩, m/s, of a Gaussian velocity w whose components along its two principal axes have these standard
/// deviations, m/s: drag F = c β w loses on average what c |w| w loses. √(8/π) σ along a line, (3/2)√(π/2) σ where both
/// are the same. Error: below 1e-5. (D143)
double power_equivalent_speed(double sigma_major, double sigma_minor);

/// A sea cut into components.
struct DragSea {
  hydro::Water water;
  std::vector<double> heading;  ///< rad
  Eigen::MatrixXd variance;     ///< of the elevation that each component stands for, m², (headings, Nω)
  /// Of each piece, along global axes, (m/s)²: the covariance of velocities beside those that these components make, as
  /// of slow drift; empty: none. (D151)
  std::vector<Eigen::Matrix3d> slow = {};
};

/// Of every piece, the same at all frequencies and headings of its sea.
struct SeaDrag {
  Eigen::VectorXd coefficient;  ///< c β, N s/m
  Eigen::MatrixX2d sigma;       ///< of the relative velocity that a piece feels, larger and smaller, m/s
  int iterations = 0;           ///< solutions of (Q1) at all frequencies
  double residual = 0;          ///< largest change that one more would make, of the largest coefficient
};

/// (D143): coefficients which are those of their own responses, by a fixed point accelerated with the secants of the
/// last turns (Anderson's method). `pieces` without current; `start`: coefficients near it, or none. Cost: one
/// factorisation a frequency and turn. \throws hydro::NumericsError where 100 turns do not settle them to 1e-6, or
/// where no response exists
SeaDrag drag_in_sea(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                    const std::vector<double>& omega, const std::vector<DragPiece>& pieces, const DragSea& sea,
                    const Eigen::VectorXd& start = {});

/// These coefficients, (pieces), N s/m, for waves of one heading, rad, at any frequencies, rad/s.
LinearDrag drag_with(const Eigen::VectorXd& coefficient, const SmallMotions& about, const std::vector<double>& omega,
                     const std::vector<DragPiece>& pieces, const hydro::Water& water, double heading);

/// These coefficients in answers to other loads than waves', at whatever frequency: one column of coefficients.
LinearDrag still_water_drag(const Eigen::VectorXd& coefficient, const SmallMotions& about,
                            const std::vector<DragPiece>& pieces);

/// Velocities of pieces by the motions of bodies, three a piece: along two axes across it, or the one along it,
/// and half way between, whose variances give the covariance.
std::vector<Variation> velocities_across(const SmallMotions& about, const std::vector<DragPiece>& pieces);
/// That of each piece, along global axes, by their variances, (m/s)².
std::vector<Eigen::Matrix3d> covariances_across(const SmallMotions& about, const std::vector<DragPiece>& pieces,
                                                const Eigen::VectorXd& variance);

}  // namespace dynamics::frequency
