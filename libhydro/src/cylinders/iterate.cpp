#include "iterate.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::RowVectorXcd;
using Eigen::RowVectorXd;
using Eigen::VectorXcd;

RowVectorXcd products(const Amplitudes& a, const Amplitudes& b) {
  return a.conjugate().cwiseProduct(b).colwise().sum();
}

/// Takes the basis out of w, one vector after the other. What rounding leaves of it does no harm: the basis loses its
/// right angles no sooner than the residual is as small as rounding allows (Paige, Rozložník & Strakoš 2006).
/// \return the coefficients of each column, (basis, columns)
MatrixXcd orthogonalise(const std::vector<Amplitudes>& basis, Amplitudes& w) {
  MatrixXcd h(static_cast<Index>(basis.size()), w.cols());
  for (std::size_t i = 0; i < basis.size(); ++i) {
    const RowVectorXcd part = products(basis[i], w);
    w -= basis[i] * part.asDiagonal();
    h.row(static_cast<Index>(i)) = part;
  }
  return h;
}

/// Scales each column to one; a column of zeros stays.
RowVectorXd normalise(Amplitudes& w) {
  const RowVectorXd norm = w.colwise().norm();
  w *= norm.unaryExpr([](double n) { return n > 0 ? 1 / n : 0.0; }).cast<Complex>().asDiagonal();
  return norm;
}

/// The weights x that make ‖e₁ − H x‖ least for a Hessenberg matrix that grows by a column a step: H is kept as R,
/// turned by one rotation a step (Saad & Schultz 1986, section 3.2).
class Hessenberg {
 public:
  explicit Hessenberg(int most) : R_(MatrixXcd::Zero(most, most)), right_(VectorXcd::Unit(most + 1, 0)) {}

  /// The next column: `h` and below it `beyond`, which is not negative.
  void add(VectorXcd h, double beyond) {
    for (Index i = 0; i < size_; ++i) rotate(i, h(i), h(i + 1));
    const double length = std::hypot(std::abs(h(size_)), beyond);
    rotations_.push_back({h(size_) / length, beyond / length});
    R_.col(size_).head(size_) = h.head(size_);
    R_(size_, size_) = length;
    rotate(size_, right_(size_), right_(size_ + 1));
    ++size_;
  }
  double residual() const { return std::abs(right_(size_)); }
  VectorXcd weights() const {
    VectorXcd x = right_.head(size_);
    for (Index i = size_ - 1; i >= 0; --i) {
      x(i) /= R_(i, i);
      x.head(i) -= x(i) * R_.col(i).head(i);
    }
    return x;
  }

 private:
  struct Rotation {
    Complex c;
    double s;
  };
  void rotate(Index i, Complex& upper, Complex& lower) const {
    const auto [c, s] = rotations_[static_cast<std::size_t>(i)];
    const Complex turned = std::conj(c) * upper + s * lower;
    lower = c * lower - s * upper;
    upper = turned;
  }

  MatrixXcd R_;
  VectorXcd right_;
  std::vector<Rotation> rotations_;
  Index size_ = 0;
};

/// Each column's own sum of the basis, for right-hand sides of this size.
Amplitudes combined(const std::vector<Amplitudes>& basis, const std::vector<Hessenberg>& column,
                    const RowVectorXd& size) {
  Amplitudes x = Amplitudes::Zero(basis.front().rows(), basis.front().cols());
  for (std::size_t c = 0; c < column.size(); ++c) {
    const auto at = static_cast<Index>(c);
    const VectorXcd weight = size(at) * column[c].weights();
    for (Index i = 0; i < weight.size(); ++i) x.col(at) += weight(i) * basis[static_cast<std::size_t>(i)].col(at);
  }
  return x;
}

}  // namespace

std::optional<Iterated> iterate(const std::function<Amplitudes(const Amplitudes&)>& M, const Amplitudes& y,
                                double precision, int most) {
  Amplitudes first = y;
  const RowVectorXd size = normalise(first);
  std::vector<Amplitudes> basis{std::move(first)};
  std::vector<Hessenberg> column(static_cast<std::size_t>(y.cols()), Hessenberg(most));
  std::vector<bool> done(column.size());
  for (std::size_t c = 0; c < done.size(); ++c) done[c] = size(static_cast<Index>(c)) == 0;
  for (int step = 1; step <= most; ++step) {
    Amplitudes w = M(basis.back());
    const MatrixXcd h = orthogonalise(basis, w);
    const RowVectorXd beyond = normalise(w);
    for (std::size_t c = 0; c < column.size(); ++c) {
      if (done[c]) continue;
      column[c].add(h.col(static_cast<Index>(c)), beyond(static_cast<Index>(c)));
      done[c] = column[c].residual() <= precision;
    }
    if (std::all_of(done.begin(), done.end(), [](bool is) { return is; }))
      return Iterated{combined(basis, column, size), step};
    basis.push_back(std::move(w));
  }
  return {};
}

}  // namespace hydro::cylinders
