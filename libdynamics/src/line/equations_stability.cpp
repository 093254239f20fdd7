/// Whether a line at rest stays there: the second variation of its energy. (D157)
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

#include "equations.hpp"

namespace dynamics::line {

using Eigen::VectorXd;

namespace {

/// A length that is kept counts as a spring that is so much stiffer than what is beside it: enough to keep it, and so
/// little that rounding leaves the rest.
constexpr double stiffer = 1e8;

/// The lower triangle of the symmetric part of a matrix between places of nodes that move; held nodes are left out and
/// tied ones are one.
class SymmetricPart {
 public:
  explicit SymmetricPart(const Line& line) : row_(static_cast<std::size_t>(line.nodes()), -1) {
    for (int i = 0; i < line.nodes(); ++i)
      if (line.moves(i)) {
        row_[static_cast<std::size_t>(i)] = size_;
        size_ += 3;
      }
    for (int i = 0; i < line.nodes(); ++i) row_[static_cast<std::size_t>(i)] = row_[at(line.same_as(i))];
  }

  int size() const { return size_; }
  void add(int node, int axis, int other_node, int other_axis, double value) {
    const int r = row_[at(node)] + axis, c = row_[at(other_node)] + other_axis;
    if (row_[at(node)] < 0 || row_[at(other_node)] < 0 || value == 0) return;
    entries_.emplace_back(std::max(r, c), std::min(r, c), r == c ? value : value / 2);
  }
  void add_to_diagonal(double value) {
    for (int r = 0; r < size_; ++r) entries_.emplace_back(r, r, value);
  }
  bool is_positive() const {
    Eigen::SparseMatrix<double> lower(size_, size_);
    lower.setFromTriplets(entries_.begin(), entries_.end());
    return Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>(lower).info() == Eigen::Success;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  std::vector<int> row_;
  std::vector<Eigen::Triplet<double>> entries_;
  int size_ = 0;
};

}  // namespace

bool Equations::is_least(const Stage& stage, const State& before, const Places& u, const VectorXd& T, double margin) {
  // Bed, bending and what lifts only add to the second variation: what pulls everywhere stays.
  if (T.minCoeff() >= 0) return true;
  assemble(stage, before, u, T, true);
  SymmetricPart variation(line_);
  const int reach = line_.bends() ? 2 : 1;
  for (int i = 0; i < line_.nodes(); ++i)
    for (int k = std::max(0, i - reach); k <= std::min(line_.nodes() - 1, i + reach); ++k)
      for (int e = 0; e < 9; ++e)
        variation.add(i, e / 3, k, e % 3, matrix_(place_index(i) + e / 3, place_index(k) + e % 3));
  for (int j = 0; j < line_.segments(); ++j) {
    const int first = line_.first(j), t = tension_index(j);
    const auto row = [&](int k) { return place_index(first + k / 3) + k % 3; };
    double beside = std::abs(T[j]) / line_.segment(j).length + margin;
    for (int k = 0; k < 6; ++k) beside = std::max(beside, std::abs(matrix_(row(k), row(k))));
    const double by_T = line_.segment(j).is_inextensible() ? -scale_ * scale_ / (stiffer * beside) : matrix_(t, t);
    for (int k = 0; k < 6; ++k)
      for (int m = 0; m < 6; ++m)
        variation.add(first + k / 3, k % 3, first + m / 3, m % 3, -matrix_(row(k), t) * matrix_(t, row(m)) / by_T);
  }
  variation.add_to_diagonal(margin);
  return variation.is_positive();
}

}  // namespace dynamics::line
