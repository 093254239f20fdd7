#include "block_tridiagonal.hpp"

#include <Eigen/LU>

#include <cmath>

namespace dynamics::line {

bool BlockTridiagonal::factorise() {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    const double determinant = node.diagonal.determinant();
    if (!std::isfinite(determinant) || determinant == 0) return false;
    node.diagonal = node.diagonal.inverse().eval();
    if (i + 1 == nodes_.size()) break;
    node.lower = (node.lower * node.diagonal).eval();
    nodes_[i + 1].diagonal -= node.lower * node.upper;
  }
  return true;
}

void BlockTridiagonal::solve(Eigen::Ref<Places> b) const {
  const auto last = static_cast<Eigen::Index>(nodes_.size()) - 1;
  for (Eigen::Index i = 0; i < last; ++i) b.col(i + 1) -= nodes_[static_cast<std::size_t>(i)].lower * b.col(i);
  for (Eigen::Index i = last; i >= 0; --i) {
    const Node& node = nodes_[static_cast<std::size_t>(i)];
    Eigen::Vector3d own = b.col(i);
    if (i < last) own -= node.upper * b.col(i + 1);
    b.col(i) = node.diagonal * own;
  }
}

}  // namespace dynamics::line
