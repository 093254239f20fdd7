#pragma once
/// \file  A band matrix that is used once: filled, then eliminated together with its right-hand side. (D78)
#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace dynamics::line {

/// How far the equations of a node reach: to its neighbours, or by bending to theirs.
enum class Reach { neighbours, next_neighbours };

/// Square, with six diagonals on either side of the main one: neighbouring nodes and the tension between them; with ten
/// where a node's equations hold the second next one.
class BandMatrix {
 public:
  BandMatrix(int size, Reach reach)
      : size_(size),
        half_(reach == Reach::neighbours ? narrow : wide),
        entries_(static_cast<std::size_t>(size * stride_of(half_))) {}
  int half() const { return half_; }
  void set_zero() { std::fill(entries_.begin(), entries_.end(), 0.0); }
  double& operator()(int row, int column) {
    return entries_[static_cast<std::size_t>(row * stride_of(half_) + column - row + half_)];
  }

  /// Gaussian elimination with row pivots; overwrites matrix and `b`, which becomes the solution. O(size).
  /// Returns false for a matrix that is singular or not finite.
  bool solve(Eigen::VectorXd& b);
  /// The same for several right-hand sides at once, one a column.
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  bool solve(Columns& b);

 private:
  static constexpr int narrow = 6, wide = 10;
  // Row swaps fill as many diagonals more above.
  static constexpr int stride_of(int half) { return 3 * half + 2; }

  int size_, half_;
  std::vector<double> entries_;
};

}  // namespace dynamics::line
