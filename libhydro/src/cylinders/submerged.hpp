#pragma once
/// \file  The cylinder whose top is under water, over a gap or standing on the sea bed, by matching at r = a
/// (C16)-(C19). Not installed.
#include <Eigen/Core>

#include <optional>
#include <vector>

#include "column_basis.hpp"
#include "hydro/cylinders/vertical_modes.hpp"
#include "radial.hpp"
#include "scatterer.hpp"
#include "truncated.hpp"

namespace hydro::cylinders {

/// What does not depend on frequency. The column of water above it does, so it is solved again at each.
class SubmergedCylinder {
 public:
  /// `top`: depth of the top, 0 < top < draught; `draught` empty: it stands on the bottom. Others as TruncatedCylinder.
  SubmergedCylinder(double radius, double top, std::optional<double> draught, double depth, int gap_functions,
                    int orders);

  int exterior_terms(double K) const;  ///< as TruncatedCylinder
  Scatterer at(const VerticalModes& modes, int orders, int channels) const;

 private:
  struct Outside;  // rows of the exterior and their sums
  struct Column;   // the water above
  AzimuthalOrder solve(int m, const Outside& outside, const Column& above, const RadialFunctions& radial,
                       int channels) const;
  Eigen::MatrixXd forcing(int m, const Column& above) const;
  Eigen::MatrixXd inner_loads(int m, const Column& above) const;
  Eigen::MatrixXcd system(int m, const Column& above, const Eigen::MatrixXcd& G) const;
  Eigen::Index lower() const { return below_ ? below_->basis().size() : 0; }
  Eigen::Index openings() const { return lower() + column_.size(); }

  double a_, t_, d_, h_;
  std::optional<TruncatedCylinder> below_;
  ColumnBasis column_;
};

}  // namespace hydro::cylinders
