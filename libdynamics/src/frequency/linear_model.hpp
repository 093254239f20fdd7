#pragma once
/// \file  Private: small motions and those of them that are left, for responses at any frequency.
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "reduction.hpp"

namespace dynamics::frequency {

struct LinearModel {
  explicit LinearModel(const SmallMotions& about) : left(about) {}

  Reduction left;
  int factorisations = 0;  ///< of a matrix Z, so far

  /// Z ξ = X in the motions that are left; all modes. X: a vector, or one column for each of several waves, which share
  /// the one factorisation of Z. \throws hydro::NumericsError if Z is singular there
  template <class Loads>
  Loads response(const Eigen::MatrixXcd& Z, const Loads& X, double omega) {
    const hydro::dense::ComplexLu lu(left.matrix(Z));
    ++factorisations;
    const Loads x = lu.solve(left.vector(X));
    // An undamped resonance met exactly has no finite answer.
    if (!x.allFinite() || lu.rcond() < 1e-15)
      throw hydro::NumericsError(
          fmt::format("no response exists at {:.6g} rad/s: the equations of motion are singular there", omega));
    return left.expanded(x);
  }
};

}  // namespace dynamics::frequency
