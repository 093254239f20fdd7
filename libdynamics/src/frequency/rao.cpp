#include "dynamics/frequency/rao.hpp"

#include <Eigen/LU>

#include "hydro/base/error.hpp"
#include "scatter.hpp"

namespace dynamics::frequency {
Eigen::MatrixXcd impedance(const Model& model, const Model::Linear& linear, const std::vector<PotentialGroup>& groups,
                           double omega) {
  const std::complex<double> i_omega(0, omega);
  Eigen::MatrixXcd Z = linear.stiffness + i_omega * linear.damping -
                       omega * omega * model.dry_mass_at_rest().cast<std::complex<double>>();
  for (const PotentialGroup& g : groups)
    if (g.radiation)
      scatter_add(g.bodies,
                  Eigen::MatrixXcd(i_omega * g.table.damping(omega) -
                                   omega * omega * g.table.added_mass(omega).cast<std::complex<double>>()),
                  Z);
  for (int m = 0; m < model.modes(); ++m) {
    if (model.is_free(m)) continue;
    Z.row(m).setZero();
    Z.col(m).setZero();
    Z(m, m) = 1;
  }
  return Z;
}

Eigen::VectorXcd excitation(const Model& model, const std::vector<PotentialGroup>& groups, double omega,
                            double heading) {
  Eigen::VectorXcd F = Eigen::VectorXcd::Zero(model.modes());
  for (const PotentialGroup& g : groups) {
    if (!g.excitation) continue;
    const Eigen::VectorXcd X = g.table.excitation(omega, heading);
    for (std::size_t i = 0; i < g.bodies.size(); ++i)
      F.segment<6>(6 * g.bodies[i]) += X.segment<6>(6 * static_cast<Eigen::Index>(i));
  }
  for (int m = 0; m < model.modes(); ++m)
    if (!model.is_free(m)) F[m] = 0;
  return F;
}

Eigen::MatrixXcd response_amplitudes(const Model& model, const std::vector<PotentialGroup>& groups,
                                     const std::vector<double>& omega, double heading) {
  const Model::Linear linear = model.linear_at_rest();
  Eigen::MatrixXcd xi(model.modes(), static_cast<Eigen::Index>(omega.size()));
  for (std::size_t w = 0; w < omega.size(); ++w) {
    const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(impedance(model, linear, groups, omega[w]));
    const Eigen::VectorXcd x = lu.solve(excitation(model, groups, omega[w], heading));
    // An undamped resonance met exactly has no finite answer.
    if (!x.allFinite() || lu.rcond() < 1e-15)
      throw hydro::NumericsError(
          fmt::format("no response exists at {:.6g} rad/s: the equations of motion are singular there", omega[w]));
    xi.col(static_cast<Eigen::Index>(w)) = x;  // (Q1)
  }
  return xi;
}

}  // namespace dynamics::frequency
