#include "dynamics/joint/independent.hpp"

#include <Eigen/CholmodSupport>
#include <Eigen/Sparse>
#include <SuiteSparseQR.hpp>
#include <algorithm>

#include "hydro/base/error.hpp"

namespace dynamics {
namespace {

using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, SuiteSparse_long>;

/// G of one constraint a column, each of length one; a column of zeros where the bodies cannot move that way at all.
Sparse unit_columns(const JointSet& joints, const State& state, const Eigen::VectorXd& scale) {
  std::vector<Eigen::Triplet<double, SuiteSparse_long>> entries;
  const auto G = joints.over(joints.gradients(state), scale);
  for (std::size_t i = 0; i < G.size(); ++i) {
    const Constraint& c = joints.constraints()[i];
    const double size = norm(G[i]);
    for (int k = 0; k < 6; ++k) {
      if (G[i].first[k] != 0) entries.emplace_back(6 * c.first + k, i, G[i].first[k] / size);
      if (G[i].second[k] != 0) entries.emplace_back(6 * *c.second + k, i, G[i].second[k] / size);
    }
  }
  Sparse out(scale.size(), joints.count());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace

// R is a staircase: a column that adds something begins a row of its own, which is its last.
std::vector<bool> independent(const JointSet& joints, const State& state, const Eigen::VectorXd& scale) {
  constexpr double part_of_others = 1e-9;
  Sparse columns = unit_columns(joints, state, scale);
  cholmod_common common;
  cholmod_l_start(&common);
  cholmod_sparse view = Eigen::viewAsCholmod(columns), *R = nullptr;
  SuiteSparse_long* order = nullptr;  // of the columns of R; null: as given
  const SuiteSparse_long rank =
      SuiteSparseQR<double>(SPQR_ORDERING_FIXED, part_of_others, 0, &view, &R, &order, &common);
  hydro::ensure(rank >= 0 && R != nullptr, "sparse QR of the constraints of joints");
  const auto* begin = static_cast<const SuiteSparse_long*>(R->p);
  const auto* row = static_cast<const SuiteSparse_long*>(R->i);
  std::vector<bool> out(static_cast<std::size_t>(joints.count()), false);
  SuiteSparse_long rows = 0;
  for (SuiteSparse_long k = 0; k < joints.count(); ++k) {
    const bool own = std::any_of(row + begin[k], row + begin[k + 1], [&](auto r) { return r >= rows; });
    if (!own) continue;
    out[static_cast<std::size_t>(order == nullptr ? k : order[k])] = true;
    ++rows;
  }
  cholmod_l_free_sparse(&R, &common);
  cholmod_l_free(joints.count(), sizeof(SuiteSparse_long), order, &common);
  cholmod_l_finish(&common);
  hydro::ensure(rows == rank, "as many independent constraints of joints as their rank");
  return out;
}

}  // namespace dynamics
