#pragma once
/// \file  Square matrices of 6 × 6 blocks, one block row a body, and their factors.
#include <Eigen/Core>

#include <memory>
#include <vector>

#include "dynamics/state/body.hpp"

namespace dynamics {

/// Which pairs of bodies touch each other; fixed once for a model.
class BlockPattern {
 public:
  explicit BlockPattern(int bodies);  ///< the diagonal only
  void couple(int row, int column);   ///< adds (row, column) and (column, row)
  void freeze();                      ///< sorts; no couple() afterwards

  int bodies() const { return static_cast<int>(columns_.size()); }
  std::size_t blocks() const { return count_; }
  const std::vector<int>& columns(int row) const { return columns_[static_cast<std::size_t>(row)]; }
  /// Index of a block in storage order; the pair must have been coupled.
  std::size_t index(int row, int column) const;

 private:
  std::vector<std::vector<int>> columns_;
  std::vector<std::size_t> first_;
  std::size_t count_ = 0;
};

/// Values on a pattern.
class BlockMatrix {
 public:
  explicit BlockMatrix(const BlockPattern& pattern) : pattern_(&pattern), blocks_(pattern.blocks()) { set_zero(); }
  void set_zero();
  Matrix6& block(int row, int column) { return blocks_[pattern_->index(row, column)]; }
  const Matrix6& block(int row, int column) const { return blocks_[pattern_->index(row, column)]; }
  const BlockPattern& pattern() const { return *pattern_; }
  Eigen::VectorXd operator*(const Eigen::VectorXd& x) const;
  /// The same, into a vector that has room.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  Eigen::MatrixXd dense() const;
  /// The same, into a matrix, or a part of one, of that size.
  void find_dense(Eigen::Ref<Eigen::MatrixXd> out) const;

 private:
  const BlockPattern* pattern_;
  std::vector<Matrix6> blocks_;
};

/// Solves with a BlockMatrix, unsymmetric: dense LU where bodies are few or all touch, sparse LU (SuiteSparse KLU,
/// ordered and analysed once) otherwise. Which, is fixed by the pattern.
class BlockSolver {
 public:
  explicit BlockSolver(const BlockPattern& pattern);
  ~BlockSolver();
  BlockSolver(BlockSolver&&) noexcept;
  bool is_sparse() const;
  /// False if the matrix is singular to working precision or not finite.
  bool factorise(const BlockMatrix& matrix);
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  /// The same, into a vector that has room.
  void solve(const Eigen::VectorXd& right, Eigen::VectorXd& out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dynamics
