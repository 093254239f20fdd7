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

FROUDE_EVERY_MACHINE bool BandMatrix::solve(Eigen::VectorXd& b) {
  // Columns beyond the last are zero and stay so: every row has room for all its columns.
  double* rhs = b.data();
  for (int k = 0; k < size_; ++k) {
    const int below = std::min(half, size_ - 1 - k);
    double* top = &entries_[place(k, k)];
    int pivot = 0;
    for (int r = 1; r <= below; ++r)
      if (std::abs(top[r * (stride - 1)]) > std::abs(top[pivot * (stride - 1)])) pivot = r;
    if (pivot != 0) {
      std::swap_ranges(top, top + right + 1, top + pivot * (stride - 1));
      std::swap(rhs[k], rhs[k + pivot]);
    }
    if (!(std::abs(top[0]) > 0) || !std::isfinite(top[0])) return false;
    for (int r = 1; r <= below; ++r) {
      double* row = top + r * (stride - 1);
      if (row[0] != 0) rhs[k + r] -= take_off(row, top) * rhs[k];
    }
  }
  for (int k = size_ - 1; k >= 0; --k) {
    const double* row = &entries_[place(k, k)];
    double sum = rhs[k];
    const int last = std::min(right, size_ - 1 - k);
    for (int c = 1; c <= last; ++c) sum -= row[c] * rhs[k + c];
    rhs[k] = sum / row[0];
  }
  return true;
}

}  // namespace dynamics::line
