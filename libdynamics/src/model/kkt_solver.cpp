#include "dynamics/model/kkt_solver.hpp"

#include <algorithm>

#include "algebra/kept_lu.hpp"

namespace dynamics {

struct KktSolver::Impl {
  Impl(const BlockPattern& pattern, const JointSet& joints) : bodies_alone(pattern) {
    for (const Constraint& c : joints.constraints()) ends.push_back({c.first, c.second});
  }

  struct ConstraintBodies {
    int first;
    std::optional<int> second;
  };
  bool fits(const JointSet& joints) const {
    return std::ranges::equal(ends, joints.constraints(), [](const ConstraintBodies& one, const Constraint& other) {
      return one.first == other.first && one.second == other.second;
    });
  }
  std::vector<ConstraintBodies> ends;  // one for each constraint
  BlockSolver bodies_alone;
  Eigen::MatrixXd whole;  // what the dense factors are of
  KeptDenseLu dense_lu;
  KeptSparseLu sparse_lu;

  // Calls f(row or column of the bodies, constraint, which body's part) for all numbers of G.
  template <class Use>
  void for_each(const std::vector<Gradient>& G, Use use) const {
    for (std::size_t i = 0; i < G.size(); ++i) {
      const ConstraintBodies& c = ends[i];
      for (int k = 0; k < 6; ++k) use(6 * c.first + k, static_cast<Eigen::Index>(i), G[i].first[k]);
      if (!c.second) continue;
      for (int k = 0; k < 6; ++k) use(6 * *c.second + k, static_cast<Eigen::Index>(i), G[i].second[k]);
    }
  }

  bool factorise_dense(const BlockMatrix& T, const std::vector<Gradient>& G, const std::vector<Gradient>& H,
                       const Eigen::VectorXd& compliance) {
    const Eigen::Index n = 6 * T.pattern().bodies();
    whole.setZero(n + count(), n + count());
    T.find_dense(whole.topLeftCorner(n, n));
    whole.diagonal().tail(count()) = -compliance;
    for_each(G, [&](Eigen::Index mode, Eigen::Index i, double value) { whole(mode, n + i) = value; });
    for_each(H, [&](Eigen::Index mode, Eigen::Index i, double value) { whole(n + i, mode) = value; });
    if (!whole.allFinite()) return false;
    equilibrate(whole);
    return dense_lu.factorise(whole);
  }

  // Forces and metres, kilograms and numbers lie far apart in size: rows and columns scaled to one before the factors.
  Eigen::VectorXd row_scale, column_scale;
  void equilibrate(Eigen::MatrixXd& m) {
    row_scale = m.cwiseAbs().rowwise().maxCoeff().cwiseMax(1e-300).cwiseInverse();
    m = row_scale.asDiagonal() * m;
    column_scale = m.cwiseAbs().colwise().maxCoeff().transpose().cwiseMax(1e-300).cwiseInverse();
    m = m * column_scale.asDiagonal();
  }

  // Calls f(row, column, value) for every number of the system, always in the same order.
  template <class Use>
  void for_each_entry(const BlockMatrix& T, const std::vector<Gradient>& G, const std::vector<Gradient>& H,
                      const Eigen::VectorXd& compliance, Use use) const {
    const Eigen::Index n = 6 * T.pattern().bodies();
    for (int i = 0; i < T.pattern().bodies(); ++i)
      for (const int j : T.pattern().columns(i)) {
        const Matrix6& block = T.block(i, j);
        for (int r = 0; r < 6; ++r)
          for (int c = 0; c < 6; ++c) use(6 * i + r, 6 * j + c, block(r, c));
      }
    for_each(G, [&](Eigen::Index mode, Eigen::Index i, double value) { use(mode, n + i, value); });
    for_each(H, [&](Eigen::Index mode, Eigen::Index i, double value) { use(n + i, mode, value); });
    for (Eigen::Index i = 0; i < count(); ++i) use(n + i, n + i, -compliance[i]);
  }

  Eigen::VectorXd right, both;  // room for solve()

  KeptSparseLu::Matrix system;
  std::vector<std::size_t> place;  // of each number, in the order of for_each_entry(), among the values of `system`

  /// Sorts once where numbers go: their places come back as values.
  void analyse(const BlockMatrix& T, const std::vector<Gradient>& G, const std::vector<Gradient>& H,
               const Eigen::VectorXd& compliance) {
    std::vector<Eigen::Triplet<double>> entries;
    for_each_entry(T, G, H, compliance, [&](Eigen::Index row, Eigen::Index column, double) {
      entries.emplace_back(row, column, static_cast<double>(entries.size()));
    });
    const Eigen::Index size = 6 * T.pattern().bodies() + count();
    system.resize(size, size);
    system.setFromTriplets(entries.begin(), entries.end());
    place.resize(entries.size());
    for (Eigen::Index k = 0; k < system.nonZeros(); ++k)
      place[static_cast<std::size_t>(system.valuePtr()[k])] = static_cast<std::size_t>(k);
  }

  bool factorise_sparse(const BlockMatrix& T, const std::vector<Gradient>& G, const std::vector<Gradient>& H,
                        const Eigen::VectorXd& compliance) {
    if (place.empty()) analyse(T, G, H, compliance);
    std::size_t k = 0;
    bool finite = true;
    for_each_entry(T, G, H, compliance, [&](Eigen::Index, Eigen::Index, double value) {
      system.valuePtr()[place[k++]] = value;
      finite = finite && std::isfinite(value);
    });
    return finite && sparse_lu.factorise(system);
  }
  Eigen::Index count() const { return static_cast<Eigen::Index>(ends.size()); }
};

KktSolver::KktSolver(const BlockPattern& pattern, const JointSet& joints)
    : impl_(std::make_unique<Impl>(pattern, joints)) {}
KktSolver::~KktSolver() = default;
KktSolver::KktSolver(KktSolver&&) noexcept = default;
KktSolver& KktSolver::operator=(KktSolver&&) noexcept = default;

void KktSolver::take(const BlockPattern& pattern, const JointSet& joints) {
  of_step = 0;
  if (!impl_->fits(joints)) impl_ = std::make_unique<Impl>(pattern, joints);
}

bool KktSolver::is_sparse() const { return impl_->bodies_alone.is_sparse(); }

bool KktSolver::factorise(const BlockMatrix& T, const std::vector<Gradient>& G, const std::vector<Gradient>& H,
                          const Eigen::VectorXd& compliance) {
  of_step = 0;
  if (impl_->count() == 0) return impl_->bodies_alone.factorise(T);
  return is_sparse() ? impl_->factorise_sparse(T, G, H, compliance) : impl_->factorise_dense(T, G, H, compliance);
}

void KktSolver::solve(const Eigen::VectorXd& b, const Eigen::VectorXd& c, Solution& out) const {
  out.lambda.resize(c.size());
  if (impl_->count() == 0) return impl_->bodies_alone.solve(b, out.x);
  Eigen::VectorXd &right = impl_->right, &both = impl_->both;
  right.resize(b.size() + c.size());
  right << b, c;
  if (is_sparse()) {
    both = right;
    impl_->sparse_lu.solve_in_place(both);
  } else {
    right.array() *= impl_->row_scale.array();
    impl_->dense_lu.solve(right, both);
    both.array() *= impl_->column_scale.array();
  }
  out.x = both.head(b.size());
  out.lambda = both.tail(c.size());
}

KktSolver::Solution KktSolver::solve(const Eigen::VectorXd& b, const Eigen::VectorXd& c) const {
  Solution out;
  solve(b, c, out);
  return out;
}

}  // namespace dynamics
