#include "reduction.hpp"
#include "hydro/base/dense.hpp"

namespace dynamics::frequency {

// Columns are orthogonal in the metric of the bodies' own masses: metres and radians count by what they move.
Reduction::Reduction(const SmallMotions& about)
    : modes_(about.model.modes()), jointed_(about.linear.constraints.rows() > 0) {
  for (int m = 0; m < about.model.modes(); ++m)
    if (about.model.is_free(m)) free_.push_back(m);
  if (!jointed_) return;
  const Eigen::VectorXd root = about.mass.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd G = about.linear.constraints * root.asDiagonal();
  const Eigen::MatrixXd of_free = G(Eigen::all, free_).transpose();
  const auto left = static_cast<Eigen::Index>(free_.size()) - G.rows();
  basis_ = Eigen::MatrixXd::Zero(modes_, left);
  // Gᵀ = Q (R, 0): the last columns of Q are across all constraints.
  basis_(free_, Eigen::all) = hydro::dense::HouseholderQr(of_free).full_Q().rightCols(left);
  basis_ = root.asDiagonal() * basis_;
}

}  // namespace dynamics::frequency
