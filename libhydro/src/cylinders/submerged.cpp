#include "submerged.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "bessel.hpp"
#include "hydro/base/dense.hpp"
#include "row_tail.hpp"
#include "tails.hpp"

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using std::numbers::pi;

Index motions_of(int m) { return m == 0 ? 1 : m == 1 ? 2 : 0; }

/// e^{iκh} without its (−1)^n: Robin's condition at the surface (C1).
Complex at_surface(double kappa, double K) {
  const double over_K = std::isinf(K) ? 0 : kappa / K, length = std::hypot(over_K, 1.0);
  return {over_K / length, -1 / length};
}

/// e^{−kh} ∫ w(z) cosh k(z+h) dz from `low` to `high`.
template <class Weight>
double cosh_integral(double k, double h, double low, double high, Weight w) {
  const int panels = 1 + static_cast<int>(k * (high - low) / 5);
  double sum = 0;
  for (int i = 0; i < panels; ++i) {
    const double from = low + (high - low) * i / panels, to = low + (high - low) * (i + 1) / panels;
    sum += boost::math::quadrature::gauss<double, 20>::integrate(
        [&](double z) { return w(z) * (std::exp(k * z) + std::exp(-k * (z + 2 * h))) / 2; }, from, to);
  }
  return sum;
}

}  // namespace

/// Rows X of (C16) for all modes of the depth: gap below, opening above, side in surge and in pitch.
struct SubmergedCylinder::Outside {
  const SubmergedCylinder& c;
  const VerticalModes& modes;
  MatrixXd X;  ///< column 0: the wave
  std::optional<RowTail> tail;
  std::vector<std::vector<double>> tail_ratio;  ///< [m][point]: K_m/(κ K_m′)

  Outside(const SubmergedCylinder& cylinder, const VerticalModes& all, int orders)
      : c(cylinder), modes(all), X(c.openings() + 2, static_cast<Index>(all.kappa.size()) + 1) {
    X.col(0) = wave_column();
    for (Index n = 1; n < X.cols(); ++n) X.col(n) = column(static_cast<int>(n));
    const double z1 = c.h_ - c.d_, z2 = c.h_ - c.t_;
    tail.emplace(static_cast<int>(X.cols()) - 1, std::vector<double>{pi * z1 / c.h_, pi * z2 / c.h_, pi},
                 [this](double n) { return amplitudes(n); });
    tail_ratio.assign(static_cast<std::size_t>(orders), {});
    std::vector<double> ratio(static_cast<std::size_t>(orders));
    for (const double n : tail->points()) {
      const double kappa = evanescent_root(n, modes.K, c.h_);
      bessel_k_over_slope(kappa * c.a_, ratio);
      for (std::size_t m = 0; m < ratio.size(); ++m) tail_ratio[m].push_back(ratio[m] / kappa);
    }
  }

  VectorXd wave_column() const {
    VectorXd x = VectorXd::Zero(c.openings() + 2);
    if (!modes.has_wave()) return x;
    const double k = modes.k, b = c.h_ - c.d_, scale = 1 / (c.h_ * std::sqrt(modes.wave_norm_scaled()));
    if (c.below_) {
      std::vector<double> values(static_cast<std::size_t>(c.lower()));
      c.below_->basis().cosh_scaled(k * b, values);
      x.head(c.lower()) = scale * b * std::exp(-k * c.d_) * Eigen::Map<VectorXd>(values.data(), c.lower());
    }
    x.segment(c.lower(), c.column_.size()) = scale * c.t_ * c.column_.integral([&](double y) {
      const double z = -c.t_ * (1 - y);
      return (std::exp(k * z) + std::exp(-k * (z + 2 * c.h_))) / 2;
    });
    x(c.openings()) = scale * cosh_integral(k, c.h_, -c.d_, -c.t_, [](double) { return 1.0; });
    x(c.openings() + 1) = scale * cosh_integral(k, c.h_, -c.d_, -c.t_, [](double z) { return z; });
    return x;
  }

  VectorXd column(int n) const {
    VectorXd x(c.openings() + 2);
    const double kappa = modes.kappa[static_cast<std::size_t>(n - 1)], b = c.h_ - c.d_, z2 = c.h_ - c.t_;
    const double scale = 1 / (c.h_ * std::sqrt(modes.norm(kappa)));
    if (c.below_) {
      std::vector<double> values(static_cast<std::size_t>(c.lower()));
      c.below_->basis().cosine(kappa * b, values);
      x.head(c.lower()) = scale * b * Eigen::Map<VectorXd>(values.data(), c.lower());
    }
    x.segment(c.lower(), c.column_.size()) =
        scale * c.t_ * (std::polar(1.0, kappa * z2) * c.column_.transform(kappa * c.t_)).real();
    // ∫ cos κ(z+h) dz and ∫ z cos κ(z+h) dz over the side
    const double s1 = std::sin(kappa * b), s2 = std::sin(kappa * z2), c1 = std::cos(kappa * b),
                 c2 = std::cos(kappa * z2);
    x(c.openings()) = scale * (s2 - s1) / kappa;
    x(c.openings() + 1) = scale * (c.d_ * s1 - c.t_ * s2 + (c2 - c1) / kappa) / kappa;
    return x;
  }

  /// The same for large real n: what comes from the lower edge, the upper edge and the surface.
  std::vector<VectorXcd> amplitudes(double n) const {
    const double kappa = evanescent_root(n, modes.K, c.h_), b = c.h_ - c.d_, z2 = c.h_ - c.t_;
    const double scale = 1 / (c.h_ * std::sqrt(modes.norm(kappa))), off = kappa - n * pi / c.h_;
    VectorXcd lower = VectorXcd::Zero(c.openings() + 2), upper = lower, surface = lower;
    for (Index p = 0; p < c.lower(); ++p)
      lower(p) = scale * b * c.below_->basis().cosine_amplitude(static_cast<int>(p), kappa * b);
    lower(c.openings()) = scale / kappa * Complex(0, 1);
    lower(c.openings() + 1) = scale / kappa * Complex(-1 / kappa, -c.d_);
    upper.segment(c.lower(), c.column_.size()) = scale * c.t_ * c.column_.from_edge(kappa * c.t_);
    upper(c.openings()) = scale / kappa * Complex(0, -1);
    upper(c.openings() + 1) = scale / kappa * Complex(1 / kappa, c.t_);
    surface.segment(c.lower(), c.column_.size()) =
        (scale * c.t_ * (at_surface(kappa, modes.K) * c.column_.from_surface(kappa * c.t_)).real()).cast<Complex>();
    return {std::polar(1.0, off * b) * lower, std::polar(1.0, off * z2) * upper, surface};
  }

  MatrixXcd sum(int m, const RadialFunctions& radial) const {
    const Index N = X.cols() - 1;
    VectorXd q(N);
    for (Index n = 0; n < N; ++n) q(n) = radial.ratio(m, static_cast<int>(n) + 1);
    const MatrixXd G = X.rightCols(N) * q.asDiagonal() * X.rightCols(N).transpose() +
                       tail->sum(tail_ratio[static_cast<std::size_t>(m)]);
    return G.cast<Complex>() + radial.wave_ratio(m) * (X.col(0) * X.col(0).transpose()).cast<Complex>();
  }
};

/// The water above the top: H of (C18) for each order, rows: functions of the opening, then z + 1/K.
struct SubmergedCylinder::Column {
  double inverse_K;
  VectorXd mean, depth;  ///< ∫ v dy and ∫ v (1 − y) dy
  std::vector<MatrixXd> H;

  Column(const SubmergedCylinder& c, double K, int orders)
      : inverse_K(std::isinf(K) ? 0 : 1 / K),
        mean(c.column_.integral([](double) { return 1.0; })),
        depth(c.column_.integral([](double y) { return 1 - y; })) {
    const Index U = c.column_.size();
    const double reach = std::max(300 / std::min(c.a_, c.t_), std::isinf(K) ? 0 : 30 * K);
    const int terms = static_cast<int>(std::ceil(reach * c.t_ / pi)) + 4;
    const WaterDepth t = WaterDepth::from_metres(c.t_);
    const VerticalModes modes = std::isinf(K) ? VerticalModes::at_infinite_frequency(t, terms)
                                              : VerticalModes::at(std::sqrt(K), {.gravity = 1, .depth = t}, terms);
    MatrixXd Y(U + 1, terms), g(orders, terms);
    for (int j = 0; j < terms; ++j) {
      const double kappa = modes.kappa[static_cast<std::size_t>(j)], scale = 1 / std::sqrt(modes.norm(kappa));
      Y.col(j).head(U) = scale * c.column_.transform(kappa * c.t_).real();
      Y(U, j) = -scale / (c.t_ * kappa * kappa);
      g.col(j) = ratios(c.a_, kappa, orders);
    }
    const RowTail tail(terms, {0, pi}, [&](double n) { return amplitudes(c, modes, n); });
    std::vector<VectorXd> tail_g;
    for (const double n : tail.points()) tail_g.push_back(ratios(c.a_, evanescent_root(n, modes.K, c.t_), orders));
    for (int m = 0; m < orders; ++m) {
      std::vector<double> f;
      for (const VectorXd& at : tail_g) f.push_back(at(m));
      H.push_back(c.t_ / c.h_ * (Y * g.row(m).asDiagonal() * Y.transpose() + tail.sum(f)));
    }
    if (modes.has_wave()) add_wave(c, modes);
  }

  /// I_m/(κ I_m′) at r = a.
  static VectorXd ratios(double a, double kappa, int orders) {
    std::vector<double> ratio(static_cast<std::size_t>(orders));
    bessel_i_over_slope(kappa * a, ratio);
    return Eigen::Map<VectorXd>(ratio.data(), orders) / kappa;
  }

  static std::vector<VectorXcd> amplitudes(const SubmergedCylinder& c, const VerticalModes& modes, double n) {
    const Index U = c.column_.size();
    const double kappa = evanescent_root(n, modes.K, c.t_), scale = 1 / std::sqrt(modes.norm(kappa));
    VectorXcd edge(U + 1), surface = VectorXcd::Zero(U + 1);
    edge.head(U) = (scale * c.column_.from_edge(kappa * c.t_).real()).cast<Complex>();
    edge(U) = -scale / (c.t_ * kappa * kappa);
    surface.head(U) =
        (scale * (at_surface(kappa, modes.K) * c.column_.from_surface(kappa * c.t_)).real()).cast<Complex>();
    return {edge, surface};
  }

  /// The waves of the column: J_m(kr) cosh k(z+t), all divided by e^{kt}.
  void add_wave(const SubmergedCylinder& c, const VerticalModes& modes) {
    const Index U = c.column_.size();
    const double k = modes.k, scale = 1 / std::sqrt(modes.wave_norm_scaled());
    VectorXd y(U + 1);
    y.head(U) = scale * c.column_.integral([&](double x) {
      return (std::exp(-k * c.t_ * (1 - x)) + std::exp(-k * c.t_ * (1 + x))) / 2;
    });
    y(U) = scale * std::exp(-k * c.t_) / (c.t_ * k * k);
    std::vector<double> J(H.size() + 1);
    bessel_j_sequence(0, k * c.a_, J);
    for (std::size_t m = 0; m < H.size(); ++m) {
      const double slope = static_cast<double>(m) / c.a_ * J[m] - k * J[m + 1];
      H[m] += c.t_ / c.h_ * J[m] / slope * y * y.transpose();
    }
  }
};

SubmergedCylinder::SubmergedCylinder(double radius, double top, std::optional<double> draught, double depth,
                                     int gap_functions, int orders)
    : a_(radius), t_(top), d_(draught.value_or(depth)), h_(depth), column_(gap_functions) {
  if (draught) below_.emplace(radius, *draught, depth, gap_functions, orders);
}

int SubmergedCylinder::exterior_terms(double K) const {
  const double reach = std::max({300 / std::min(a_, t_), 100 / (d_ - t_), std::isinf(K) ? 0 : 30 * K});
  const int own = count_of_terms(reach * h_ / pi);
  return below_ ? std::max(own, below_->exterior_terms(K)) : own;
}

Scatterer SubmergedCylinder::at(const VerticalModes& modes, int orders, int channels) const {
  const RadialFunctions radial(modes, a_, orders, channels);
  const Outside outside(*this, modes, orders);
  const Column above(*this, modes.K, orders);
  Scatterer s;
  for (int m = 0; m < orders; ++m) s.order.push_back(solve(m, outside, above, radial, channels));
  return s;
}

/// Part of the right-hand side that the exterior does not give, (C19): gap, opening, and the gap's flux for m = 0.
MatrixXd SubmergedCylinder::forcing(int m, const Column& above) const {
  const Index P = lower(), U = column_.size();
  MatrixXd f = MatrixXd::Zero(P + U + (m == 0 && below_ ? 1 : 0), motions_of(m));
  if (m > 1) return f;
  const double b = h_ - d_;
  if (below_) f.topRows(P) = b / h_ * below_->forcing(m);
  const VectorXd level = t_ / h_ * (above.inverse_K * above.mean - t_ * above.depth);  // (1/h)∫ v (z + 1/K) dz
  if (m == 0) f.col(0).segment(P, U) = -level;
  if (m == 1) f.col(1).segment(P, U) = a_ * level - above.H[1].col(U).head(U);
  if (m == 0 && below_) f(P + U, 0) = b / h_ * (-a_ / (2 * b));
  return f;
}

/// Part of the loads that neither the velocities in the openings nor the side give, (C19).
MatrixXd SubmergedCylinder::inner_loads(int m, const Column& above) const {
  if (m > 1) return {};
  MatrixXd L = below_ ? below_->inner_loads(m) : MatrixXd(MatrixXd::Zero(motions_of(m), motions_of(m)));
  const double low = above.inverse_K - t_, high = above.inverse_K, a2 = a_ * a_;
  if (m == 0) L(0, 0) += low * a2 / 2;
  if (m == 1)
    L(1, 1) += low * a2 * a2 / 4 + a2 * (high * high * high - low * low * low) / 3 -
               a_ * h_ * above.H[1](column_.size(), column_.size());
  return L;
}

/// The Galerkin matrix of (C16); for m = 0 bordered by the condition on the flux through the gap.
MatrixXcd SubmergedCylinder::system(int m, const Column& above, const MatrixXcd& G) const {
  const Index P = lower(), U = column_.size(), border = m == 0 && below_ ? 1 : 0;
  const double b = h_ - d_;
  MatrixXcd A = MatrixXcd::Zero(P + U + border, P + U + border);
  A.topLeftCorner(P + U, P + U) = -G.topLeftCorner(P + U, P + U);
  if (below_) A.topLeftCorner(P, P) += (b / h_ * below_->interior(m).topLeftCorner(P, P)).cast<Complex>();
  A.block(P, P, U, U) += above.H[static_cast<std::size_t>(m)].topLeftCorner(U, U).cast<Complex>();
  for (Index p = 0; border > 0 && p < P; ++p)
    A(p, P + U) = A(P + U, p) = b / h_ * below_->basis().mean(static_cast<int>(p));
  return A;
}

AzimuthalOrder SubmergedCylinder::solve(int m, const Outside& outside, const Column& above,
                                        const RadialFunctions& radial, int channels) const {
  const Index V = openings(), N = channels, motions = motions_of(m);
  const MatrixXcd G = outside.sum(m, radial);
  const MatrixXcd A = system(m, above, G);
  const dense::ComplexLu lu(A);
  const MatrixXcd X = outside.X.topLeftCorner(V, N).cast<Complex>();
  MatrixXcd rhs = forcing(m, above).cast<Complex>();  // unit velocities
  if (m == 1) rhs.topRows(V) += G.block(0, V, V, 2);
  MatrixXcd struck = MatrixXcd::Zero(A.rows(), N);  // unit incident amplitudes, without ψ_n
  struck.topRows(V) = X;
  const MatrixXcd struck_velocity = lu.solve(struck);
  MatrixXcd moved_velocity(A.rows(), motions);
  if (motions > 0) moved_velocity = lu.solve(rhs);  // Eigen must not be asked for nothing
  MatrixXcd side = MatrixXcd::Zero(N, motions);     // s_n
  if (m == 1) side = outside.X.block(V, 0, 2, N).transpose().cast<Complex>();
  AzimuthalOrder o;
  o.T = X.transpose() * struck_velocity.topRows(V);
  o.R = X.transpose() * moved_velocity.topRows(V) + side;
  o.E = a_ * h_ * (side.transpose() + rhs.transpose() * struck_velocity);
  o.L = a_ * h_ * (rhs.transpose() * moved_velocity) + inner_loads(m, above);
  if (m == 1) o.L += a_ * h_ * G.block(V, V, 2, 2);
  to_amplitudes(o, m, radial, a_);
  return o;
}

}  // namespace hydro::cylinders
