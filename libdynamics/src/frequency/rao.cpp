#include "dynamics/frequency/rao.hpp"

#include <Eigen/LU>

#include "hydro/base/error.hpp"
#include "reduction.hpp"
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
  return F;
}

Eigen::MatrixXcd response_amplitudes(const Model& model, const std::vector<PotentialGroup>& groups,
                                     const std::vector<double>& omega, double heading) {
  const Model::Linear linear = model.linear_at_rest();
  const Reduction left(model, linear);
  Eigen::MatrixXcd xi = Eigen::MatrixXcd::Zero(model.modes(), static_cast<Eigen::Index>(omega.size()));
  if (left.count() == 0) return xi;
  for (std::size_t w = 0; w < omega.size(); ++w) {
    const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(left.matrix(impedance(model, linear, groups, omega[w])));
    const Eigen::VectorXcd x = lu.solve(left.vector(excitation(model, groups, omega[w], heading)));
    // An undamped resonance met exactly has no finite answer.
    if (!x.allFinite() || lu.rcond() < 1e-15)
      throw hydro::NumericsError(
          fmt::format("no response exists at {:.6g} rad/s: the equations of motion are singular there", omega[w]));
    xi.col(static_cast<Eigen::Index>(w)) = left.expanded(x);  // (Q1)
  }
  return xi;
}

Eigen::MatrixXcd multiplier_amplitudes(const Model& model, const std::vector<PotentialGroup>& groups,
                                       const std::vector<double>& omega, double heading, const Eigen::MatrixXcd& xi) {
  const Model::Linear linear = model.linear_at_rest();
  Eigen::MatrixXcd lambda(linear.conditions.rows(), xi.cols());
  if (lambda.rows() == 0) return lambda;
  // Only free modes have an equation, and rows are scaled so that newtons and newton metres compare.
  Eigen::VectorXd scale = model.dry_mass_at_rest().diagonal().cwiseSqrt().cwiseInverse();
  for (int m = 0; m < model.modes(); ++m)
    if (!model.is_free(m)) scale[m] = 0;
  const Eigen::MatrixXd scaled = scale.asDiagonal() * linear.conditions.transpose();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
  for (std::size_t w = 0; w < omega.size(); ++w) {
    const auto column = static_cast<Eigen::Index>(w);
    const Eigen::VectorXcd rest =
        excitation(model, groups, omega[w], heading) - impedance(model, linear, groups, omega[w]) * xi.col(column);
    lambda.col(column).real() = qr.solve(scale.cwiseProduct(rest.real()));
    lambda.col(column).imag() = qr.solve(scale.cwiseProduct(rest.imag()));
  }
  return lambda;
}

}  // namespace dynamics::frequency
