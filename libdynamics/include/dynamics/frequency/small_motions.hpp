#pragma once
/// \file  A model for small motions about a state in which it is still: what all of the frequency domain works with.
#include <Eigen/Core>

#include "dynamics/model/model.hpp"

namespace dynamics::frequency {

/// Stiffness, damping, constraints and own masses of a model about a still state (D17). Added mass, radiation and
/// excitation stay those of the bodies as placed, in global axes, as runs have them.
struct SmallMotions {
  /// About rest as placed, so that a model may stand wherever its small motions are asked for. `of` must live as long.
  SmallMotions(const Model& of) : SmallMotions(of, rest_state(of.bodies())) {}
  /// About a state without velocities, which loads and joints must hold there: see equilibrium(). `of` must live as
  /// long.
  SmallMotions(const Model& of, State about)
      : model(of), still(std::move(about)), linear(model.linear_at(still)), mass(model.dry_mass(still)) {}

  const Model& model;
  State still;
  Model::Linear linear;
  Eigen::MatrixXd mass;  ///< of the bodies alone, (6N, 6N)
};

}  // namespace dynamics::frequency
