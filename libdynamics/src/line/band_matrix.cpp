#include "band_matrix.hpp"

#include <cmath>
#include <cstddef>

#include "hydro/base/machine.hpp"

// Rows are updated four numbers at a time: the same binary uses what the machine has.
namespace dynamics::line {
namespace {

using hydro::Four;

/// Takes factor times `width` numbers off as many others.
[[gnu::always_inline]] inline void subtract(int width, double factor, const double* from, double* off) {
  int c = 0;
  for (; c + 4 <= width; c += 4) *reinterpret_cast<Four*>(off + c) -= factor * *reinterpret_cast<const Four*>(from + c);
  for (; c < width; ++c) off[c] -= factor * from[c];
}

/// Takes row `top` times row[0]/top[0] off `row`, both from their diagonal's column on.
template <int Half>
[[gnu::always_inline]] inline double take_off(double* row, const double* top) {
  const double factor = row[0] / top[0];
  subtract(2 * Half, factor, top + 1, row + 1);
  return factor;
}

/// Solves an eliminated row for all right-hand sides, its own and those of `last` rows below that have been solved.
[[gnu::always_inline]] inline void solve_row(const double* row, int last, int width, double* own) {
  int c = 0;
  for (; c + 4 <= width; c += 4) {
    Four sum = *reinterpret_cast<Four*>(own + c);
    for (int j = 1; j <= last; ++j) sum -= row[j] * *reinterpret_cast<const Four*>(own + j * width + c);
    *reinterpret_cast<Four*>(own + c) = sum / row[0];
  }
  for (; c < width; ++c) {
    double sum = own[c];
    for (int j = 1; j <= last; ++j) sum -= row[j] * own[j * width + c];
    own[c] = sum / row[0];
  }
}

/// `width` right-hand sides, row by row; a Width known beforehand needs no loop. `entries` as BandMatrix has them.
template <int Half, int Width>
[[gnu::always_inline]] inline bool eliminate_in_place(int size, double* entries, double* rhs, int width) {
  constexpr int right = 2 * Half, stride = 3 * Half + 2;
  if constexpr (Width > 0) width = Width;
  double* const first = entries + Half;  // on the diagonal
  // Columns beyond the last are zero and stay so: every row has room for all its columns.
  for (int k = 0; k < size; ++k) {
    const int below = std::min(Half, size - 1 - k);
    double *top = first + static_cast<std::ptrdiff_t>(k) * stride, *own = rhs + k * width;
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
      const double factor = take_off<Half>(row, top);
      subtract(width, factor, own, own + r * width);
    }
  }
  for (int k = size - 1; k >= 0; --k) {
    const double* row = first + static_cast<std::ptrdiff_t>(k) * stride;
    const int last = std::min(right, size - 1 - k);
    solve_row(row, last, width, rhs + k * width);
  }
  return true;
}

FROUDE_EVERY_MACHINE bool narrow_one(int size, double* entries, double* rhs) {
  return eliminate_in_place<6, 1>(size, entries, rhs, 1);
}
FROUDE_EVERY_MACHINE bool narrow_many(int size, double* entries, double* rhs, int width) {
  return eliminate_in_place<6, 0>(size, entries, rhs, width);
}
FROUDE_EVERY_MACHINE bool wide_one(int size, double* entries, double* rhs) {
  return eliminate_in_place<10, 1>(size, entries, rhs, 1);
}
FROUDE_EVERY_MACHINE bool wide_many(int size, double* entries, double* rhs, int width) {
  return eliminate_in_place<10, 0>(size, entries, rhs, width);
}

}  // namespace

bool BandMatrix::solve(Eigen::VectorXd& b) {
  return half_ == narrow ? narrow_one(size_, entries_.data(), b.data()) : wide_one(size_, entries_.data(), b.data());
}

bool BandMatrix::solve(Columns& b) {
  const auto width = static_cast<int>(b.cols());
  return half_ == narrow ? narrow_many(size_, entries_.data(), b.data(), width)
                         : wide_many(size_, entries_.data(), b.data(), width);
}

}  // namespace dynamics::line
