#pragma once
/// \file  Private: a model about rest and the motions that are left, for responses at any frequency.
#include "reduction.hpp"

namespace dynamics::frequency {

struct LinearModel {
  explicit LinearModel(const Model& model) : linear(model.linear_at_rest()), left(model, linear) {}

  Model::Linear linear;
  Reduction left;

  /// Z ξ = X in the motions that are left; all modes. \throws hydro::NumericsError if Z is singular there
  Eigen::VectorXcd response(const Eigen::MatrixXcd& Z, const Eigen::VectorXcd& X, double omega) const;
};

}  // namespace dynamics::frequency
