#pragma once
/// \file  What contacts do together: impulses of those that close at one instant (D25), loads of those that touch
///        (D130). Not installed.
#include <Eigen/Core>

#include <optional>
#include <vector>

namespace dynamics {

/// One contact in the equations of an impact, or of the loads at an instant: its rows are that of the normal and, with
/// friction, two along the surface.
struct ImpactLaw {
  Eigen::Index row;
  double restitution, friction;
  std::optional<Eigen::Vector2d> slip = {};  ///< the direction in which it slides already: friction is against it
};

/// Impulses z with u⁺ = u⁻ + W z such that, for each contact, 0 <= z_n ⟂ u_n⁺ + e min(u_n⁻, 0) >= 0, and the impulse
/// along the surface is at most μ z_n, against the slip where that is left. W: velocity gained for each impulse,
/// symmetric, not negative. With accelerations in place of velocities, and e = 0, z are loads. By relaxation contact by
/// contact, `most` rounds at most, until one changes speeds by no more than the rounding of their own sums, or slowly.
/// \returns 0, or the share of the speeds by which the last round still changed them
double relax(const Eigen::MatrixXd& W, const Eigen::VectorXd& before, const std::vector<ImpactLaw>& laws,
             Eigen::VectorXd& z, int most);

/// Those impulses. \throws hydro::NumericsError if they do not settle
Eigen::VectorXd impulses(const Eigen::MatrixXd& W, const Eigen::VectorXd& before, const std::vector<ImpactLaw>& laws);

}  // namespace dynamics
