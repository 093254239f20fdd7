#pragma once
/// \file  The radial velocity in the opening above a submerged cylinder, in functions that share its singularity at the
/// edge (C17). Not installed.
///
/// With y = (z+t)/t from 0 at the edge to 1 at the surface, the velocity is y^{−1/3}, 1 and y^{1/3}, each times a power
/// series in y: near the edge as in (C5), and nothing special at the surface. Functions: y^α P_i(1 − 2y), P_i
/// Legendre's.
#include <Eigen/Core>

#include <array>
#include <complex>
#include <vector>

namespace hydro::cylinders {

class ColumnBasis {
 public:
  explicit ColumnBasis(int per_family);

  int size() const { return static_cast<int>(powers.size()) * per_family_; }
  /// Φ_p(x) = ∫₀¹ v_p e^{ixy} dy for all p, x > 0; rounding of the largest.
  Eigen::VectorXcd transform(double x) const;
  /// ∫₀¹ v_p w(y) dy for any smooth w that varies over 1/far_from() at least.
  template <class Weight>
  Eigen::VectorXd integral(Weight w) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(size());
    for (std::size_t j = 0; j < y_.size(); ++j) sum += w(y_[j]) * node_.col(static_cast<Eigen::Index>(j));
    return sum;
  }
  /// Beyond this x, Φ_p = edge + surface e^{ix}: what comes from y = 0, exact, and from y = 1, to rounding.
  double far_from() const { return far_; }
  Eigen::VectorXcd from_edge(double x) const;
  Eigen::VectorXcd from_surface(double x) const;

 private:
  static constexpr std::array<double, 3> powers{-1.0 / 3, 0, 1.0 / 3};
  static constexpr int taylor_terms = 24;

  int per_family_;
  double far_;
  Eigen::MatrixXd node_;      // (functions, nodes): v_p · weight
  std::vector<double> y_;     // nodes
  Eigen::MatrixXd monomial_;  // (per_family, per_family): coefficients of P_i in powers of y, times Γ later
  Eigen::MatrixXd taylor_;    // (functions, terms): of v_p about y = 1
};

}  // namespace hydro::cylinders
