#pragma once
/// \file  The static shape of one elastic line under its own weight, from an anchor to a fairlead. (D60)-(D62)
#include <Eigen/Core>

namespace dynamics {

/// A uniform line.
struct LineProperties {
  double length;           ///< L, unstretched, m
  double weight;           ///< w, in water, N/m, > 0
  double axial_stiffness;  ///< EA, N
  bool on_bed;             ///< the anchor lies on a flat bed without friction, on which the line may rest

  bool operator==(const LineProperties&) const = default;
};

/// Tensions of a line whose fairlead is a horizontal distance x away from the anchor and z above it.
struct LineTension {
  double horizontal,
      vertical;               ///< H, V of the pull that the line exerts on the fairlead, towards the anchor and down, N
  double anchor_vertical;     ///< V − wL, zero where line rests on the bed, N
  double resting;             ///< unstretched length on the bed, m
  double stored;              ///< elastic energy and weight times height above the anchor, J
  Eigen::Matrix2d stiffness;  ///< ∂(H, V)/∂(x, z), N/m

  double fairlead() const;  ///< N
  double anchor() const;    ///< N
};

/// Solves (D60) or (D61) by Newton, and where that fails by bisection inside bisection. Residual 1e-12 of L, or the
/// rounding of T/w. A line on the bed with more length than it needs hangs straight down and has no horizontal pull.
/// \throws hydro::InputError unless length, weight and stiffness are positive. \throws hydro::NumericsError if the
/// fairlead of a line on the bed is under the bed, or a free line hangs from one place
LineTension catenary(const LineProperties& line, double x_m, double z_m);

/// Where a line with tensions (H, V) at the fairlead has it: (x, z) from the anchor, m. H > 0.
Eigen::Vector2d catenary_span(const LineProperties& line, double horizontal, double vertical);

}  // namespace dynamics
