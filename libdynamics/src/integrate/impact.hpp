#pragma once
/// \file  Impulses of contacts that close at one instant (D25). Not installed.
#include <Eigen/Core>

#include <vector>

namespace dynamics {

/// One contact in the equations of an impact: its rows are that of the normal and, with friction, two along the
/// surface.
struct ImpactLaw {
  Eigen::Index row;
  double restitution, friction;
};

/// Impulses z with u⁺ = u⁻ + W z such that, for each contact, 0 <= z_n ⟂ u_n⁺ + e min(u_n⁻, 0) >= 0, and the impulse
/// along the surface is at most μ z_n, against the slip where that is left. W: velocity gained for each impulse,
/// symmetric, not negative. By relaxation contact by contact, to rounding. \throws hydro::NumericsError if that does
/// not settle
Eigen::VectorXd impulses(const Eigen::MatrixXd& W, const Eigen::VectorXd& before, const std::vector<ImpactLaw>& laws);

}  // namespace dynamics
