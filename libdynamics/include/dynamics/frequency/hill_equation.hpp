#pragma once
/// \file  One motion of a system while others are driven: Hill's equation, of which Mathieu's is the first harmonic.
/// (Q14), docs/theory/frequency.md.
#include <optional>

#include "dynamics/frequency/harmonic_balance.hpp"

namespace dynamics::frequency {

/// m(t) ẍ + c(t) ẋ + k(t) x = 0, each at rest + size × a series: to first order in the size of what drives the others,
/// such as the height of waves.
struct HillEquation {
  double omega;             ///< rad/s, of the drive
  Eigen::Vector3d at_rest;  ///< k, c, m
  Eigen::MatrixXd by_size;  ///< the same, one row each, as PeriodicMotion::coefficients

  /// The largest |multiplier| of a period.
  double growth(double size) const;
  /// The least size up to `largest` from which motions grow, to 1e-3 of `largest`; empty if none does.
  std::optional<double> least_growing(double largest) const;
};

/// Of the motion along `shape`, (n), from the system's second-order expansion about rest: how its equation varies with
/// a response that is linear in the size. Memory counts as the added mass and damping that it has at `own`, rad/s, the
/// motion's own frequency. `family`: by the size; `small`: at which the system is still linear, to its relative error.
/// \throws hydro::NumericsError where there is no linear response
HillEquation hill_equation(const Family& family, double small, const Eigen::VectorXd& shape, double own);

}  // namespace dynamics::frequency
