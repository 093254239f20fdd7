#include "algebra/complex_lu.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algebra/machine.hpp"

// P A = L U by halves of columns, so that nearly all of the work is products of blocks (Toledo 1997). Real and
// imaginary parts stand apart, row by row: four columns are one vector, and no product has to turn parts round.
namespace dynamics {
namespace {

using Eigen::Index;
using Complex = std::complex<double>;
constexpr Index strip = 4;  // columns of a vector

/// Where a block of a matrix begins.
struct Block {
  double *re, *im;
  Index stride;

  Block at(Index row, Index column) const { return {re + row * stride + column, im + row * stride + column, stride}; }
  Complex operator()(Index row, Index column) const { return {re[row * stride + column], im[row * stride + column]}; }
  void set(Index row, Index column, Complex value) const {
    re[row * stride + column] = value.real();
    im[row * stride + column] = value.imag();
  }
};

/// A matrix with rows padded by zeros to whole vectors.
class Planes {
 public:
  explicit Planes(const Eigen::Ref<const Eigen::MatrixXcd>& m)
      : stride_((m.cols() + strip - 1) / strip * strip), numbers_(static_cast<std::size_t>(2 * m.rows() * stride_)) {
    const Block b = block(m.rows());
    for (Index c = 0; c < m.cols(); ++c)
      for (Index r = 0; r < m.rows(); ++r) b.set(r, c, m(r, c));
  }
  Block block(Index rows) { return {numbers_.data(), numbers_.data() + rows * stride_, stride_}; }
  Index stride() const { return stride_; }

 private:
  Index stride_;
  std::vector<double> numbers_;
};

Four& four(double* at) { return *reinterpret_cast<Four*>(at); }

/// Takes L U off `Rows` rows of C: L (Rows, depth), U packed strip by strip.
template <int Rows>
[[gnu::always_inline]] inline void take_off_rows(const Block& L, const double* packed, const Block& C, Index depth,
                                                 Index width) {
  for (Index c = 0; c < width; c += strip) {
    Four re[Rows], im[Rows];
    for (int r = 0; r < Rows; ++r) re[r] = four(C.re + r * C.stride + c), im[r] = four(C.im + r * C.stride + c);
    for (Index s = 0; s < depth; ++s, packed += 2 * strip) {
      const Four u_re = *reinterpret_cast<const Four*>(packed), u_im = *reinterpret_cast<const Four*>(packed + strip);
      for (int r = 0; r < Rows; ++r) {
        const double l_re = L.re[r * L.stride + s], l_im = L.im[r * L.stride + s];
        re[r] -= l_re * u_re;
        im[r] -= l_re * u_im;
        re[r] += l_im * u_im;
        im[r] -= l_im * u_re;
      }
    }
    for (int r = 0; r < Rows; ++r) four(C.re + r * C.stride + c) = re[r], four(C.im + r * C.stride + c) = im[r];
  }
}

/// Rows of U strip by strip, real parts before imaginary ones, as take_off_rows() reads them.
void pack(const Block& U, Index depth, Index width, double* out) {
  for (Index c = 0; c < width; c += strip)
    for (Index s = 0; s < depth; ++s, out += 2 * strip) {
      std::copy_n(U.re + s * U.stride + c, strip, out);
      std::copy_n(U.im + s * U.stride + c, strip, out + strip);
    }
}

FROUDE_EVERY_MACHINE
void take_off_packed(const Block& L, const double* packed, const Block& C, Index rows, Index depth, Index width) {
  Index r = 0;
  for (; r + 4 <= rows; r += 4) take_off_rows<4>(L.at(r, 0), packed, C.at(r, 0), depth, width);
  for (; r < rows; ++r) take_off_rows<1>(L.at(r, 0), packed, C.at(r, 0), depth, width);
}

/// C −= L U, in pieces whose U stays in the second-level cache.
void take_off(const Block& L, const Block& U, const Block& C, Index rows, Index depth, Index width) {
  constexpr Index deep = 64, wide = 256;
  thread_local std::vector<double> packed(2 * deep * wide);
  for (Index c = 0; c < width; c += wide)
    for (Index s = 0; s < depth; s += deep) {
      const Index columns = std::min(wide, width - c), steps = std::min(deep, depth - s);
      pack(U.at(s, c), steps, columns, packed.data());
      take_off_packed(L.at(0, s), packed.data(), C.at(0, c), rows, steps, columns);
    }
}

/// Takes row `from` times a factor off row `row`.
[[gnu::always_inline]] inline void subtract(const Block& B, Index row, Complex factor, Index from, Index width) {
  double *re = B.re + row * B.stride, *im = B.im + row * B.stride;
  const double *u_re = B.re + from * B.stride, *u_im = B.im + from * B.stride;
  const double l_re = factor.real(), l_im = factor.imag();
  for (Index c = 0; c < width; ++c) {
    const double x = u_re[c], y = u_im[c];
    re[c] -= l_re * x - l_im * y;
    im[c] -= l_re * y + l_im * x;
  }
}
[[gnu::always_inline]] inline void scale(const Block& B, Index row, Complex factor, Index width) {
  double *re = B.re + row * B.stride, *im = B.im + row * B.stride;
  for (Index c = 0; c < width; ++c) {
    const double x = re[c], y = im[c];
    re[c] = x * factor.real() - y * factor.imag();
    im[c] = x * factor.imag() + y * factor.real();
  }
}

FROUDE_EVERY_MACHINE
void solve_few_lower(const Block& L, const Block& B, Index n, Index width) {
  for (Index r = 1; r < n; ++r)
    for (Index s = 0; s < r; ++s) subtract(B, r, L(r, s), s, width);
}
/// The diagonal of U holds reciprocals.
FROUDE_EVERY_MACHINE
void solve_few_upper(const Block& U, const Block& B, Index n, Index width) {
  for (Index r = n - 1; r >= 0; --r) {
    for (Index s = r + 1; s < n; ++s) subtract(B, r, U(r, s), s, width);
    scale(B, r, U(r, r), width);
  }
}

/// Where n rows or columns are cut in two.
Index half(Index n) { return (n / 2 + strip - 1) / strip * strip; }

/// B becomes L⁻¹ B, of the n rows of a unit lower triangle.
void solve_lower(const Block& L, const Block& B, Index n, Index width) {
  if (n <= strip) return solve_few_lower(L, B, n, width);
  const Index h = half(n);
  solve_lower(L, B, h, width);
  take_off(L.at(h, 0), B, B.at(h, 0), n - h, h, width);
  solve_lower(L.at(h, h), B.at(h, 0), n - h, width);
}
void solve_upper(const Block& U, const Block& B, Index n, Index width) {
  if (n <= strip) return solve_few_upper(U, B, n, width);
  const Index h = half(n);
  solve_upper(U.at(h, h), B.at(h, 0), n - h, width);
  take_off(U.at(0, h), B.at(h, 0), B, h, n - h, width);
  solve_upper(U, B, h, width);
}

/// The factors of a square matrix, in place of it; the diagonal of U as reciprocals.
class Elimination {
 public:
  Elimination(const Block& A, Index n) : A_(A), n_(n) { columns(0, n); }
  std::vector<Index> swapped;  ///< row k was exchanged with that one

 private:
  /// Columns from … to − 1, of rows from `from` on.
  void columns(Index from, Index to) {
    if (to - from <= strip) return few_columns(from, to);
    const Index middle = from + half(to - from), width = to - middle;
    columns(from, middle);
    solve_lower(A_.at(from, from), A_.at(from, middle), middle - from, padded(width));
    take_off(A_.at(middle, from), A_.at(from, middle), A_.at(middle, middle), n_ - middle, middle - from,
             padded(width));
    columns(middle, to);
  }
  static Index padded(Index width) { return (width + strip - 1) / strip * strip; }

  void few_columns(Index from, Index to) {
    for (Index k = from; k < to; ++k) {
      exchange(k, pivot(k));
      const Complex reciprocal = 1.0 / A_(k, k);
      for (Index r = k + 1; r < n_; ++r) {
        scale(A_.at(0, k), r, reciprocal, 1);
        subtract(A_.at(0, k + 1), r, A_(r, k), k, to - k - 1);
      }
      A_.set(k, k, reciprocal);
    }
  }
  Index pivot(Index k) const {
    Index best = k;
    for (Index r = k + 1; r < n_; ++r)
      if (std::norm(A_(r, k)) > std::norm(A_(best, k))) best = r;
    return best;
  }
  void exchange(Index k, Index with) {
    swapped.push_back(with);
    if (with == k) return;
    std::swap_ranges(A_.re + k * A_.stride, A_.re + (k + 1) * A_.stride, A_.re + with * A_.stride);
    std::swap_ranges(A_.im + k * A_.stride, A_.im + (k + 1) * A_.stride, A_.im + with * A_.stride);
  }

  Block A_;
  Index n_;
};

}  // namespace

struct ComplexLu::Factors {
  explicit Factors(const Eigen::MatrixXcd& A)
      : n(A.rows()),
        norm(A.cwiseAbs().colwise().sum().maxCoeff()),
        planes(A),
        lu(planes.block(n)),
        swapped(Elimination(lu, n).swapped) {}

  Index n;
  double norm;
  Planes planes;
  Block lu;
  std::vector<Index> swapped;

  Eigen::MatrixXcd solve(Eigen::MatrixXcd b) const {
    for (Index k = 0; k < n; ++k)
      if (const Index with = swapped[static_cast<std::size_t>(k)]; with != k) b.row(k).swap(b.row(with));
    Planes right(b);
    const Block x = right.block(n);
    solve_lower(lu, x, n, right.stride());
    solve_upper(lu, x, n, right.stride());
    for (Index c = 0; c < b.cols(); ++c)
      for (Index r = 0; r < n; ++r) b(r, c) = x(r, c);
    return b;
  }

  /// (A*)⁻¹ b: U* first, whose rows are columns.
  Eigen::VectorXcd solve_adjoint(Eigen::VectorXcd b) const {
    for (Index k = 0; k < n; ++k) {
      b[k] *= std::conj(lu(k, k));
      for (Index c = k + 1; c < n; ++c) b[c] -= std::conj(lu(k, c)) * b[k];
    }
    for (Index k = n - 1; k > 0; --k)
      for (Index c = 0; c < k; ++c) b[c] -= std::conj(lu(k, c)) * b[k];
    for (Index k = n - 1; k >= 0; --k) std::swap(b[k], b[swapped[static_cast<std::size_t>(k)]]);
    return b;
  }

  /// ‖A⁻¹‖₁, estimated from below: up the gradient of ‖A⁻¹x‖₁ from corner to corner of the x with ‖x‖₁ = 1 (Hager
  /// 1984).
  double size_of_inverse() const {
    constexpr int corners = 5;
    Eigen::VectorXcd x = Eigen::VectorXcd::Constant(n, 1.0 / static_cast<double>(n));
    double size = 0;
    for (int k = 0; k < corners; ++k) {
      const Eigen::VectorXcd y = solve(x);
      if (!y.allFinite()) return std::numeric_limits<double>::infinity();
      if (const double now = y.lpNorm<1>(); now > size)
        size = now;
      else
        break;
      Index corner = 0;
      solve_adjoint(y.unaryExpr([](Complex v) { return v == 0.0 ? Complex(1) : v / std::abs(v); }))
          .cwiseAbs()
          .maxCoeff(&corner);
      x.setZero();
      x[corner] = 1;
    }
    return size;
  }

  /// The smallest pivot over ‖A‖₁, NaN where one is.
  double least_pivot() const {
    double least = std::numeric_limits<double>::infinity();
    for (Index k = 0; k < n; ++k)
      if (const double pivot = 1 / (std::abs(lu(k, k)) * norm); !(pivot >= least)) least = pivot;
    return least;
  }
};

ComplexLu::ComplexLu(const Eigen::MatrixXcd& A) : factors_(new Factors(A)) {}
ComplexLu::~ComplexLu() = default;
ComplexLu::ComplexLu(ComplexLu&&) noexcept = default;
Eigen::MatrixXcd ComplexLu::solve(const Eigen::MatrixXcd& b) const { return factors_->solve(b); }
double ComplexLu::rcond() const { return factors_->n == 0 ? 1 : 1 / (factors_->norm * factors_->size_of_inverse()); }

// Where the least pivot is that far above rounding A is not singular, and the estimate is spared its solutions.
bool ComplexLu::is_singular() const {
  constexpr double working_precision = 1e-15, far_above_rounding = 1e-6;
  return !(factors_->least_pivot() > far_above_rounding) && !(rcond() > working_precision);
}

}  // namespace dynamics
