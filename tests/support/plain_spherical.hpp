#pragma once
/// \file  Bobs on massless rods in space, hung one on the other, slow and plain: Cartesian places, the rods' pulls from
/// the
///        second derivative of their lengths by a full matrix, and Runge and Kutta's classical step with a tiny step.
#include <Eigen/Dense>

#include <vector>

namespace support {

struct PlainSpherical {
  std::vector<double> mass;  ///< kg, of the bob at the end of each rod
  double gravity = 9.81;
  using Places = Eigen::Matrix3Xd;

  Places acceleration(const Places& x, const Places& v) const {
    const Eigen::Index n = x.cols();
    const auto rod = [](const Places& p, Eigen::Index j) {
      return Eigen::Vector3d(p.col(j) - (j > 0 ? p.col(j - 1).eval() : Eigen::Vector3d::Zero()));
    };
    // d_j·(a_j − a_{j−1}) = −|ḋ_j|², m_i a_i = −m_i g ẑ − d_i λ_i + d_{i+1} λ_{i+1}
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd b(n);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Vector3d d = rod(x, j);
      const auto inverse = [&](Eigen::Index i) { return 1 / mass[static_cast<std::size_t>(i)]; };
      A(j, j) = d.squaredNorm() * (inverse(j) + (j > 0 ? inverse(j - 1) : 0));
      if (j > 0) A(j, j - 1) = -d.dot(rod(x, j - 1)) * inverse(j - 1);
      if (j + 1 < n) A(j, j + 1) = -d.dot(rod(x, j + 1)) * inverse(j);
      b[j] = rod(v, j).squaredNorm() - (j == 0 ? gravity * d.z() : 0);
    }
    const Eigen::VectorXd lambda = A.partialPivLu().solve(b);
    Places a(3, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      Eigen::Vector3d pull = -rod(x, i) * lambda[i];
      if (i + 1 < n) pull += rod(x, i + 1) * lambda[i + 1];
      a.col(i) = pull / mass[static_cast<std::size_t>(i)] - gravity * Eigen::Vector3d::UnitZ();
    }
    return a;
  }

  void step(Places& x, Places& v, double h) const {
    const Places a1 = acceleration(x, v), v2 = v + h / 2 * a1;
    const Places a2 = acceleration(x + h / 2 * v, v2), v3 = v + h / 2 * a2;
    const Places a3 = acceleration(x + h / 2 * v2, v3), v4 = v + h * a3;
    const Places a4 = acceleration(x + h * v3, v4);
    x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
};

}  // namespace support
