#pragma once
/// \file  How contacts that are more than a body needs can share what they bear (D130). Not installed.
#include <Eigen/Core>

#include <vector>

namespace dynamics {

/// One closed contact among loads y: p = −y[row] is its load along the normal, and the rows that follow hold it along
/// the surface while it sticks. It bears p >= 0, and of those |τ| <= μp.
struct Bearing {
  Eigen::Index row;
  int held;         ///< rows along the surface
  double friction;  ///< μ; asked where held > 0
  /// What it has to spare: μp − |τ|, or p.
  double spare(const Eigen::VectorXd& y) const;
};

/// The least that one of them has to spare.
double least_spare(const std::vector<Bearing>& bearings, const Eigen::VectorXd& y);

/// Loads that do nothing together: an orthonormal basis of all y with Cᵀy = 0, (rows of C, their number).
Eigen::MatrixXd without_effect(const Eigen::MatrixXd& C);

/// Of all loads even + N z, those that leave the most to the contact that has the least to spare; or the first found
/// that all can bear. Where least_spare() of the outcome is negative, no share is borne by all.
Eigen::VectorXd best_share(const Eigen::MatrixXd& N, const Eigen::VectorXd& even, const std::vector<Bearing>& bearings);

/// Of all loads even + N z that all can bear, those nearest to `even`: how equal pads that give way a little share
/// them. `borne`: some of these, with something to spare.
Eigen::VectorXd nearest_share(const Eigen::MatrixXd& N, const Eigen::VectorXd& even,
                              const std::vector<Bearing>& bearings, const Eigen::VectorXd& borne);

}  // namespace dynamics
