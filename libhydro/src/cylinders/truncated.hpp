#pragma once
/// \file  The truncated cylinder by matching at r = a: the velocity in the gap below it from a Galerkin equation (C6).
/// Not installed.
#include <Eigen/Core>

#include <vector>

#include "exterior.hpp"
#include "gap_basis.hpp"
#include "hydro/cylinders/vertical_modes.hpp"
#include "radial.hpp"
#include "scatterer.hpp"

namespace hydro::cylinders {

/// What does not depend on frequency: the interior side of the matching.
class TruncatedCylinder {
 public:
  /// `gap_functions`: per family (C5); `orders`: azimuthal orders 0 … orders − 1.
  TruncatedCylinder(double radius, double draught, double depth, int gap_functions, int orders);

  /// Evanescent modes that at() needs at K = ω²/g (that of the highest frequency for a whole table; +∞ needs no more).
  int exterior_terms(double K) const;
  /// `modes` with at least exterior_terms() evanescent modes; the result has `channels` of them, the wave included, and
  /// the azimuthal orders below `orders`.
  Scatterer at(const VerticalModes& modes, int orders, int channels) const;

  // The gap's side of the matching, which a cylinder with water above it has too.
  const GapBasis& basis() const { return basis_; }
  /// H of (C6), rows: gap functions, then τ².
  const Eigen::MatrixXd& interior(int m) const { return interior_[static_cast<std::size_t>(m)]; }
  /// Part of the right-hand side that does not depend on frequency, (C7): columns are motions.
  Eigen::MatrixXd forcing(int m) const;
  /// Part of the loads that neither the gap velocity nor the side gives, (C7).
  Eigen::MatrixXd inner_loads(int m) const;

 private:
  AzimuthalOrder solve(int m, const Exterior& outside, const RadialFunctions& radial, int channels) const;
  void build_interior(int orders);
  void add_interior_tail(int orders, int last);
  Eigen::MatrixXcd galerkin(int m, const Eigen::MatrixXcd& G) const;
  Eigen::MatrixXcd system(int m, const Eigen::MatrixXcd& G, const Eigen::MatrixXd& Q) const;

  double a_, d_, h_, b_;
  GapBasis basis_;
  std::vector<Eigen::MatrixXd> interior_;  // [m]: H of (C6), rows: gap functions, then τ²
};

}  // namespace hydro::cylinders
