#pragma once
/// \file  Private: B over frequency as a polygon, and integrals of it as weights of the given values.
#include <Eigen/Core>

#include <cmath>
#include <vector>

#include "hydro/base/interpolation.hpp"

namespace hydro::radiation::detail {

/// ∫ over a piece = a · f(a) + b · f(b) for f straight between the ends of the piece.
struct EndWeights {
  double a, b;
};

/// The spherical Bessel functions of the orders 0 and 1.
struct Bessel {
  double j0, j1;

  explicit Bessel(double x)
      : j0(std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x),
        j1(std::abs(x) < 1e-2 ? x / 3 * (1 - x * x / 10 * (1 - x * x / 28)) : (j0 - std::cos(x)) / x) {}
};

/// ∫_a^b f(ω) cos(ωt − φ) dω = w_a f(a) + w_b f(b) for f straight between a and b, exactly (R3).
inline EndWeights oscillating_weights(double a, double b, double t, double phase) {
  const double h = b - a, m = t * (a + b) / 2 - phase;
  // With u = ω − midpoint: ∫cos = h j0(x) cos m and ∫u cos = −(h²/2) j1(x) sin m, x = th/2.
  const Bessel of(t * h / 2);
  const double even = h / 2 * of.j0 * std::cos(m), odd = h / 2 * of.j1 * std::sin(m);
  return {even + odd, even - odd};
}

/// B on the cubic of (P6) between the given frequencies and from ω = 0, where B = 0, cut into four straight pieces an
/// interval. Everything is linear in B, so the pieces only gather weights, and each B is touched once an integral.
class Polygon {
 public:
  explicit Polygon(const std::vector<double>& given) : given_(given.size()) {
    std::vector<double> omega{0};
    omega.insert(omega.end(), given.begin(), given.end());
    for (std::size_t i = 0; i + 1 < omega.size(); ++i)
      for (std::size_t piece = 0; piece < pieces; ++piece)
        add_node(omega, omega[i] + (omega[i + 1] - omega[i]) * static_cast<double>(piece) / pieces);
    add_node(omega, omega.back());
  }

  const std::vector<double>& nodes() const { return node_; }

  /// Weights of ∫ B cos ωt dω at `count` times from `first`, a row each, as gather() of oscillating_weights().
  Eigen::MatrixXd cosine_weights(double first, double step, Eigen::Index count) const {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(count, static_cast<Eigen::Index>(given_) + 1);
    Eigen::ArrayXd from(count), to(count), cos(count), sin(count), j0(count), j1(count);
    for (std::size_t i = 0; i + 1 < node_.size(); ++i) {
      const double h = node_[i + 1] - node_[i];
      if (i % pieces == 0)  // the pieces of an interval are equally long
        for (Eigen::Index t = 0; t < count; ++t) {
          const Bessel of((first + static_cast<double>(t) * step) * h / 2);
          j0[t] = of.j0;
          j1[t] = of.j1;
        }
      turning(first, step, node_[i] + h / 2, cos, sin);
      from = h / 2 * (j0 * cos + j1 * sin);
      to = h / 2 * (j0 * cos - j1 * sin);
      add(i, from, out);
      add(i + 1, to, out);
    }
    return out.rightCols(static_cast<Eigen::Index>(given_));
  }

  /// Weights of the given values (that of B(0) = 0 is dropped), from EndWeights piece(a, b).
  template <class Piece>
  std::vector<double> gather(Piece piece) const {
    std::vector<double> weight(given_ + 1, 0.0);
    const auto spread = [&](std::size_t node, double w) {
      for (std::size_t k = 0; k < stencil_[node].weight.size(); ++k)
        if (stencil_[node].weight[k] != 0) weight[stencil_[node].first + k] += w * stencil_[node].weight[k];
    };
    for (std::size_t i = 0; i + 1 < node_.size(); ++i) {
      const EndWeights w = piece(node_[i], node_[i + 1]);
      spread(i, w.a);
      spread(i + 1, w.b);
    }
    weight.erase(weight.begin());
    return weight;
  }

 private:
  static constexpr std::size_t pieces = 4;

  /// cos ωt and sin ωt at t = first, first + step …: each from the one before, turned on by one rotation.
  static void turning(double first, double step, double omega, Eigen::ArrayXd& cos, Eigen::ArrayXd& sin) {
    const double c = std::cos(omega * step), s = std::sin(omega * step);
    double x = std::cos(omega * first), y = std::sin(omega * first);
    for (Eigen::Index t = 0; t < cos.size(); ++t) {
      cos[t] = x;
      sin[t] = y;
      const double on = c * x - s * y;
      y = s * x + c * y;
      x = on;
    }
  }
  /// A node's weights at all times, to the given values that it hangs on.
  void add(std::size_t node, const Eigen::ArrayXd& weights, Eigen::MatrixXd& out) const {
    for (std::size_t k = 0; k < stencil_[node].weight.size(); ++k)
      if (stencil_[node].weight[k] != 0)
        out.col(static_cast<Eigen::Index>(stencil_[node].first + k)).array() += stencil_[node].weight[k] * weights;
  }
  void add_node(const std::vector<double>& omega, double at) {
    node_.push_back(at);
    stencil_.push_back(cubic_stencil(omega, at));
  }

  std::size_t given_;
  std::vector<double> node_;
  std::vector<Stencil> stencil_;
};

}  // namespace hydro::radiation::detail
