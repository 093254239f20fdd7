#pragma once
/// \file  Factors of the equations of motion together with the constraints of joints.
#include <Eigen/Core>

#include <memory>
#include <vector>

#include "dynamics/joint/joint.hpp"
#include "dynamics/state/block_matrix.hpp"

namespace dynamics {

/// Solves [T Gᵀ; H 0] (x, λ) = (b, c): T of the bodies, Gᵀ and H one column and one row for each constraint. Dense LU
/// where the system is small or all bodies touch, sparse LU (SuiteSparse KLU, ordered once) otherwise. Without
/// constraints this is BlockSolver and costs the same.
class KktSolver {
 public:
  KktSolver(const BlockPattern& pattern, const JointSet& joints);
  ~KktSolver();
  KktSolver(KktSolver&&) noexcept;
  KktSolver& operator=(KktSolver&&) noexcept;
  bool is_sparse() const;
  /// `compliance` c, one for each constraint, >= 0, puts −c on the diagonal of the lower right block.
  /// False if the matrix is singular to working precision or not finite. Forgets `of_step`.
  bool factorise(const BlockMatrix& T, const std::vector<Gradient>& G, const std::vector<Gradient>& H,
                 const Eigen::VectorXd& compliance);
  struct Solution {
    Eigen::VectorXd x, lambda;
  };
  Solution solve(const Eigen::VectorXd& b, const Eigen::VectorXd& c) const;
  /// The same, into vectors that have room.
  void solve(const Eigen::VectorXd& b, const Eigen::VectorXd& c, Solution& out) const;

  /// Becomes a solver for other constraints; its room stays if they join the same bodies, one for one.
  void take(const BlockPattern& pattern, const JointSet& joints);

  double of_step = 0;  ///< s: the factors are those of the iteration matrix of such a step (D98); 0: of something else

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dynamics
