#include "exterior.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "bessel.hpp"
#include "tails.hpp"

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;

/// K_m/(κ K_m′) at r = a.
double radial_ratio(int m, double kappa, double radius) {
  std::vector<double> ratio(static_cast<std::size_t>(m + 1));
  bessel_k_over_slope(kappa * radius, ratio);
  return ratio.back() / kappa;
}

}  // namespace

Exterior::Exterior(const VerticalModes& modes, double radius, double draught, const GapBasis* basis)
    : modes_(modes),
      basis_(basis),
      a_(radius),
      d_(draught),
      h_(modes.depth),
      b_(basis != nullptr ? modes.depth - draught : 0),
      gap_(basis != nullptr ? basis->size() : 0),
      X_(gap_ + 2, static_cast<Index>(modes.kappa.size()) + 1) {
  X_.col(0) = wave_column();
  for (Index n = 1; n < X_.cols(); ++n) X_.col(n) = column(static_cast<int>(n));
}

// All divided by e^{kh}. ∫ cosh k(z+h) and ∫ z cosh k(z+h) over the side, as products that do not cancel.
VectorXd Exterior::wave_column() const {
  VectorXd x = VectorXd::Zero(gap_ + 2);
  if (!modes_.has_wave()) return x;
  const double k = modes_.k, to_edge = std::exp(-k * (h_ - b_)), root = std::sqrt(modes_.wave_norm_scaled());
  if (gap_ > 0) {
    std::vector<double> values(static_cast<std::size_t>(gap_));
    basis_->cosh_scaled(k * b_, values);
    x.head(gap_) = to_edge / root * Eigen::Map<VectorXd>(values.data(), gap_);
  }
  const double side = h_ - b_;
  const double sum = std::exp(-k * (h_ + b_)), half = -std::expm1(-k * side) / 2;  // e^{−k·side/2} sinh(k·side/2)
  const double sinh_difference = (1 + sum) * half, cosh_difference = (1 - sum) * half;
  const double sinh_edge = to_edge * -std::expm1(-2 * k * b_) / 2;
  x(gap_) = sinh_difference / (k * h_ * root);
  x(gap_ + 1) = (side * sinh_edge - cosh_difference / k) / (k * h_ * root);
  return x;
}

VectorXd Exterior::column(int n) const {
  VectorXd x(gap_ + 2);
  const double kappa = modes_.kappa[static_cast<std::size_t>(n - 1)], root = std::sqrt(modes_.norm(kappa));
  if (gap_ > 0) {
    std::vector<double> values(static_cast<std::size_t>(gap_));
    basis_->cosine(kappa * b_, values);
    x.head(gap_) = Eigen::Map<VectorXd>(values.data(), gap_) / root;
  }
  const double sin_edge = std::sin(kappa * b_), cos_edge = std::cos(kappa * b_);
  x(gap_) = (modes_.sin_at_surface(n) - sin_edge) / (kappa * h_ * root);
  x(gap_ + 1) = ((h_ - b_) * sin_edge + (modes_.cos_at_surface(n) - cos_edge) / kappa) / (kappa * h_ * root);
  return x;
}

// cos κh = (−1)^n κ/√(κ²+K²) and sin κh = −(−1)^n K/√(κ²+K²), by (C1). Without a gap what swings is smooth and falls as
// n⁻⁵ in the sums: left out.
Exterior::Asymptotic Exterior::asymptotic(double n) const {
  const double kappa = evanescent_root(n, modes_.K, h_), root = std::sqrt(modes_.norm(kappa));
  Asymptotic x{kappa, Eigen::VectorXcd::Zero(gap_ + 2), VectorXd::Zero(gap_ + 2)};
  for (Index p = 0; p < gap_; ++p) x.swinging(p) = basis_->cosine_amplitude(static_cast<int>(p), kappa * b_) / root;
  const double scale = 1 / (kappa * h_ * root);
  if (gap_ > 0) x.swinging(gap_) = Complex(0, scale);
  if (gap_ > 0) x.swinging(gap_ + 1) = Complex(-scale / kappa, -scale * d_);
  const double kappa_over_K = std::isinf(modes_.K) ? 0 : kappa / modes_.K;
  x.alternating(gap_) = -scale / std::hypot(kappa_over_K, 1.0);
  x.alternating(gap_ + 1) = scale / kappa * kappa_over_K / std::hypot(kappa_over_K, 1.0);
  return x;
}

double Exterior::decay(Index row) const { return row < gap_ ? basis_->decay(static_cast<int>(row)) : 1; }

MatrixXcd Exterior::sum(int m, const RadialFunctions& radial) const {
  const Index N = X_.cols() - 1;
  VectorXd q(N);
  for (Index n = 0; n < N; ++n) q(n) = radial.ratio(m, static_cast<int>(n) + 1);
  MatrixXd G = X_.rightCols(N) * q.asDiagonal() * X_.rightCols(N).transpose();
  add_smooth_tail(m, G);
  if (gap_ > 0) add_swinging_tail(m, G);
  return G.cast<Complex>() + radial.wave_ratio(m) * (X_.col(0) * X_.col(0).transpose()).cast<Complex>();
}

void Exterior::add_smooth_tail(int m, MatrixXd& G) const {
  const int last = static_cast<int>(X_.cols()) - 1;
  const auto points = SmoothTail::points(last);
  std::array<MatrixXd, 4> f;
  for (std::size_t i = 0; i < 4; ++i) {
    const Asymptotic x = asymptotic(points[i]);
    f[i] = radial_ratio(m, x.kappa, a_) *
           (0.5 * (x.swinging * x.swinging.adjoint()).real() + x.alternating * x.alternating.transpose());
  }
  for (Index r = 0; r < G.rows(); ++r)
    for (Index s = 0; s < G.cols(); ++s) {
      const SmoothTail tail(last, 1 + decay(r) + decay(s));
      for (std::size_t i = 0; i < 4; ++i) G(r, s) += tail.weight[i] * f[i](r, s);
    }
}

// Two phases per step of n: 2πb/h from the product of two swinging rows, π + πb/h from one with an alternating row.
void Exterior::add_swinging_tail(int m, MatrixXd& G) const {
  const int last = static_cast<int>(X_.cols()) - 1;
  std::array<MatrixXcd, 3> twice, once;
  for (std::size_t i = 0; i < 3; ++i) {
    const double n = last + 1 + static_cast<double>(i);
    const Asymptotic x = asymptotic(n);
    const double q = radial_ratio(m, x.kappa, a_);
    const Complex slow = std::polar(1.0, (x.kappa - n * pi / h_) * b_);  // e^{iκb} without its regular turning
    twice[i] = 0.5 * q * slow * slow * (x.swinging * x.swinging.transpose());
    const MatrixXcd mixed = x.swinging * x.alternating.transpose().cast<Complex>();
    once[i] = q * slow * (mixed + mixed.transpose());
  }
  for (Index r = 0; r < G.rows(); ++r)
    for (Index s = 0; s < G.cols(); ++s) {
      G(r, s) += oscillating_tail(last, 2 * pi * b_ / h_, {twice[0](r, s), twice[1](r, s), twice[2](r, s)}).real();
      G(r, s) += oscillating_tail(last, pi + pi * b_ / h_, {once[0](r, s), once[1](r, s), once[2](r, s)}).real();
    }
}

}  // namespace hydro::cylinders
