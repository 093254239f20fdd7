#include "dynamics/frequency/member_inertia.hpp"

#include "drag_motion.hpp"

namespace dynamics::frequency {

void MemberInertia::add_mass(const State& still, Eigen::MatrixXd& mass) const {
  for (const InertiaPiece& p : pieces) {
    const DragPiece at = turned(p.at, still);
    const Eigen::Matrix<double, 3, 6> J = velocity_across(at);
    mass.block<6, 6>(6 * at.body, 6 * at.body) += p.added * J.transpose() * J;
  }
}

// The water's acceleration is iωu in linear waves.
Eigen::VectorXcd MemberInertia::excitation(const std::vector<RigidBody>& bodies, const State& still, double omega,
                                           double heading) const {
  Eigen::VectorXcd F = Eigen::VectorXcd::Zero(6 * static_cast<Eigen::Index>(bodies.size()));
  if (pieces.empty()) return F;
  const hydro::waves::Component wave = unit_wave(water, omega, heading);
  for (const InertiaPiece& p : pieces) {
    const DragPiece at = turned(p.at, still);
    const Eigen::Vector3cd acceleration =
        std::complex<double>(0, omega) * hydro::waves::velocity_transfer(wave, water, rest_position(p.at, bodies));
    F.segment<6>(6 * at.body) += (p.displaced + p.added) * velocity_across(at).transpose() * acceleration;
  }
  return F;
}

}  // namespace dynamics::frequency
