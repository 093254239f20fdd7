#pragma once
/// \file  Inertia of members in linear responses, along their length and at their ends: added mass, and the loads of
/// the
///        water's acceleration and pressure. (D148), (D171)
#include <Eigen/Core>

#include <vector>

#include "dynamics/force/drag.hpp"
#include "dynamics/state/body.hpp"
#include "hydro/base/types.hpp"

namespace dynamics::frequency {

/// One piece of a member, small enough for one acceleration.
struct InertiaPiece {
  DragPiece at;             ///< where it is; its factor does not count
  double displaced, added;  ///< ρ¼πD²ℓ and C_A times that, kg
};

/// One end of a member.
struct EndPiece {
  DragPiece at;           ///< where it is, its axis into the member; its factor does not count
  double pressed, added;  ///< area, m², and C_A ρπD³/12, kg
};

/// (D148): F = Σ Jᵀ P ((1 + C_A) m u̇ − C_A m ẇ) over the pieces of members that are wet at rest, m what a piece
/// displaces; on their ends (D171) ΣJᵀt (p A + m_a t·(u̇ − ẇ)). Linear in the waves; without drag, which LinearDrag has.
/// Valid for members that are slim beside the wave and stay wet as they are at rest. (Morison et al. 1950)
struct MemberInertia {
  std::vector<InertiaPiece> pieces = {};
  hydro::Water water = {};
  std::vector<EndPiece> ends = {};

  /// Adds the added mass, ΣJᵀ P C_A m J and ΣJᵀ ttᵀ m_a J, of bodies that are still, (6N, 6N), about their centres of
  /// gravity.
  void add_mass(const State& still, Eigen::MatrixXd& mass) const;
  /// Load of waves of one frequency, rad/s, and heading, rad, on members where bodies are placed, arms and axes as they
  /// are while `still`: (6N), N and N m per metre of amplitude, Re(F e^{iωt}).
  Eigen::VectorXcd excitation(const std::vector<RigidBody>& bodies, const State& still, double omega,
                              double heading) const;
};

}  // namespace dynamics::frequency
