#pragma once
/// \file  The exterior side of the matching at one frequency. Not installed.
#include <Eigen/Core>

#include <complex>

#include "gap_basis.hpp"
#include "hydro/cylinders/vertical_modes.hpp"
#include "radial.hpp"

namespace hydro::cylinders {

/// The rows X of (C6) for all modes of the depth: projections of the gap functions (if there is a gap), of the velocity
/// of the side in surge and of that in pitch; and the sums G_m = Σ_n q_n X_n X_nᵀ.
class Exterior {
 public:
  /// The side reaches from the surface down to `draught`; `basis` is null for a cylinder that reaches the bottom.
  Exterior(const VerticalModes& modes, double radius, double draught, const GapBasis* basis);

  const Eigen::MatrixXd& rows() const { return X_; }  ///< (gap functions + 2, modes); column 0: the wave
  Eigen::MatrixXcd sum(int m, const RadialFunctions& radial) const;

 private:
  /// For large n a row is Re[swinging e^{iκb}] + (−1)^n alternating; n may lie between integers.
  struct Asymptotic {
    double kappa;
    Eigen::VectorXcd swinging;
    Eigen::VectorXd alternating;
  };
  Eigen::VectorXd wave_column() const;
  Eigen::VectorXd column(int n) const;
  Asymptotic asymptotic(double n) const;
  double decay(Eigen::Index row) const;
  void add_smooth_tail(int m, Eigen::MatrixXd& G) const;
  void add_swinging_tail(int m, Eigen::MatrixXd& G) const;

  const VerticalModes& modes_;
  const GapBasis* basis_;
  double a_, d_, h_, b_;
  Eigen::Index gap_;
  Eigen::MatrixXd X_;
};

}  // namespace hydro::cylinders
