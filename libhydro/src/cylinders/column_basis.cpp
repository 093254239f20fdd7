#include "column_basis.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace hydro::cylinders {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using std::numbers::pi;

namespace {

/// (C17): P_i(1 − 2y) = Σ_l (−1)^l C(i,l) C(i+l,l) y^l.
MatrixXd legendre_monomials(int count) {
  MatrixXd c = MatrixXd::Zero(count, count);
  for (Index i = 0; i < count; ++i) {
    double term = 1;
    for (Index l = 0; l <= i; ++l) {
      c(i, l) = term;
      term *= -static_cast<double>((i - l) * (i + l + 1)) / static_cast<double>((l + 1) * (l + 1));
    }
  }
  return c;
}

/// P_0 … of 1 − 2y by their recurrence.
std::vector<double> legendre(double y, int count) {
  const double x = 1 - 2 * y;
  std::vector<double> P(static_cast<std::size_t>(std::max(2, count)));
  P[0] = 1;
  P[1] = x;
  for (std::size_t i = 2; i < P.size(); ++i) {
    const auto n = static_cast<double>(i);
    P[i] = ((2 * n - 1) * x * P[i - 1] - (n - 1) * P[i - 2]) / n;
  }
  return P;
}

}  // namespace

// y = s³ makes polynomials of s of all three families; panels hold two waves of e^{ixy} at most, which 20 points of
// Gauss integrate to rounding.
ColumnBasis::ColumnBasis(int per_family)
    : per_family_(per_family),
      far_(std::max(200.0, 6.0 * per_family * per_family)),
      monomial_(legendre_monomials(per_family)),
      taylor_(MatrixXd::Zero(3 * per_family, taylor_terms)) {
  using Gauss = boost::math::quadrature::gauss<double, 20>;
  const int panels = static_cast<int>(std::ceil(3 * far_ / (4 * pi)));
  node_.resize(size(), 20 * panels);
  Index column = 0;
  const auto add = [&](double s, double weight) {
    y_.push_back(s * s * s);
    const auto P = legendre(y_.back(), per_family_);
    for (int f = 0; f < 3; ++f)
      for (int i = 0; i < per_family_; ++i)
        node_(f * per_family_ + i, column) = 3 * weight * std::pow(s, 1 + f) * P[static_cast<std::size_t>(i)];
    ++column;
  };
  for (int panel = 0; panel < panels; ++panel)
    for (std::size_t j = 0; j < Gauss::abscissa().size(); ++j)
      for (const double sign : {-1.0, 1.0})
        add((panel + 0.5 + sign * Gauss::abscissa()[j] / 2) / panels, Gauss::weights()[j] / (2 * panels));
  // v(1 + ε) = (1 + ε)^α P_i(−1 − 2ε), and P_i(−x) = (−1)^i P_i(x).
  for (int f = 0; f < 3; ++f) {
    double binomial = 1;
    for (int k = 0; k < taylor_terms; ++k) {
      for (int i = 0; i < per_family_; ++i)
        for (int l = 0; l <= i && k + l < taylor_terms; ++l)
          taylor_(f * per_family_ + i, k + l) += (i % 2 == 0 ? 1 : -1) * binomial * std::abs(monomial_(i, l));
      binomial *= (powers[static_cast<std::size_t>(f)] - k) / (k + 1);
    }
  }
}

VectorXcd ColumnBasis::transform(double x) const {
  if (x > far_) return from_edge(x) + std::polar(1.0, x) * from_surface(x);
  VectorXcd out(size());
  out.real() = integral([x](double y) { return std::cos(x * y); });
  out.imag() = integral([x](double y) { return std::sin(x * y); });
  return out;
}

// ∫₀^∞ y^β e^{ixy} dy = Γ(β+1) (−ix)^{−β−1}
VectorXcd ColumnBasis::from_edge(double x) const {
  VectorXcd out(size());
  for (int f = 0; f < 3; ++f)
    for (int i = 0; i < per_family_; ++i) {
      const double alpha = powers[static_cast<std::size_t>(f)];
      Complex term = std::tgamma(alpha + 1) * std::pow(x, -alpha - 1) * std::polar(1.0, (alpha + 1) * pi / 2), sum = 0;
      for (int l = 0; l <= i; ++l) {
        sum += monomial_(i, l) * term;
        term *= (alpha + l + 1) / x * Complex(0, 1);
      }
      out(f * per_family_ + i) = sum;
    }
  return out;
}

// Integration by parts: Σ_k (−1)^k v^{(k)}(1)/(ix)^{k+1}, to the smallest term.
VectorXcd ColumnBasis::from_surface(double x) const {
  VectorXcd out(size());
  for (Index p = 0; p < out.size(); ++p) {
    Complex factor = 1.0 / Complex(0, x), sum = 0;
    double last = std::numeric_limits<double>::infinity();
    for (Index k = 0; k < taylor_terms; ++k) {
      const Complex term = factor * taylor_(p, k);
      if (std::abs(term) > last && k > per_family_) break;
      sum += term;
      if (std::abs(term) > 0) last = std::abs(term);
      factor *= -static_cast<double>(k + 1) / Complex(0, x);
    }
    out(p) = sum;
  }
  return out;
}

}  // namespace hydro::cylinders
