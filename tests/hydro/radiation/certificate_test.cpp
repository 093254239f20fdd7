// The certificate of passivity against an independent test: eigenvalues of the Hamiltonian matrix.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "passivity.hpp"
#include "pole_basis.hpp"
#include "support/random_passive.hpp"

namespace certificate_test {
namespace {

using namespace hydro::radiation;

/// B(ω) + lift > 0 at every frequency, by the Hamiltonian matrix of K̂ + lift: no eigenvalue on the imaginary axis
/// (Boyd, Balakrishnan & Kabamba 1989).
bool hamiltonian_passive(const PoleModel& m, double lift) {
  const Eigen::Index n = m.modes(), order = m.order(), states = n * order;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(states, states), B = Eigen::MatrixXd::Zero(states, n),
                  C = Eigen::MatrixXd::Zero(n, states);
  Eigen::Index at = 0;
  const auto I = Eigen::MatrixXd::Identity(n, n);
  for (std::size_t k = 0; k < m.poles.size(); ++k) {
    A.block(at, at, n, n) = -m.poles[k].decay * I;
    B.middleRows(at, n) = I;
    C.middleCols(at, n) = m.C[k];
    if (m.poles[k].omega > 0) {  // blocks [−a b; −b −a] realise cosine and −sine
      A.block(at + n, at + n, n, n) = -m.poles[k].decay * I;
      A.block(at, at + n, n, n) = m.poles[k].omega * I;
      A.block(at + n, at, n, n) = -m.poles[k].omega * I;
      C.middleCols(at + n, n) = -m.S[k];
      at += n;
    }
    at += n;
  }
  const double R = 1 / (2 * lift);
  Eigen::MatrixXd H(2 * states, 2 * states);
  H << A - R * B * C, -R * B * B.transpose(), R * C.transpose() * C, -A.transpose() + R * C.transpose() * B.transpose();
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(H, false);
  for (Eigen::Index i = 0; i < 2 * states; ++i)
    if (const auto z = eigen.eigenvalues()[i]; std::abs(z.real()) < 1e-7 * (1 + std::abs(z))) return false;
  return true;
}

detail::Certificate certificate(const PoleModel& m, double margin) {
  const Eigen::Index n = m.modes();
  Eigen::MatrixXd coefficients(m.order(), n * (n + 1) / 2);
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < m.poles.size(); ++k) {
    coefficients.row(at++) = detail::packed(m.C[k]);
    if (m.poles[k].omega > 0) coefficients.row(at++) = detail::packed(m.S[k]);
  }
  return detail::certify(detail::WeightedDamping(m.poles, 1.2), coefficients, n, margin);
}

PoleModel scaled_body(std::uint64_t seed) {
  auto m = support::random_passive(seed, 3, 3);
  const double size = m.transform(1).cwiseAbs().maxCoeff();
  for (auto* part : {&m.C, &m.S})
    for (auto& matrix : *part) matrix /= size;
  return m;
}

// (R15): the rows are the damping itself, weighted, and its derivatives.
TEST(WeightedDamping, IsTheDampingOverASquaredSine) {
  const auto m = scaled_body(1);
  const detail::WeightedDamping weighted(m.poles, 1.2);
  Eigen::MatrixXd coefficients(m.order(), 1);
  for (std::size_t k = 0; k < 3; ++k) {
    coefficients(2 * static_cast<Eigen::Index>(k), 0) = m.C[k](0, 0);
    coefficients(2 * static_cast<Eigen::Index>(k) + 1, 0) = m.S[k](0, 0);
  }
  const auto Q = [&](double theta) { return (weighted.rows(theta) * coefficients).eval(); };
  for (const double theta : {0.2, 0.7, 1.3}) {
    const double B = m.transform(1.2 * std::tan(theta)).real()(0, 0), s = std::sin(2 * theta);
    EXPECT_NEAR(Q(theta)(0, 0), B / (s * s), 1e-10 * (1 + std::abs(Q(theta)(0, 0))));
    constexpr double e = 1e-4;
    EXPECT_NEAR(Q(theta)(1, 0), (Q(theta + e)(0, 0) - Q(theta - e)(0, 0)) / (2 * e),
                1e-5 * (1 + std::abs(Q(theta)(1, 0))));
    EXPECT_NEAR(Q(theta)(2, 0), (Q(theta + e)(1, 0) - Q(theta - e)(1, 0)) / (2 * e),
                1e-5 * (1 + std::abs(Q(theta)(2, 0))));
    const double third = (Q(theta + e)(2, 0) - Q(theta - e)(2, 0)) / (2 * e);
    Eigen::VectorXd size(3);
    for (int k = 0; k < 3; ++k) size[k] = coefficients.middleRows(2 * k, 2).norm() / 2;
    EXPECT_GE(weighted.third_derivative(theta, 0).dot(size), std::abs(third));
  }
}

TEST(Certificate, AgreesWithTheHamiltonianMatrix) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    auto m = scaled_body(seed);
    EXPECT_TRUE(certificate(m, 1e-9).passive) << "seed " << seed << ": passive by construction";
    EXPECT_TRUE(hamiltonian_passive(m, 1e-3)) << "seed " << seed;
    // One term made a source of power: some frequency now has a damping well below zero.
    const double share = -0.3 - 0.1 * static_cast<double>(seed % 5);
    m.C[1] *= share, m.S[1] *= share;
    double lowest = 0;
    for (double omega = 0.05; omega < 8; omega *= 1.01)
      lowest =
          std::min(lowest, Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(m.transform(omega).real()).eigenvalues()[0]);
    ASSERT_LT(lowest, 0);
    EXPECT_FALSE(certificate(m, 0).passive) << "seed " << seed;
    EXPECT_FALSE(hamiltonian_passive(m, -lowest / 2)) << "seed " << seed;
    EXPECT_TRUE(hamiltonian_passive(m, -1.2 * lowest + 1e-6)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace certificate_test
