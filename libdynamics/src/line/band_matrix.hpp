#pragma once
/// \file  A band matrix that is used once: filled, then eliminated together with its right-hand side. (D78)
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
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
  bool solve(Eigen::VectorXd& b) {
    for (int k = 0; k < size_; ++k)
      if (!eliminate(k, b)) return false;
    for (int k = size_ - 1; k >= 0; --k) {
      const double* row = &entries_[place(k, k)];
      const int last = std::min(2 * half, size_ - 1 - k);
      double sum = b[k];
      for (int c = 1; c <= last; ++c) sum -= row[c] * b[k + c];
      b[k] = sum / row[0];
    }
    return true;
  }

 private:
  // Row swaps fill six more diagonals above.
  static constexpr int stride = 3 * half + 2;
  static std::size_t place(int row, int column) { return static_cast<std::size_t>(row * stride + column - row + half); }

  bool eliminate(int k, Eigen::VectorXd& b) {
    const int below = std::min(half, size_ - 1 - k), right = std::min(2 * half, size_ - 1 - k);
    int pivot = k;
    for (int r = k + 1; r <= k + below; ++r)
      if (std::abs(entries_[place(r, k)]) > std::abs(entries_[place(pivot, k)])) pivot = r;
    double* top = &entries_[place(k, k)];
    if (pivot != k) {
      std::swap_ranges(top, top + right + 1, &entries_[place(pivot, k)]);
      std::swap(b[k], b[pivot]);
    }
    if (!(std::abs(top[0]) > 0) || !std::isfinite(top[0])) return false;
    for (int r = k + 1; r <= k + below; ++r) {
      double* row = &entries_[place(r, k)];
      if (row[0] == 0) continue;
      const double factor = row[0] / top[0];
      for (int c = 1; c <= right; ++c) row[c] -= factor * top[c];
      b[r] -= factor * b[k];
    }
    return true;
  }

  int size_;
  std::vector<double> entries_;
};

}  // namespace dynamics::line
