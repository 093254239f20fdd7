#pragma once
/// \file  Blocks of three that join neighbouring nodes: factorised once, solved as often as is asked. (D138)
#include <Eigen/Core>

#include <vector>

#include "dynamics/line/line.hpp"

namespace dynamics::line {

/// Square, 3 × 3 blocks on the diagonal and on either side of it. Elimination is without pivots between blocks: for
/// matrices whose masses or pulls outweigh the rest. O(nodes).
class BlockTridiagonal {
 public:
  /// In the rows of node i: its own block, that of the node after it; and in the rows of that node, the block of i.
  struct Node {
    Eigen::Matrix3d diagonal, upper, lower;
  };
  explicit BlockTridiagonal(int nodes) : nodes_(static_cast<std::size_t>(nodes)) {}
  Node& operator[](int i) { return nodes_[static_cast<std::size_t>(i)]; }

  /// Overwrites the blocks with factors: inverse pivots, and minus what takes rows off the next. \returns false where a
  /// block is singular or not finite
  bool factorise();
  /// Overwrites b with the solution.
  void solve(Eigen::Ref<Places> b) const;

 private:
  std::vector<Node> nodes_;
};

}  // namespace dynamics::line
