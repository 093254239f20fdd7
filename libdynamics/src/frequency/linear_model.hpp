#pragma once
/// \file  Private: small motions and those of them that are left, for responses at any frequency.
#include "reduction.hpp"

namespace dynamics::frequency {

struct LinearModel {
  explicit LinearModel(const SmallMotions& about) : left(about) {}

  Reduction left;

  /// Z ξ = X in the motions that are left; all modes. \throws hydro::NumericsError if Z is singular there
  Eigen::VectorXcd response(const Eigen::MatrixXcd& Z, const Eigen::VectorXcd& X, double omega) const;
};

}  // namespace dynamics::frequency
