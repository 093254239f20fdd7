#include "truncated.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bessel.hpp"
#include "exterior.hpp"
#include "hydro/base/dense.hpp"
#include "tails.hpp"

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;

/// Terms after which the asymptotic forms of the tails hold: the argument of every Bessel function is then beyond this,
/// and beyond the square of the highest order.
double asymptotic_argument(const GapBasis& basis) {
  return std::max(300.0, 2 * basis.highest_order() * basis.highest_order());
}

/// (τ², cos jπτ) over 0 … 1, for real j without the sign (−1)^j.
double square_amplitude(double j) { return 2 / (j * pi * j * pi); }

/// Combinations of the functions, one a column, that a symmetric matrix tells apart, each of energy ±1. Three families
/// of many functions are all but dependent; what rounding leaves of those that differ by less than it would go into
/// energy and Haskind's relation, differently on every machine. A smaller set of functions keeps both.
MatrixXd told_apart(const MatrixXd& energy) {
  constexpr double least = 1e-14;  // of the largest: rounding of the sums, and what nine digits still need
  const VectorXd scale = energy.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  const auto [values, vectors] = dense::symmetric_eigen(scale.asDiagonal() * energy * scale.asDiagonal());
  const VectorXd size = values.cwiseAbs();
  MatrixXd out(energy.rows(), energy.rows());
  Index count = 0;
  for (Index i = 0; i < size.size(); ++i)
    if (size(i) > least * size.maxCoeff()) out.col(count++) = scale.cwiseProduct(vectors.col(i)) / std::sqrt(size(i));
  return out.leftCols(count);
}

}  // namespace

TruncatedCylinder::TruncatedCylinder(double radius, double draught, double depth, int gap_functions, int orders)
    : a_(radius), d_(draught), h_(depth), b_(depth - draught), basis_(gap_functions) {
  build_interior(orders);
}

int TruncatedCylinder::exterior_terms(double K) const {
  const double reach = std::max(asymptotic_argument(basis_) / b_, 300 / std::min(a_, d_));
  return count_of_terms(std::max(reach, std::isinf(K) ? 0 : 30 * K) * h_ / pi);
}

// H_m = Σ_j ε_j g_j Y_j Y_jᵀ, g_j = I_m/(λ_j I_m′) at λ_j a, λ_j = jπ/b; j = 0 belongs to it for m > 0 only.
void TruncatedCylinder::build_interior(int orders) {
  const Index P = basis_.size(), rows = P + 1;
  const int last =
      static_cast<int>(std::ceil(std::max(asymptotic_argument(basis_) / pi, 300 * b_ / (pi * std::min(a_, b_)))));
  MatrixXd Y(rows, last), g(orders, last);
  std::vector<double> slope(static_cast<std::size_t>(orders)), values(static_cast<std::size_t>(P));
  for (int j = 1; j <= last; ++j) {
    basis_.cosine(j * pi, values);
    Y.col(j - 1).head(P) = Eigen::Map<VectorXd>(values.data(), P);
    Y(P, j - 1) = (j % 2 == 0 ? 1 : -1) * square_amplitude(j);
    bessel_i_over_slope(j * pi * a_ / b_, slope);
    for (int m = 0; m < orders; ++m) g(m, j - 1) = 2 * b_ / (j * pi) * slope[static_cast<std::size_t>(m)];
  }
  VectorXd Y0(rows);
  for (Index p = 0; p < P; ++p) Y0(p) = basis_.mean(static_cast<int>(p));
  Y0(P) = 1.0 / 3;
  for (int m = 0; m < orders; ++m) {
    interior_.emplace_back(Y * g.row(m).asDiagonal() * Y.transpose());
    if (m > 0) interior_.back() += a_ / m * Y0 * Y0.transpose();
  }
  add_interior_tail(orders, last);
}

// Between integers (−1)^j is left out of both factors, so every product is a smooth function of j.
void TruncatedCylinder::add_interior_tail(int orders, int last) {
  const Index P = basis_.size(), rows = P + 1;
  const auto points = SmoothTail::points(last);
  MatrixXd Y(rows, 4), g(orders, 4);
  std::vector<double> slope(static_cast<std::size_t>(orders));
  for (Index i = 0; i < 4; ++i) {
    const double j = points[static_cast<std::size_t>(i)];
    for (Index p = 0; p < P; ++p) Y(p, i) = basis_.cosine_amplitude(static_cast<int>(p), j * pi).real();
    Y(P, i) = square_amplitude(j);
    bessel_i_over_slope(j * pi * a_ / b_, slope);
    for (int m = 0; m < orders; ++m) g(m, i) = 2 * b_ / (j * pi) * slope[static_cast<std::size_t>(m)];
  }
  const auto decay = [&](Index r) { return r < P ? basis_.decay(static_cast<int>(r)) : 2.0; };
  for (Index r = 0; r < rows; ++r)
    for (Index s = 0; s < rows; ++s) {
      const SmoothTail tail(last, 1 + decay(r) + decay(s));
      for (int m = 0; m < orders; ++m)
        for (Index i = 0; i < 4; ++i)
          interior_[static_cast<std::size_t>(m)](r, s) +=
              tail.weight[static_cast<std::size_t>(i)] * g(m, i) * Y(r, i) * Y(s, i);
    }
}

Scatterer TruncatedCylinder::at(const VerticalModes& modes, int orders, int channels) const {
  ensure(orders <= static_cast<int>(interior_.size()), "orders of the interior");
  const RadialFunctions radial(modes, a_, orders, channels);
  const Exterior outside(modes, a_, d_, &basis_);
  Scatterer s;
  for (int m = 0; m < orders; ++m) s.order.push_back(solve(m, outside, radial, channels));
  return s;
}

MatrixXd TruncatedCylinder::forcing(int m) const {
  const Index P = basis_.size();
  MatrixXd f = MatrixXd::Zero(P, m == 0 ? 1 : m == 1 ? 2 : 0);
  for (Index p = 0; p < P; ++p) {
    const double mean = basis_.mean(static_cast<int>(p)), square = basis_.second_moment(static_cast<int>(p));
    if (m == 0) f(p, 0) = -(b_ * b_ * square - a_ * a_ / 2 * mean) / (2 * b_);
    if (m == 1)
      f(p, 1) = (a_ * b_ * b_ * square - a_ * a_ * a_ / 4 * mean) / (2 * b_) - b_ / 2 * interior_[1](p, P) +
                3 * a_ * a_ * a_ / (8 * b_) * mean;
  }
  return f;
}

MatrixXd TruncatedCylinder::inner_loads(int m) const {
  const double a2 = a_ * a_, b2 = b_ * b_;
  if (m == 0) {
    const double bottom = -(b2 * a2 / 2 - a2 * a2 / 8) / (2 * b_);
    return MatrixXd::Constant(1, 1, bottom - a2 / 4 * (b2 / 3 - a2 / 2) / b_);
  }
  MatrixXd L = MatrixXd::Zero(2, 2);
  const double bottom = -(b2 * a2 * a2 / 4 - a2 * a2 * a2 / 24) / (2 * b_);
  const double edge = a_ * (b2 * b2 / 5 - a2 * b2 / 3 + 3 * a2 * a2 / 16) / (4 * b2);
  const double c = 3 * a2 / (8 * b_);
  const double series = b2 / 4 * interior_[1](basis_.size(), basis_.size()) - b_ * c * a_ / 3 + c * c * a_;
  L(1, 1) = bottom + a_ * b_ * (edge - series);
  return L;
}

/// The Galerkin matrix of (C6).
MatrixXcd TruncatedCylinder::galerkin(int m, const MatrixXcd& G) const {
  const Index P = basis_.size();
  return interior_[static_cast<std::size_t>(m)].topLeftCorner(P, P) - b_ / h_ * G.topLeftCorner(P, P);
}

/// The same in the functions that are columns of Q; for m = 0 bordered by the condition on the flux through the gap.
MatrixXcd TruncatedCylinder::system(int m, const MatrixXcd& G, const MatrixXd& Q) const {
  const Index P = Q.cols(), size = m == 0 ? P + 1 : P;
  MatrixXcd A = MatrixXcd::Zero(size, size);
  const MatrixXcd complex_Q = Q.cast<Complex>();
  A.topLeftCorner(P, P) = complex_Q.transpose() * galerkin(m, G) * complex_Q;
  if (m != 0) return A;
  VectorXd mean(basis_.size());
  for (Index p = 0; p < mean.size(); ++p) mean(p) = basis_.mean(static_cast<int>(p));
  A.col(P).head(P) = (Q.transpose() * mean).cast<Complex>();
  A.row(P).head(P) = A.col(P).head(P).transpose();
  return A;
}

AzimuthalOrder TruncatedCylinder::solve(int m, const Exterior& outside, const RadialFunctions& radial,
                                        int channels) const {
  const Index N = channels, motions = m == 0 ? 1 : m == 1 ? 2 : 0;
  const MatrixXcd G = outside.sum(m, radial);
  const MatrixXd Q = told_apart(galerkin(m, G).real());
  const Index P = Q.cols(), all = basis_.size();
  const MatrixXcd A = system(m, G, Q);
  const dense::ComplexLu lu(A);
  const MatrixXcd W = (Q.transpose() * outside.rows().topLeftCorner(all, N)).cast<Complex>();

  MatrixXcd rhs = MatrixXcd::Zero(A.rows(), motions);  // unit velocities
  MatrixXcd force = forcing(m).cast<Complex>();
  if (m == 1) force += G.block(0, all, all, 2);
  rhs.topRows(P) = Q.cast<Complex>().transpose() * force;
  if (m == 0) rhs(P, 0) = -a_ / (2 * b_);
  MatrixXcd struck = MatrixXcd::Zero(A.rows(), N);  // unit incident amplitudes, without ψ_n
  struck.topRows(P) = W;
  const MatrixXcd struck_gap = lu.solve(struck);
  MatrixXcd moved_gap(A.rows(), motions);
  if (motions > 0) moved_gap = lu.solve(rhs);  // Eigen must not be asked for nothing

  MatrixXcd side = MatrixXcd::Zero(N, motions);  // s_n
  if (m == 1) side = outside.rows().block(all, 0, 2, N).transpose().cast<Complex>();
  AzimuthalOrder o;
  o.T = b_ / h_ * (W.transpose() * struck_gap.topRows(P));
  o.R = b_ / h_ * (W.transpose() * moved_gap.topRows(P)) + side;
  o.E = a_ * h_ * side.transpose() + a_ * b_ * (rhs.transpose() * struck_gap);
  to_amplitudes(o, m, radial, a_);
  o.L = MatrixXcd::Zero(motions, motions);
  if (motions > 0) o.L = a_ * b_ * (rhs.transpose() * moved_gap) + inner_loads(m);
  if (m == 1) o.L += a_ * h_ * G.block(all, all, 2, 2);
  return o;
}

}  // namespace hydro::cylinders
