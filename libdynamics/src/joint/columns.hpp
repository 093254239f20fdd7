#pragma once
/// \file  The constraints of joints as a sparse matrix. Not installed.
#include <SuiteSparse_config.h>
#include <Eigen/Sparse>

#include "dynamics/joint/joint.hpp"

namespace dynamics {

using SparseColumns = Eigen::SparseMatrix<double, Eigen::ColMajor, SuiteSparse_long>;

/// Gᵀ, one constraint a column, without its zeros.
inline SparseColumns sparse_columns(const JointSet& joints, const std::vector<Gradient>& G, Eigen::Index modes) {
  std::vector<Eigen::Triplet<double, SuiteSparse_long>> entries;
  for (std::size_t i = 0; i < G.size(); ++i) {
    const Constraint& c = joints.constraints()[i];
    for (int k = 0; k < 6; ++k) {
      if (G[i].first[k] != 0) entries.emplace_back(6 * c.first + k, i, G[i].first[k]);
      if (G[i].second[k] != 0) entries.emplace_back(6 * *c.second + k, i, G[i].second[k]);
    }
  }
  SparseColumns out(modes, joints.count());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace dynamics
