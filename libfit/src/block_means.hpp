#pragma once
/// \file  Means over blocks of samples within which the columns hardly change.
#include <Eigen/Core>

namespace fit {

/// Shape (n/block, p); samples after the last whole block are left out.
inline Eigen::MatrixXd block_means(const Eigen::MatrixXd& m, Eigen::Index block) {
  Eigen::MatrixXd out(m.rows() / block, m.cols());
  for (Eigen::Index b = 0; b < out.rows(); ++b) out.row(b) = m.middleRows(b * block, block).colwise().mean();
  return out;
}

}  // namespace fit
