#include "dynamics/frequency/member_inertia.hpp"

#include <algorithm>

#include "drag_motion.hpp"
#include "hydro/waves/kinematics/field.hpp"

namespace dynamics::frequency {

void MemberInertia::add_mass(const State& still, Eigen::MatrixXd& mass) const {
  const auto add = [&](const DragPiece& placed, double added) {
    const DragPiece at = turned(placed, still);
    const Eigen::Matrix<double, 3, 6> J = projected_velocity(at);
    mass.block<6, 6>(6 * at.body, 6 * at.body) += added * J.transpose() * J;
  };
  for (const InertiaPiece& p : pieces) add(p.at, p.added);
  for (const EndPiece& e : ends) add(e.at, e.added);
}

namespace {

/// p + ρgz per metre of a wave, Pa, with its phase at the point: ρ g cosh κ(z + h)/cosh κh, z at most 0. (W11)
std::complex<double> pressure_transfer(const hydro::waves::Component& wave, const hydro::Water& water,
                                       const Eigen::Vector3d& at) {
  const double profile = hydro::waves::depth_profile(wave.k, water.depth.metres(), std::min(at.z(), 0.0)).cosh;
  return water.density * water.gravity * profile * hydro::waves::elevation_transfer(wave, at.x(), at.y());
}

}  // namespace

// The water's acceleration is iωu in linear waves.
Eigen::VectorXcd MemberInertia::excitation(const std::vector<RigidBody>& bodies, const State& still, double omega,
                                           double heading) const {
  Eigen::VectorXcd F = Eigen::VectorXcd::Zero(6 * static_cast<Eigen::Index>(bodies.size()));
  if (pieces.empty() && ends.empty()) return F;
  const hydro::waves::Component wave = unit_wave(water, omega, heading);
  const auto acceleration = [&](const Eigen::Vector3d& at) -> Eigen::Vector3cd {
    return std::complex<double>(0, omega) * hydro::waves::velocity_transfer(wave, water, at);
  };
  for (const InertiaPiece& p : pieces)
    F.segment<6>(6 * p.at.body) += (p.displaced + p.added) * projected_velocity(turned(p.at, still)).transpose() *
                                   acceleration(rest_position(p.at, bodies));
  for (const EndPiece& e : ends) {
    const Eigen::Vector3d at = rest_position(e.at, bodies);
    const DragPiece here = turned(e.at, still);
    F.segment<6>(6 * here.body) +=
        projected_velocity(here).transpose() *
        (e.pressed * pressure_transfer(wave, water, at) * here.axis + e.added * acceleration(at));
  }
  return F;
}

}  // namespace dynamics::frequency
