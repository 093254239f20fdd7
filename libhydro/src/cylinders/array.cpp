#include "array.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bessel.hpp"
#include "hydro/base/dense.hpp"
#include "radial.hpp"

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using std::numbers::pi;
constexpr Complex i_unit(0, 1);

double parity(int m) { return m % 2 == 0 ? 1 : -1; }

/// C_{−m} = (−1)^m C_m for J, Y and H: the sign that takes |m| to m.
double sign_of(int m) { return m < 0 ? parity(m) : 1; }

std::size_t magnitude(int m) { return static_cast<std::size_t>(std::abs(m)); }

}  // namespace

WaveIndex::WaveIndex(const Channels& channels) : count_(channels.count()) {
  Index next = 0;
  for (const int M : channels.order) {
    middle_.push_back(next + M);
    next += 2 * M + 1;
  }
}

RadialScales radial_scales(const VerticalModes& modes, double radius, const Channels& channels) {
  const int M = channels.highest_order();
  RadialScales scale{wave_scales(modes.k, radius, M + 1)};
  for (int n = 1; n < channels.vertical(); ++n) {
    scale.emplace_back(static_cast<std::size_t>(M + 1));
    bessel_k_scaled_sequence(modes.kappa[static_cast<std::size_t>(n - 1)] * radius, scale.back());
  }
  return scale;
}

Array::Array(std::vector<Cylinder> cylinders, const std::vector<const Scatterer*>& scatterer,
             const VerticalModes& modes, Channels channels, double precision)
    : cylinders_(std::move(cylinders)),
      modes_(modes),
      channels_(std::move(channels)),
      index_(channels_),
      precision_(precision),
      closest_(std::numeric_limits<double>::infinity()) {
  for (std::size_t i = 0; i < cylinders_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      closest_ = std::min(
          closest_, (cylinders_[i].centre - cylinders_[j].centre).norm() - cylinders_[i].radius - cylinders_[j].radius);
  first_unknown_.push_back(0);
  for (std::size_t c = 0; c < cylinders_.size(); ++c) {
    const auto same = [&](const Kind& k) { return k.scatterer == scatterer[c]; };
    const auto known = std::find_if(kinds_.begin(), kinds_.end(), same);
    kind_of_.push_back(static_cast<std::size_t>(known - kinds_.begin()));
    if (known == kinds_.end()) kinds_.push_back(kind(cylinders_[c], *scatterer[c]));
    first_unknown_.push_back(first_unknown_.back() + kind_of(c).first.back());
  }
}

Array::Kind Array::kind(const Cylinder& cylinder, const Scatterer& scatterer) const {
  Kind k{&scatterer, {}, {0}, {}, {}, {}, {}};
  const int M = channels_.highest_order();
  k.scale = radial_scales(modes_, cylinder.radius, channels_);
  if (cylinders_.size() > 1)
    for (int m = 0; m <= M; ++m) {
      const int count = channels_.vertical_of(m);
      k.factors.push_back(compressed(scatterer.order[magnitude(m)].T.topLeftCorner(count, count), m, cylinder.radius));
    }
  if (cylinders_.size() > 1)
    for (int m = -M; m <= M; ++m) k.first.push_back(k.first.back() + k.factors[magnitude(m)].in.rows());
  expand(k);
  return k;
}

// (C12). What passes between cylinders in the mode n is weakened at least by the way between the closest two, half of
// which is laid to either side of T: D T D has few significant columns. The wave is not weakened.
Array::Factors Array::compressed(const MatrixXcd& T, int azimuthal, double radius) const {
  Eigen::VectorXd D = Eigen::VectorXd::Ones(T.rows());
  for (Index n = 1; n < T.rows(); ++n) {
    const double kappa = modes_.kappa[static_cast<std::size_t>(n - 1)], L = closest_ + 2 * radius;
    std::vector<double> far(static_cast<std::size_t>(2 * azimuthal + 1)), near(far.size());
    bessel_k_scaled_sequence(kappa * L, far);
    bessel_k_scaled_sequence(kappa * radius, near);
    D(n) = std::sqrt(std::exp(-kappa * closest_) * far.back()) / near[static_cast<std::size_t>(azimuthal)];
  }
  const MatrixXcd weakened = D.asDiagonal() * T * D.asDiagonal();
  Eigen::ColPivHouseholderQR<MatrixXcd> qr(weakened);
  const auto diagonal = qr.matrixQR().diagonal().cwiseAbs();
  Index rank = 0;
  while (rank < diagonal.size() && diagonal(rank) > precision_) ++rank;
  const MatrixXcd Q = qr.householderQ() * MatrixXcd::Identity(T.rows(), rank);
  const MatrixXcd R = qr.matrixQR().topRows(rank).triangularView<Eigen::Upper>();
  const Eigen::VectorXd inverse = D.cwiseInverse();
  const MatrixXcd unsorted = R * qr.colsPermutation().transpose();
  return {unsorted * inverse.asDiagonal(), inverse.asDiagonal() * Q};
}

// From motions with cos θ and sin θ to e^{±iθ}: C cos θ + S sin θ = ½(C − iS) e^{iθ} + ½(C + iS) e^{−iθ}, and back.
// With sin θ go sway and, with the opposite sign, roll.
void Array::expand(Kind& k) const {
  const Index count = channels_.count();
  k.R = MatrixXcd::Zero(count, 6);
  k.E = MatrixXcd::Zero(6, count);
  k.L = MatrixXcd::Zero(6, 6);
  const AzimuthalOrder &zero = k.scatterer->order[0], &one = k.scatterer->order[1];
  for (int n = 0; n < channels_.vertical(); ++n) {
    const int M = channels_.order[static_cast<std::size_t>(n)];
    const Index middle = index_(0, n, 0);
    k.R(middle, 2) = zero.R(n, 0);
    k.E(2, middle) = 2 * pi * zero.E(0, n);
    for (const int m : {-1, 1}) {
      if (M == 0) continue;
      const Complex turn = static_cast<double>(m) * i_unit;
      k.R.row(middle + m) << 0.5 * one.R(n, 0), -0.5 * turn * one.R(n, 0), 0, 0.5 * turn * one.R(n, 1),
          0.5 * one.R(n, 1), 0;
      k.E.col(middle + m) << pi * one.E(0, n), pi * turn * one.E(0, n), 0, -pi * turn * one.E(1, n), pi * one.E(1, n),
          0;
    }
  }
  k.L(2, 2) = 2 * pi * zero.L(0, 0);
  k.L(0, 0) = k.L(1, 1) = pi * one.L(0, 0);
  k.L(4, 4) = k.L(3, 3) = pi * one.L(1, 1);
  k.L(0, 4) = pi * one.L(0, 1);
  k.L(4, 0) = pi * one.L(1, 0);
  k.L(1, 3) = -k.L(0, 4);
  k.L(3, 1) = -k.L(4, 0);
}

// Graf's addition theorem (C10), in the scaled functions of (C4).
Translation translation(const Cylinder& to, const Cylinder& from, const RadialScales& scale_to,
                        const RadialScales& scale_from, const VerticalModes& modes, const Channels& channels,
                        double least) {
  const Eigen::Vector2d way = to.centre - from.centre;
  const double L = way.norm(), alpha = std::atan2(way.y(), way.x());
  std::vector<Complex> turn;
  for (int m = 0; m <= 2 * channels.highest_order(); ++m) turn.push_back(std::polar(1.0, m * alpha));
  Translation G;
  for (int n = 0; n < channels.vertical(); ++n) {
    const auto at = static_cast<std::size_t>(n);
    const int M = channels.order[at];
    std::vector<Complex> C(static_cast<std::size_t>(2 * M + 1));
    double factor = 1;
    if (n == 0 && modes.has_wave()) hankel_2_sequence(modes.k * L, C);
    if (n > 0) {
      const double kappa = modes.kappa[at - 1];
      factor = std::exp(-kappa * (L - to.radius - from.radius));
      if (factor < least) break;
      std::vector<double> K(C.size());
      bessel_k_scaled_sequence(kappa * L, K);
      std::copy(K.begin(), K.end(), C.begin());
    }
    MatrixXcd g(2 * M + 1, 2 * M + 1);
    for (int l = -M; l <= M; ++l)
      for (int m = -M; m <= M; ++m) {
        const double sign = n == 0 ? sign_of(m) * sign_of(l) * sign_of(m - l) : parity(l);
        const Complex turned = m >= l ? turn[magnitude(m - l)] : std::conj(turn[magnitude(m - l)]);
        g(l + M, m + M) = C[magnitude(m - l)] * turned *
                          (factor * sign / (scale_to[at][magnitude(l)] * scale_from[at][magnitude(m)]));
      }
    G.push_back(std::move(g));
  }
  return G;
}

std::vector<Translation> Array::translations() const {
  std::vector<Translation> G(cylinders_.size() * cylinders_.size());
  for (std::size_t to = 0; to < cylinders_.size(); ++to)
    for (std::size_t from = 0; from < cylinders_.size(); ++from)
      if (to != from)
        G[to * cylinders_.size() + from] = translation(cylinders_[to], cylinders_[from], kind_of(to).scale,
                                                       kind_of(from).scale, modes_, channels_, 1e-2 * precision_);
  return G;
}

MatrixXcd Array::translated(const std::vector<Translation>& G, const MatrixXcd& b) const {
  MatrixXcd a = MatrixXcd::Zero(b.rows(), b.cols());
  for (std::size_t to = 0; to < cylinders_.size(); ++to)
    for (std::size_t from = 0; from < cylinders_.size(); ++from) {
      const Translation& g = G[to * cylinders_.size() + from];
      for (std::size_t n = 0; n < g.size(); ++n) {
        const int M = channels_.order[n];
        a.middleRows(index_(to, static_cast<int>(n), -M), 2 * M + 1).noalias() +=
            g[n] * b.middleRows(index_(from, static_cast<int>(n), -M), 2 * M + 1);
      }
    }
  return a;
}

MatrixXcd Array::received(const MatrixXcd& a) const {
  MatrixXcd y = MatrixXcd::Zero(unknowns(), a.cols());
  const int M = channels_.highest_order();
  for (std::size_t c = 0; c < cylinders_.size(); ++c)
    for (int m = -M; m <= M; ++m) {
      const Factors& f = kind_of(c).factors[magnitude(m)];
      const Index row = first_unknown_[c] + kind_of(c).first[static_cast<std::size_t>(m + M)];
      for (int n = 0; n < channels_.vertical_of(m); ++n)
        y.middleRows(row, f.in.rows()) += f.in.col(n) * a.row(index_(c, n, m));
    }
  return y;
}

MatrixXcd Array::sent(const MatrixXcd& y) const {
  MatrixXcd b = MatrixXcd::Zero(size(), y.cols());
  const int M = channels_.highest_order();
  for (std::size_t c = 0; c < cylinders_.size(); ++c)
    for (int m = -M; m <= M; ++m) {
      const Factors& f = kind_of(c).factors[magnitude(m)];
      const Index row = first_unknown_[c] + kind_of(c).first[static_cast<std::size_t>(m + M)];
      for (int n = 0; n < channels_.vertical_of(m); ++n)
        b.row(index_(c, n, m)) = f.out.row(n) * y.middleRows(row, f.in.rows());
    }
  return b;
}

// 1 − in G out, pair by pair and order by order.
MatrixXcd Array::system(const std::vector<Translation>& G) const {
  MatrixXcd A = MatrixXcd::Identity(unknowns(), unknowns());
  const int M = channels_.highest_order();
  for (std::size_t to = 0; to < cylinders_.size(); ++to)
    for (std::size_t from = 0; from < cylinders_.size(); ++from) {
      const Translation& g = G[to * cylinders_.size() + from];
      if (g.empty()) continue;
      for (int l = -M; l <= M; ++l)
        for (int m = -M; m <= M; ++m) {
          const int both = std::max(std::abs(l), std::abs(m));
          const Index count = std::min<Index>(channels_.vertical_of(both), static_cast<Index>(g.size()));
          const Factors &in = kind_of(to).factors[magnitude(l)], &out = kind_of(from).factors[magnitude(m)];
          Eigen::VectorXcd way(count);
          for (Index n = 0; n < count; ++n) {
            const int highest = channels_.order[static_cast<std::size_t>(n)];
            way(n) = g[static_cast<std::size_t>(n)](l + highest, m + highest);
          }
          const Index row = first_unknown_[to] + kind_of(to).first[static_cast<std::size_t>(l + M)];
          const Index col = first_unknown_[from] + kind_of(from).first[static_cast<std::size_t>(m + M)];
          A.block(row, col, in.in.rows(), out.out.cols()) -=
              in.in.leftCols(count) * way.asDiagonal() * out.out.topRows(count);
        }
    }
  return A;
}

MatrixXcd Array::moved() const {
  const Index count = channels_.count(), cylinders = static_cast<Index>(cylinders_.size());
  MatrixXcd b = MatrixXcd::Zero(size(), 6 * cylinders);
  for (Index c = 0; c < cylinders; ++c) b.block(c * count, 6 * c, count, 6) = kind_of(static_cast<std::size_t>(c)).R;
  return b;
}

// a = from outside + G T a, T = out · in, with y = in · a as the unknown.
MatrixXcd Array::incident(const MatrixXcd& from_outside) const {
  if (cylinders_.size() == 1) return from_outside;
  const auto G = translations();
  const MatrixXcd y = dense::ComplexLu(system(G)).solve(received(from_outside));
  return from_outside + translated(G, sent(y));
}

MatrixXcd Array::scattered(const MatrixXcd& a) const {
  MatrixXcd b = MatrixXcd::Zero(a.rows(), a.cols());
  for (std::size_t c = 0; c < cylinders_.size(); ++c)
    for (int m = -channels_.highest_order(); m <= channels_.highest_order(); ++m) {
      const int vertical = channels_.vertical_of(m);
      MatrixXcd arriving(vertical, a.cols());
      for (int n = 0; n < vertical; ++n) arriving.row(n) = a.row(index_(c, n, m));
      const MatrixXcd sent = kind_of(c).scatterer->order[magnitude(m)].T.topLeftCorner(vertical, vertical) * arriving;
      for (int n = 0; n < vertical; ++n) b.row(index_(c, n, m)) = sent.row(n);
    }
  return b;
}

// Columns: each partial wave of `outer` arriving alone, then each motion alone. The latter arrives at the others as
// G R v.
Compound Array::compound(const Channels& outer) const {
  const Index waves = static_cast<Index>(cylinders_.size()) * outer.count(), count = channels_.count();
  std::vector<Index> place;  // of the outer waves among all
  for (std::size_t c = 0; c < cylinders_.size(); ++c)
    for (int n = 0; n < outer.vertical(); ++n)
      for (int m = -outer.order[static_cast<std::size_t>(n)]; m <= outer.order[static_cast<std::size_t>(n)]; ++m)
        place.push_back(index_(c, n, m));
  const MatrixXcd own = moved();
  MatrixXcd arriving = MatrixXcd::Zero(size(), waves + own.cols());
  for (Index w = 0; w < waves; ++w) arriving(place[static_cast<std::size_t>(w)], w) = 1;
  if (cylinders_.size() > 1) arriving.rightCols(own.cols()) = translated(translations(), own);

  const MatrixXcd a = incident(arriving);
  MatrixXcd b = scattered(a), loads(6 * static_cast<Index>(cylinders_.size()), a.cols());
  b.rightCols(own.cols()) += own;
  for (Index c = 0; c < static_cast<Index>(cylinders_.size()); ++c) {
    const Kind& k = kind_of(static_cast<std::size_t>(c));
    loads.middleRows(6 * c, 6) = k.E * a.middleRows(c * count, count);
    loads.block(6 * c, waves + 6 * c, 6, 6) += k.L;
  }
  MatrixXcd sent_on(waves, b.cols());
  for (Index w = 0; w < waves; ++w) sent_on.row(w) = b.row(place[static_cast<std::size_t>(w)]);
  return {sent_on.leftCols(waves), sent_on.rightCols(own.cols()), loads.leftCols(waves), loads.rightCols(own.cols())};
}

}  // namespace hydro::cylinders
