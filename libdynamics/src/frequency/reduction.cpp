#include "reduction.hpp"

namespace dynamics::frequency {

// Columns are orthogonal in the metric of the bodies' own masses: metres and radians count by what they move.
Reduction::Reduction(const Model& model, const Model::Linear& linear)
    : modes_(model.modes()), jointed_(linear.conditions.rows() > 0) {
  for (int m = 0; m < model.modes(); ++m)
    if (model.is_free(m)) free_.push_back(m);
  if (!jointed_) return;
  const Eigen::VectorXd root = model.dry_mass_at_rest().diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd G = linear.conditions * root.asDiagonal();
  const Eigen::MatrixXd of_free = G(Eigen::all, free_).transpose();
  const auto left = static_cast<Eigen::Index>(free_.size()) - G.rows();
  basis_ = Eigen::MatrixXd::Zero(modes_, left);
  // Gᵀ = Q (R, 0): the last columns of Q are across all conditions.
  const Eigen::MatrixXd Q = of_free.householderQr().householderQ();
  basis_(free_, Eigen::all) = Q.rightCols(left);
  basis_ = root.asDiagonal() * basis_;
}

}  // namespace dynamics::frequency
