#include "band_matrix.hpp"

#include <cmath>

// Rows are updated twelve numbers at a time: the same binary uses what the machine has.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define FROUDE_EVERY_MACHINE __attribute__((target_clones("default", "arch=x86-64-v3")))
#else
#define FROUDE_EVERY_MACHINE
#endif

namespace dynamics::line {
namespace {

constexpr int half = BandMatrix::half, right = 2 * half;

/// Takes row `top` times row[0]/top[0] off `row`, both from their diagonal's column on.
inline double take_off(double* row, const double* top) {
  const double factor = row[0] / top[0];
  for (int c = 1; c <= right; ++c) row[c] -= factor * top[c];
  return factor;
}

}  // namespace

/// `width` right-hand sides, row by row; a Width known beforehand needs no loop.
template <int Width>
[[gnu::always_inline]] inline bool BandMatrix::eliminate_in_place(double* rhs, int width) {
  if constexpr (Width > 0) width = Width;
  // Columns beyond the last are zero and stay so: every row has room for all its columns.
  for (int k = 0; k < size_; ++k) {
    const int below = std::min(half, size_ - 1 - k);
    double *top = &entries_[place(k, k)], *own = rhs + k * width;
    int pivot = 0;
    for (int r = 1; r <= below; ++r)
      if (std::abs(top[r * (stride - 1)]) > std::abs(top[pivot * (stride - 1)])) pivot = r;
    if (pivot != 0) {
      std::swap_ranges(top, top + right + 1, top + pivot * (stride - 1));
      std::swap_ranges(own, own + width, own + pivot * width);
    }
    if (!(std::abs(top[0]) > 0) || !std::isfinite(top[0])) return false;
    for (int r = 1; r <= below; ++r) {
      double* row = top + r * (stride - 1);
      if (row[0] == 0) continue;
      const double factor = take_off(row, top);
      for (int c = 0; c < width; ++c) own[r * width + c] -= factor * own[c];
    }
  }
  for (int k = size_ - 1; k >= 0; --k) {
    const double* row = &entries_[place(k, k)];
    const int last = std::min(right, size_ - 1 - k);
    for (int c = 0; c < width; ++c) {
      double sum = rhs[k * width + c];
      for (int j = 1; j <= last; ++j) sum -= row[j] * rhs[(k + j) * width + c];
      rhs[k * width + c] = sum / row[0];
    }
  }
  return true;
}

FROUDE_EVERY_MACHINE bool BandMatrix::eliminate_one(double* rhs) { return eliminate_in_place<1>(rhs, 1); }
FROUDE_EVERY_MACHINE bool BandMatrix::eliminate(double* rhs, int width) { return eliminate_in_place<0>(rhs, width); }

bool BandMatrix::solve(Eigen::VectorXd& b) { return eliminate_one(b.data()); }
bool BandMatrix::solve(Columns& b) { return eliminate(b.data(), static_cast<int>(b.cols())); }

}  // namespace dynamics::line
