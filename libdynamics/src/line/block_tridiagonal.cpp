#include "block_tridiagonal.hpp"

#include <Eigen/LU>

#include <cmath>

#include "hydro/base/machine.hpp"
#include "triple.hpp"

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

FROUDE_EVERY_MACHINE void BlockTridiagonal::solve(Eigen::Ref<Places> b) const {
  const auto last = static_cast<int>(nodes_.size()) - 1;
  const auto node = [&](int i) -> const Node& { return nodes_[static_cast<std::size_t>(i)]; };
  Triple own = column(b, 0);
  for (int i = 0; i < last; ++i) {
    own = column(b, i + 1) - times(node(i).lower, own);
    own.put(b.col(i + 1).data());
  }
  Triple solved = times(node(last).diagonal, own);
  solved.put(b.col(last).data());
  for (int i = last - 1; i >= 0; --i) {
    solved = times(node(i).diagonal, column(b, i) - times(node(i).upper, solved));
    solved.put(b.col(i).data());
  }
}

}  // namespace dynamics::line
