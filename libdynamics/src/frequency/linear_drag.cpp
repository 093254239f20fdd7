#include "dynamics/frequency/linear_drag.hpp"

#include <cmath>
#include <numbers>

#include "drag_motion.hpp"
#include "equations.hpp"
#include "hydro/base/error.hpp"

namespace dynamics::frequency {

using Eigen::Index, Eigen::VectorXcd, Eigen::Vector3cd;

double energy_equivalent_speed(const Vector3cd& w) {
  if (w.isZero(0)) return 0;
  // Half a period; the sums are exact for circles, and |cos|³ of a line is smooth to its second derivative.
  constexpr int samples = 64;
  double square = 0, cube = 0;
  for (int i = 0; i < samples; ++i) {
    const double speed = (w * std::polar(1.0, std::numbers::pi * i / samples)).real().norm();
    square += speed * speed;
    cube += speed * speed * speed;
  }
  return cube / square;
}

namespace {

/// c β of every piece for motions ξ and waves of amplitude a.
Eigen::VectorXd coefficients(const LinearDrag& drag, Index w, double omega, const VectorXcd& xi, double a) {
  Eigen::VectorXd out(drag.coefficient.rows());
  for (Index i = 0; i < out.size(); ++i) {
    const DragPiece& piece = drag.pieces[static_cast<std::size_t>(i)];
    const Vector3cd relative =
        projection(piece) * drag.velocity.block<3, 1>(3 * i, w) -
        std::complex<double>(0, omega) * projected_velocity(piece) * xi.segment<6>(6 * piece.body);
    out[i] = piece.factor * energy_equivalent_speed(a * relative);
  }
  return out;
}

/// Where response depends on drag alone it goes as its inverse, for which the mean of old and new is exact.
void settle(LinearDrag& drag, Index w, const Equations& of, double omega, const VectorXcd& X, const Impedance& without,
            double a) {
  constexpr int most = 100;
  constexpr double enough = 1e-6;  // of the largest coefficient: far below what a drag coefficient is known to
  drag.coefficient.col(w) = coefficients(drag, w, omega, VectorXcd::Zero(X.size()), a);
  for (int i = 0; i < most; ++i) {
    const VectorXcd load = X + drag.excitation(w, X.size());
    Impedance Z = without;
    add_drag(drag, w, omega, Z);
    const VectorXcd xi = of.solve(Z, load, omega).xi;
    const Eigen::VectorXd found = coefficients(drag, w, omega, xi, a);
    const double change = (found - drag.coefficient.col(w)).lpNorm<Eigen::Infinity>();
    drag.coefficient.col(w) = (found + drag.coefficient.col(w)) / 2;
    if (change <= enough * found.lpNorm<Eigen::Infinity>()) return;
  }
  throw hydro::NumericsError(fmt::format(
      "linear drag did not settle in {} turns at {:.6g} rad/s with waves of {:.4g} m amplitude", most, omega, a));
}

}  // namespace

void add_drag(const LinearDrag& drag, Index w, double omega, Impedance& Z) {
  for (Index i = 0; i < drag.coefficient.rows(); ++i) {
    const DragPiece& piece = drag.pieces[static_cast<std::size_t>(i)];
    const Eigen::Matrix<double, 3, 6> J = projected_velocity(piece);
    Z.add(piece.body, piece.body, std::complex<double>(0, omega * drag.coefficient(i, w)) * J.transpose() * J);
  }
}

VectorXcd LinearDrag::excitation(Index w, Index modes) const {
  VectorXcd F = VectorXcd::Zero(modes);
  for (Index i = 0; i < coefficient.rows(); ++i) {
    const DragPiece& piece = pieces[static_cast<std::size_t>(i)];
    F.segment<6>(6 * piece.body) +=
        coefficient(i, w) * projected_velocity(piece).transpose() * velocity.block<3, 1>(3 * i, w);
  }
  return F;
}

LinearDrag linearised_drag(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                           const std::vector<double>& omega, const std::vector<DragPiece>& pieces,
                           const DragWaves& waves) {
  const auto frequencies = static_cast<Index>(omega.size()), count = static_cast<Index>(pieces.size());
  LinearDrag drag{.pieces = turned(pieces, about.still),
                  .velocity = Eigen::MatrixXcd(3 * count, frequencies),
                  .coefficient = Eigen::MatrixXd::Zero(count, frequencies)};
  const Equations of(about, groups);
  for (Index w = 0; w < frequencies; ++w) {
    const auto at = static_cast<std::size_t>(w);
    drag.velocity.col(w) = water_velocity(pieces, about.model.bodies(), waves.water, omega[at], waves.heading);
    settle(drag, w, of, omega[at], excitation(about, groups, omega[at], waves.heading), of.impedance(omega[at]),
           waves.amplitude[at]);
  }
  return drag;
}

}  // namespace dynamics::frequency
