#pragma once
/// \file  Pendulums in a plane, hung one on the other, slow and plain: angles from the vertical, a full mass matrix,
/// and
///        Runge and Kutta's classical step. Good away from no pole, since a plane has none.
#include <Eigen/Dense>

#include <cmath>

namespace support {

struct PlainPendulums {
  Eigen::VectorXd length, mass;  ///< m; kg, of the bob at each end
  double gravity = 9.81;

  /// θ̈ of Lagrange's equations: Σ_j μ_ij ℓ_i ℓ_j (cos(θ_i − θ_j) θ̈_j + sin(θ_i − θ_j) θ̇_j²) + μ_ii g ℓ_i sin θ_i = 0,
  /// μ_ij the mass below both i and j.
  Eigen::VectorXd acceleration(const Eigen::VectorXd& angle, const Eigen::VectorXd& rate) const {
    const Eigen::Index n = length.size();
    Eigen::MatrixXd M(n, n);
    Eigen::VectorXd load(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      load[i] = -mass.tail(n - i).sum() * gravity * length[i] * std::sin(angle[i]);
      for (Eigen::Index j = 0; j < n; ++j) {
        const double below = mass.tail(n - std::max(i, j)).sum() * length[i] * length[j];
        M(i, j) = below * std::cos(angle[i] - angle[j]);
        load[i] -= below * std::sin(angle[i] - angle[j]) * rate[j] * rate[j];
      }
    }
    return M.ldlt().solve(load);
  }

  void step(Eigen::VectorXd& q, Eigen::VectorXd& v, double h) const {
    const Eigen::VectorXd a1 = acceleration(q, v), v2 = v + h / 2 * a1;
    const Eigen::VectorXd a2 = acceleration(q + h / 2 * v, v2), v3 = v + h / 2 * a2;
    const Eigen::VectorXd a3 = acceleration(q + h / 2 * v2, v3), v4 = v + h * a3;
    const Eigen::VectorXd a4 = acceleration(q + h * v3, v4);
    q += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
};

}  // namespace support
