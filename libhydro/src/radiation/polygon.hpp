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

/// One matrix a row.
inline Eigen::MatrixXd flattened(const std::vector<Eigen::MatrixXd>& matrices) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(matrices.size()), matrices.front().size());
  for (std::size_t i = 0; i < matrices.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) = matrices[i].reshaped().transpose();
  return out;
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

  /// B at the nodes, a row each, from the given values, a row each.
  Eigen::MatrixXd values(const Eigen::MatrixXd& given) const {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(node_.size()), given.cols());
    for (std::size_t i = 0; i < node_.size(); ++i)
      for (std::size_t k = 0; k < stencil_[i].weight.size(); ++k) {
        const auto from = static_cast<Eigen::Index>(stencil_[i].first + k) - 1;
        if (from >= 0 && stencil_[i].weight[k] != 0)  // B(0) = 0
          out.row(static_cast<Eigen::Index>(i)) += stencil_[i].weight[k] * given.row(from);
      }
    return out;
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

  void add_node(const std::vector<double>& omega, double at) {
    node_.push_back(at);
    stencil_.push_back(cubic_stencil(omega, at));
  }

  std::size_t given_;
  std::vector<double> node_;
  std::vector<Stencil> stencil_;
};

}  // namespace hydro::radiation::detail
