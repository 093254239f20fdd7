#pragma once
/// \file  A model for small motions about a state in which it is still: what all of the frequency domain works with.
#include <Eigen/Core>

#include <utility>

#include "dynamics/frequency/member_inertia.hpp"
#include "dynamics/model/model.hpp"

namespace dynamics::frequency {

/// Stiffness, damping, constraints and masses of a model about a still state (D17). Added mass of potential flow,
/// radiation and excitation stay those of the bodies as placed, in global axes, as runs have them.
struct SmallMotions {
  /// About rest as placed, so that a model may stand wherever its small motions are asked for. `of` must live as long.
  SmallMotions(const Model& of) : SmallMotions(of, rest_state(of.bodies())) {}
  /// About a state without velocities, which loads and joints must hold there: see equilibrium(). `of` must live as
  /// long. `of_members`: what slender members add (D148).
  SmallMotions(const Model& of, State about, MemberInertia of_members = {})
      : model(of),
        still(std::move(about)),
        linear(model.linear_at(still)),
        mass(model.dry_mass(still)),
        members(std::move(of_members)) {
    members.add_mass(still, mass);
  }

  const Model& model;
  State still;
  Model::Linear linear;
  Eigen::MatrixXd mass;   ///< of the bodies with the added mass of their members, (6N, 6N)
  MemberInertia members;  ///< whose wave loads are in excitation()
};

}  // namespace dynamics::frequency
