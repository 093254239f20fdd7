#pragma once
/// \file  From waves that pass between groups to A, B and X of bodies, and what waves far away say of them (C3), (C13).
/// Not installed.
#include "groups.hpp"
#include "symmetry.hpp"

namespace hydro::cylinders {

/// The answer at one frequency, in the modes of the bodies.
struct OneFrequency {
  Eigen::MatrixXd A, B;    ///< (6N, 6N)
  Eigen::MatrixXcd X;      ///< (6N, headings)
  Eigen::MatrixXd B_far;   ///< B from the power that waves carry away (C13)
  Eigen::MatrixXcd X_far;  ///< X by Haskind's relation from the waves made by motion (C13)
  int partial_waves = 0;   ///< per cylinder
  double left_out = 0;     ///< coupling by partial waves that cannot be had (C11)
  int steps = 0;           ///< of the iteration; 0: solved by elimination
  bool lattice = false;    ///< waves passed over a lattice (C21)
};

/// What groups are asked at one frequency, omega > 0 and finite.
struct Question {
  double omega;
  const Water& water;
  const VerticalModes& modes;
  const std::vector<double>& heading;
  const Eigen::MatrixXd& motion;  ///< (6 cylinders, 6 bodies): velocities of the cylinders when the bodies move
  const SolvedMotions& solved;
  double across;  ///< between the axes of the farthest two cylinders, m
  int orders;     ///< of partial waves
  Equations equations = Equations::automatic;
};
OneFrequency answers(const Groups& groups, const Question& question);

/// A as ω → ∞, of groups in the modes of that limit.
Eigen::MatrixXd added_mass_at_infinity(const Groups& groups, const Water& water, const Eigen::MatrixXd& motion,
                                       const SolvedMotions& solved, Equations equations);

}  // namespace hydro::cylinders
