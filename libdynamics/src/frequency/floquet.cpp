#include "dynamics/frequency/floquet.hpp"

#include <algorithm>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"

namespace dynamics::frequency {

// (Q9)
Eigen::MatrixXd monodromy(const PeriodicMatrix& a, double period_s, double tolerance) {
  namespace odeint = boost::numeric::odeint;
  hydro::require(std::isfinite(period_s) && period_s > 0, "a period must be positive, got {} s", period_s);
  const Eigen::MatrixXd at_start = a(0);
  const Eigen::Index n = at_start.rows();
  hydro::require(n > 0 && at_start.cols() == n && at_start.allFinite(),
                 "the matrix of a periodic system must be square and finite, got {} x {}", n, at_start.cols());
  using Columns = std::vector<double>;
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
  Columns x(identity.data(), identity.data() + n * n);
  const auto rate = [&](const Columns& from, Columns& out, double t) {
    Eigen::Map<Eigen::MatrixXd>(out.data(), n, n).noalias() =
        a(t) * Eigen::Map<const Eigen::MatrixXd>(from.data(), n, n);
  };
  odeint::integrate_adaptive(odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<Columns>()),
                             rate, x, 0.0, period_s, period_s / 64);
  const Eigen::MatrixXd out = Eigen::Map<const Eigen::MatrixXd>(x.data(), n, n);
  if (!out.allFinite())
    throw hydro::NumericsError(
        fmt::format("a motion leaves the range of doubles within a period of {:.6g} s", period_s));
  return out;
}

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Eigen::VectorXcd largest_first(const MatrixXd& monodromy) {
  Eigen::VectorXcd out = hydro::dense::eigenvalues(monodromy);
  std::sort(out.begin(), out.end(), [](const auto& x, const auto& y) { return std::abs(x) > std::abs(y); });
  return out;
}

MatrixXd solved(const MatrixXd& matrix, MatrixXd right) {
  const hydro::dense::Lu factors(matrix);
  for (auto column : right.colwise()) column = factors.solve(column);
  return right;
}

/// Gauss's collocation at the five zeros of Legendre's polynomial on [0, 1]: a step of order ten (Hairer & Wanner 1996,
/// section IV.5).
struct GaussPoints {
  static constexpr Index count = 5;
  VectorXd c{count}, b;
  MatrixXd a;

  GaussPoints() {
    const double root = 2 * std::sqrt(10.0 / 7), near = std::sqrt(5 - root) / 6, far = std::sqrt(5 + root) / 6;
    c << 0.5 - far, 0.5 - near, 0.5, 0.5 + near, 0.5 + far;
    // Powers up to the fourth are integrated as they are: Σ_j a_ij c_jᵏ = c_iᵏ⁺¹/(k + 1), and b to 1.
    MatrixXd powers(count, count), integrals(count + 1, count);
    for (Index k = 0; k < count; ++k) {
      powers.col(k) = c.array().pow(static_cast<double>(k));
      integrals.col(k) << c.array().pow(static_cast<double>(k + 1)), 1;
      integrals.col(k) /= static_cast<double>(k + 1);
    }
    const MatrixXd weights = solved(powers.transpose(), integrals.transpose()).transpose();
    a = weights.topRows(count);
    b = weights.bottomRows(1).transpose();
  }
};

/// Steps of one length. At the points of a step Z = G0 z₀ + G1 U, U = V X, which leaves equations of X alone; at its
/// end z = F0 z₀ + F1 U.
class MemoryStep {
 public:
  MemoryStep(const PeriodicWithMemory& system, double h) : system_(system), h_(h) {
    const Index s = GaussPoints::count, z = system.A.rows(), m = system.B.cols();
    G0_ = MatrixXd(s * z, z), G1_ = MatrixXd(s * z, s * m);
    F0_ = MatrixXd::Identity(z, z), F1_ = MatrixXd(z, s * m);
    if (z == 0) return;
    MatrixXd inside = MatrixXd::Identity(s * z, s * z), right(s * z, z + s * m);
    for (Index i = 0; i < s; ++i) {
      right.block(i * z, 0, z, z).setIdentity();
      for (Index j = 0; j < s; ++j) {
        inside.block(i * z, j * z, z, z) -= h * gauss_.a(i, j) * system.A;
        right.block(i * z, z + j * m, z, m) = h * gauss_.a(i, j) * system.B;
      }
      F1_.middleCols(i * m, m) = h * gauss_.b[i] * system.B;
    }
    const MatrixXd at_points = solved(inside, std::move(right));
    G0_ = at_points.leftCols(z), G1_ = at_points.rightCols(s * m);
    for (Index i = 0; i < s; ++i) {
      F0_ += h * gauss_.b[i] * system.A * G0_.middleRows(i * z, z);
      F1_ += h * gauss_.b[i] * system.A * G1_.middleRows(i * z, z);
    }
  }

  /// Columns (x; z) from `t` on to t + h.
  void advance(double t, MatrixXd& columns) const {
    const Index s = GaussPoints::count, z = system_.A.rows(), m = system_.B.cols(), n = columns.rows() - z;
    const MatrixXd x = columns.topRows(n), before = columns.bottomRows(z);
    MatrixXd rate_by_x = MatrixXd::Zero(s * n, s * n), rate(s * n, columns.cols()), V = MatrixXd::Zero(s * m, s * n);
    std::vector<PeriodicWithMemory::Varying> at;
    for (Index j = 0; j < s; ++j) {
      at.push_back(system_.at(t + gauss_.c[j] * h_));
      V.block(j * m, j * n, m, n) = at.back().V;
    }
    for (Index j = 0; j < s; ++j) {
      const auto& here = at[static_cast<std::size_t>(j)];
      rate_by_x.block(j * n, j * n, n, n) = here.P;
      rate_by_x.middleRows(j * n, n) += here.Q * G1_.middleRows(j * z, z) * V;
      rate.middleRows(j * n, n) = here.Q * G0_.middleRows(j * z, z) * before;
    }
    MatrixXd inside = MatrixXd::Identity(s * n, s * n), right(s * n, columns.cols());
    for (Index i = 0; i < s; ++i) {
      right.middleRows(i * n, n) = x;
      for (Index j = 0; j < s; ++j) {
        inside.middleRows(i * n, n) -= h_ * gauss_.a(i, j) * rate_by_x.middleRows(j * n, n);
        right.middleRows(i * n, n) += h_ * gauss_.a(i, j) * rate.middleRows(j * n, n);
      }
    }
    const MatrixXd X = solved(inside, std::move(right));
    rate += rate_by_x * X;
    for (Index j = 0; j < s; ++j) columns.topRows(n) += h_ * gauss_.b[j] * rate.middleRows(j * n, n);
    columns.bottomRows(z) = F0_ * before + F1_ * (V * X);
  }

 private:
  const PeriodicWithMemory& system_;
  double h_;
  GaussPoints gauss_;
  MatrixXd G0_, G1_, F0_, F1_;
};

MatrixXd by_steps(const PeriodicWithMemory& system, Index n, double period_s, int steps) {
  const MemoryStep step(system, period_s / steps);
  MatrixXd out = MatrixXd::Identity(n, n);
  for (int i = 0; i < steps; ++i) step.advance(period_s * i / steps, out);
  return out;
}

}  // namespace

MatrixXd monodromy(const PeriodicWithMemory& system, double period_s, double tolerance) {
  hydro::require(std::isfinite(period_s) && period_s > 0, "a period must be positive, got {} s", period_s);
  constexpr int fewest = 8, most = 4096;
  // Halved steps leave a 2⁻¹⁰ of the change, and of what is fast beside a step, for which the order is five, a 2⁻⁵.
  constexpr double left = 1.0 / 32;
  const Index n = system.at(0).P.rows() + system.A.rows();
  MatrixXd before = by_steps(system, n, period_s, fewest);
  for (int steps = 2 * fewest; steps <= most; steps *= 2) {
    MatrixXd out = by_steps(system, n, period_s, steps);
    if (!out.allFinite())
      throw hydro::NumericsError(
          fmt::format("a motion leaves the range of doubles within a period of {:.6g} s", period_s));
    if ((out - before).norm() * left <= tolerance * out.norm()) return out;
    before = std::move(out);
  }
  throw hydro::NumericsError(fmt::format(
      "{} steps of a period of {:.6g} s do not tell what it makes of motions to {:.2g}", most, period_s, tolerance));
}

Eigen::VectorXcd floquet_multipliers(const PeriodicWithMemory& system, double period_s, double tolerance) {
  return largest_first(monodromy(system, period_s, tolerance));
}

Eigen::VectorXcd floquet_multipliers(const PeriodicMatrix& a, double period_s, double tolerance) {
  return largest_first(monodromy(a, period_s, tolerance));
}

}  // namespace dynamics::frequency
