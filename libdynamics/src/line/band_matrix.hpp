#pragma once
/// \file  A band matrix that is used once: filled, then eliminated together with its right-hand side. (D78)
#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace dynamics::line {

/// Square, with six diagonals on either side of the main one: neighbouring nodes and the tension between them.
class BandMatrix {
 public:
  static constexpr int half = 6;

  explicit BandMatrix(int size) : size_(size), entries_(static_cast<std::size_t>(size) * stride) {}
  void set_zero() { std::fill(entries_.begin(), entries_.end(), 0.0); }
  double& operator()(int row, int column) { return entries_[place(row, column)]; }

  /// Gaussian elimination with row pivots; overwrites matrix and `b`, which becomes the solution. O(size).
  /// Returns false for a matrix that is singular or not finite.
  bool solve(Eigen::VectorXd& b);
  /// The same for several right-hand sides at once, one a column.
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  bool solve(Columns& b);

 private:
  // Row swaps fill six more diagonals above.
  static constexpr int stride = 3 * half + 2;
  bool eliminate(double* rhs, int width);
  bool eliminate_one(double* rhs);
  template <int Width>
  bool eliminate_in_place(double* rhs, int width);
  static std::size_t place(int row, int column) { return static_cast<std::size_t>(row * stride + column - row + half); }

  int size_;
  std::vector<double> entries_;
};

}  // namespace dynamics::line
