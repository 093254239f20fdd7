#include "dynamics/joint/independent.hpp"

#include <Eigen/CholmodSupport>
#include <SuiteSparseQR.hpp>
#include <algorithm>

#include "hydro/base/error.hpp"
#include "joint/columns.hpp"

namespace dynamics {
namespace {

/// G of one constraint a column, each of length one; a column of zeros where the bodies cannot move that way at all.
SparseColumns unit_columns(const JointSet& joints, const State& state, const Eigen::VectorXd& scale) {
  auto G = joints.over(joints.gradients(state), scale);
  for (Gradient& row : G)
    if (const double size = norm(row); size > 0) row = {row.first / size, row.second / size};
  return sparse_columns(joints, G, scale.size());
}

}  // namespace

// R is a staircase: a column that adds something begins a row of its own, which is its last.
std::vector<bool> independent(const JointSet& joints, const State& state, const Eigen::VectorXd& scale) {
  constexpr double part_of_others = 1e-9;
  SparseColumns columns = unit_columns(joints, state, scale);
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
