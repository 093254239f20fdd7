#include "block_tridiagonal.hpp"

#include <cmath>

#include "hydro/base/machine.hpp"
#include "triple.hpp"

namespace dynamics::line {

namespace {

/// By cofactors. \returns the determinant
FROUDE_INLINE double invert(Eigen::Matrix3d& m) {
  const Triple a = Triple::of(m.data()), b = Triple::of(m.data() + 3), c = Triple::of(m.data() + 6);
  const Triple bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double determinant = a.dot(bc), share = 1 / determinant;
  m << share * bc.x, share * bc.y, share * bc.z, share * ca.x, share * ca.y, share * ca.z, share * ab.x, share * ab.y,
      share * ab.z;
  return determinant;
}

}  // namespace

FROUDE_EVERY_MACHINE bool BlockTridiagonal::factorise() {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    const double determinant = invert(node.diagonal);
    if (!std::isfinite(determinant) || determinant == 0) return false;
    if (i + 1 == nodes_.size()) break;
    const Eigen::Matrix3d lower = node.lower;
    node.lower.setZero();
    take_product_off(lower, node.diagonal, node.lower);
    add_product(node.lower, node.upper, nodes_[i + 1].diagonal);
  }
  return true;
}

FROUDE_EVERY_MACHINE void BlockTridiagonal::solve(Eigen::Ref<Places> b) const {
  const auto last = static_cast<int>(nodes_.size()) - 1;
  const auto node = [&](int i) -> const Node& { return nodes_[static_cast<std::size_t>(i)]; };
  Triple own = column(b, 0);
  for (int i = 0; i < last; ++i) {
    own = column(b, i + 1) + times(node(i).lower, own);
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
