#include "dynamics/state/block_matrix.hpp"

#include <algorithm>

#include "algebra/kept_lu.hpp"
#include "hydro/base/error.hpp"

namespace dynamics {

BlockPattern::BlockPattern(int bodies) : columns_(static_cast<std::size_t>(bodies)) {
  for (int i = 0; i < bodies; ++i) columns_[static_cast<std::size_t>(i)].push_back(i);
}

void BlockPattern::couple(int row, int column) {
  columns_[static_cast<std::size_t>(row)].push_back(column);
  columns_[static_cast<std::size_t>(column)].push_back(row);
}

void BlockPattern::freeze() {
  count_ = 0;
  first_.clear();
  for (auto& row : columns_) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    first_.push_back(count_);
    count_ += row.size();
  }
}

std::size_t BlockPattern::index(int row, int column) const {
  const auto& in_row = columns_[static_cast<std::size_t>(row)];
  const auto at = std::lower_bound(in_row.begin(), in_row.end(), column);
  hydro::ensure(at != in_row.end() && *at == column, "BlockPattern: pair not coupled");
  return first_[static_cast<std::size_t>(row)] + static_cast<std::size_t>(at - in_row.begin());
}

void BlockMatrix::set_zero() {
  for (auto& b : blocks_) b.setZero();
}

Eigen::VectorXd BlockMatrix::operator*(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y;
  multiply(x, y);
  return y;
}

void BlockMatrix::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  y.setZero(x.size());
  std::size_t k = 0;
  for (int i = 0; i < pattern_->bodies(); ++i)
    for (const int j : pattern_->columns(i)) y.segment<6>(6 * i) += blocks_[k++] * x.segment<6>(6 * j);
}

Eigen::MatrixXd BlockMatrix::dense() const {
  const Eigen::Index n = 6 * static_cast<Eigen::Index>(pattern_->bodies());
  Eigen::MatrixXd out(n, n);
  find_dense(out);
  return out;
}

void BlockMatrix::find_dense(Eigen::Ref<Eigen::MatrixXd> out) const {
  out.setZero();
  std::size_t k = 0;
  for (int i = 0; i < pattern_->bodies(); ++i)
    for (const int j : pattern_->columns(i)) out.block<6, 6>(6 * i, 6 * j) = blocks_[k++];
}

namespace {
// Dense LU of 48 unknowns takes about as long as sparse LU of a chain of 8 bodies; where more than a third of the
// blocks is there, fill-in makes the sparse factor dense anyway.
constexpr int few_bodies = 8;
bool prefers_sparse(const BlockPattern& p) {
  const auto n = static_cast<std::size_t>(p.bodies());
  return p.bodies() > few_bodies && 3 * p.blocks() < n * n;
}
}  // namespace

struct BlockSolver::Impl {
  bool sparse;
  Eigen::MatrixXd dense;
  KeptDenseLu dense_lu;
  KeptSparseLu::Matrix matrix;
  KeptSparseLu sparse_lu;

  /// Column pointers and rows of the pattern; values are filled in the same order at each factorisation.
  void analyse(const BlockPattern& pattern) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(36 * pattern.blocks());
    for (int i = 0; i < pattern.bodies(); ++i)
      for (const int j : pattern.columns(i))
        for (int r = 0; r < 6; ++r)
          for (int c = 0; c < 6; ++c) entries.emplace_back(6 * i + r, 6 * j + c, 1.0);
    matrix.resize(6 * pattern.bodies(), 6 * pattern.bodies());
    matrix.setFromTriplets(entries.begin(), entries.end());
  }
  /// The pattern is symmetric, so the rows in column j are those of the block columns in block row j.
  void fill(const BlockMatrix& source) {
    double* value = matrix.valuePtr();
    for (int j = 0; j < source.pattern().bodies(); ++j)
      for (int c = 0; c < 6; ++c)
        for (const int i : source.pattern().columns(j)) {
          const Matrix6& block = source.block(i, j);
          for (int r = 0; r < 6; ++r) *value++ = block(r, c);
        }
  }
};

BlockSolver::BlockSolver(const BlockPattern& pattern) : impl_(std::make_unique<Impl>()) {
  impl_->sparse = prefers_sparse(pattern);
}
BlockSolver::~BlockSolver() = default;
BlockSolver::BlockSolver(BlockSolver&&) noexcept = default;

bool BlockSolver::is_sparse() const { return impl_->sparse; }

bool BlockSolver::factorise(const BlockMatrix& matrix) {
  if (!impl_->sparse) {
    const Eigen::Index n = 6 * static_cast<Eigen::Index>(matrix.pattern().bodies());
    impl_->dense.resize(n, n);
    matrix.find_dense(impl_->dense);
    return impl_->dense.allFinite() && impl_->dense_lu.factorise(impl_->dense);
  }
  if (impl_->matrix.size() == 0) impl_->analyse(matrix.pattern());
  impl_->fill(matrix);
  const auto values = Eigen::Map<const Eigen::VectorXd>(impl_->matrix.valuePtr(), impl_->matrix.nonZeros());
  if (!values.allFinite()) return false;
  return impl_->sparse_lu.factorise(impl_->matrix);
}

void BlockSolver::solve(const Eigen::VectorXd& right, Eigen::VectorXd& out) const {
  if (!impl_->sparse) return impl_->dense_lu.solve(right, out);
  out = right;
  impl_->sparse_lu.solve_in_place(out);
}

Eigen::VectorXd BlockSolver::solve(const Eigen::VectorXd& right) const {
  Eigen::VectorXd out;
  solve(right, out);
  return out;
}

}  // namespace dynamics
