#include "dynamics/frequency/rao.hpp"

#include <Eigen/LU>

#include "hydro/base/error.hpp"
#include "linear_model.hpp"
#include "scatter.hpp"

namespace dynamics::frequency {
Eigen::MatrixXcd impedance(const SmallMotions& about, const std::vector<PotentialGroup>& groups, double omega) {
  const std::complex<double> i_omega(0, omega);
  Eigen::MatrixXcd Z =
      about.linear.stiffness + i_omega * about.linear.damping - omega * omega * about.mass.cast<std::complex<double>>();
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

Eigen::VectorXcd LinearModel::response(const Eigen::MatrixXcd& Z, const Eigen::VectorXcd& X, double omega) const {
  const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(left.matrix(Z));
  const Eigen::VectorXcd x = lu.solve(left.vector(X));
  // An undamped resonance met exactly has no finite answer.
  if (!x.allFinite() || lu.rcond() < 1e-15)
    throw hydro::NumericsError(
        fmt::format("no response exists at {:.6g} rad/s: the equations of motion are singular there", omega));
  return left.expanded(x);
}

namespace {

/// Both sides of (Q1).
struct Equations {
  Eigen::MatrixXcd Z;
  Eigen::VectorXcd X;
};
Equations equations(const SmallMotions& about, const std::vector<PotentialGroup>& groups, double omega, double heading,
                    const LinearDrag* drag, Eigen::Index w) {
  Equations e{impedance(about, groups, omega), excitation(about.model, groups, omega, heading)};
  if (drag != nullptr) e = {drag->added_to(std::move(e.Z), w, omega), e.X + drag->excitation(w, e.X.size())};
  return e;
}

}  // namespace

Eigen::MatrixXcd response_amplitudes(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                                     const std::vector<double>& omega, double heading, const LinearDrag* drag) {
  const LinearModel of(about);
  Eigen::MatrixXcd xi = Eigen::MatrixXcd::Zero(about.model.modes(), static_cast<Eigen::Index>(omega.size()));
  if (of.left.count() == 0) return xi;
  for (Eigen::Index w = 0; w < xi.cols(); ++w) {
    const double at = omega[static_cast<std::size_t>(w)];
    const auto [Z, X] = equations(about, groups, at, heading, drag, w);
    xi.col(w) = of.response(Z, X, at);  // (Q1)
  }
  return xi;
}

Eigen::MatrixXcd multiplier_amplitudes(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                                       const std::vector<double>& omega, double heading, const Eigen::MatrixXcd& xi,
                                       const LinearDrag* drag) {
  Eigen::MatrixXcd lambda(about.linear.conditions.rows(), xi.cols());
  if (lambda.rows() == 0) return lambda;
  // Only free modes have an equation, and rows are scaled so that newtons and newton metres compare.
  Eigen::VectorXd scale = about.mass.diagonal().cwiseSqrt().cwiseInverse();
  for (int m = 0; m < about.model.modes(); ++m)
    if (!about.model.is_free(m)) scale[m] = 0;
  const Eigen::MatrixXd scaled = scale.asDiagonal() * about.linear.conditions.transpose();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(scaled);
  for (Eigen::Index w = 0; w < xi.cols(); ++w) {
    const auto [Z, X] = equations(about, groups, omega[static_cast<std::size_t>(w)], heading, drag, w);
    const Eigen::VectorXcd rest = X - Z * xi.col(w);
    lambda.col(w).real() = qr.solve(scale.cwiseProduct(rest.real()));
    lambda.col(w).imag() = qr.solve(scale.cwiseProduct(rest.imag()));
  }
  return lambda;
}

}  // namespace dynamics::frequency
