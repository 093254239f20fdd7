#include "dynamics/frequency/floquet.hpp"

#include <algorithm>
#include <boost/numeric/odeint/integrate/integrate_adaptive.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <optional>
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

/// Gauss's collocation at the five zeros of Legendre's polynomial on [0, 1]: a step of order ten (Hairer & Wanner 1996,
/// section IV.5).
struct GaussPoints {
  static constexpr Index count = 5;
  VectorXd c{count}, b;
  MatrixXd a;
  VectorXd ends;  ///< bᵀ a⁻¹: a step's end by what its points are away from its beginning

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
    const MatrixXd weights = integrals * hydro::dense::inverse(powers);
    a = weights.topRows(count);
    b = weights.bottomRows(1).transpose();
    ends = (b.transpose() * hydro::dense::inverse(a)).transpose();
  }
};

/// Rows of a matrix that have entries with none beside them: a memory is a sum of many small ones.
struct MemoryBlock {
  Index from, size;
};
std::vector<MemoryBlock> blocks_of(const MatrixXd& A) {
  std::vector<MemoryBlock> out;
  for (Index from = 0, reach = 0, i = 0; i < A.rows(); ++i) {
    for (Index j = i; j < A.rows(); ++j)
      if (A(i, j) != 0 || A(j, i) != 0) reach = std::max(reach, j);
    if (reach > i) continue;
    out.push_back({from, i + 1 - from});
    from = reach = i + 1;
  }
  return out;
}

/// Steps of one length. At the points of a step Z = G0 z₀ + G1 U, U = V X, which leaves equations of X alone; at its
/// end z = F0 z₀ + F1 U.
class MemoryStep {
 public:
  MemoryStep(const PeriodicWithMemory& system, double h) : system_(system), h_(h), blocks_(blocks_of(system.A)) {
    const Index s = GaussPoints::count, z = system.A.rows(), m = system.B.cols();
    G0_ = MatrixXd::Zero(s * z, z), G1_ = MatrixXd(s * z, s * m);
    F0_ = MatrixXd::Identity(z, z), F1_ = MatrixXd(z, s * m);
    for (const MemoryBlock& block : blocks_) eliminate(block);
  }

  /// Columns (x; z) from `t` on to t + h.
  void advance(double t, MatrixXd& columns) const {
    const Index s = GaussPoints::count, z = system_.A.rows(), m = system_.B.cols(), n = columns.rows() - z;
    MatrixXd rate_by_x(s * n, s * n), rate_by_z(s * n, z);
    std::vector<PeriodicWithMemory::Varying> at;
    for (Index j = 0; j < s; ++j) at.push_back(system_.at(t + gauss_.c[j] * h_));
    for (Index j = 0; j < s; ++j) {
      const auto& here = at[static_cast<std::size_t>(j)];
      const MatrixXd by_velocity = here.Q * G1_.middleRows(j * z, z);
      for (Index i = 0; i < s; ++i)
        rate_by_x.block(j * n, i * n, n, n) =
            by_velocity.middleCols(i * m, m).lazyProduct(at[static_cast<std::size_t>(i)].V);
      rate_by_x.block(j * n, j * n, n, n) += here.P;
      for (const auto& [from, size] : blocks_)
        rate_by_z.block(j * n, from, n, size) =
            here.Q.middleCols(from, size).lazyProduct(G0_.block(j * z + from, from, size, size));
    }
    const MatrixXd rate = rate_by_z * columns.bottomRows(z);
    MatrixXd inside = MatrixXd::Identity(s * n, s * n), right(s * n, columns.cols());
    for (Index i = 0; i < s; ++i) {
      right.middleRows(i * n, n) = columns.topRows(n);
      for (Index j = 0; j < s; ++j) {
        inside.middleRows(i * n, n) -= h_ * gauss_.a(i, j) * rate_by_x.middleRows(j * n, n);
        right.middleRows(i * n, n) += h_ * gauss_.a(i, j) * rate.middleRows(j * n, n);
      }
    }
    const MatrixXd X = hydro::dense::inverse(inside) * right;
    MatrixXd U(s * m, columns.cols());
    for (Index i = 0; i < s; ++i)
      U.middleRows(i * m, m) = at[static_cast<std::size_t>(i)].V.lazyProduct(X.middleRows(i * n, n));
    columns.topRows(n) *= 1 - gauss_.ends.sum();
    for (Index i = 0; i < s; ++i) columns.topRows(n) += gauss_.ends[i] * X.middleRows(i * n, n);
    for (const auto& [from, size] : blocks_)
      columns.middleRows(n + from, size) =
          F0_.block(from, from, size, size).lazyProduct(columns.middleRows(n + from, size)).eval();
    columns.bottomRows(z).noalias() += F1_ * U;
  }

 private:
  /// G0, G1, F0 and F1 of the states of one block.
  void eliminate(const MemoryBlock& block) {
    const Index s = GaussPoints::count, z = system_.A.rows(), m = system_.B.cols(), k = block.size;
    const MatrixXd A = system_.A.block(block.from, block.from, k, k), B = system_.B.middleRows(block.from, k);
    MatrixXd inside = MatrixXd::Identity(s * k, s * k), right(s * k, k + s * m);
    for (Index i = 0; i < s; ++i) {
      right.block(i * k, 0, k, k).setIdentity();
      for (Index j = 0; j < s; ++j) {
        inside.block(i * k, j * k, k, k) -= h_ * gauss_.a(i, j) * A;
        right.block(i * k, k + j * m, k, m) = h_ * gauss_.a(i, j) * B;
      }
      F1_.block(block.from, i * m, k, m) = h_ * gauss_.b[i] * B;
    }
    const MatrixXd at_points = hydro::dense::inverse(inside) * right;
    for (Index i = 0; i < s; ++i) {
      const auto here = at_points.middleRows(i * k, k);
      G0_.block(i * z + block.from, block.from, k, k) = here.leftCols(k);
      G1_.middleRows(i * z + block.from, k) = here.rightCols(s * m);
      F0_.block(block.from, block.from, k, k) += h_ * gauss_.b[i] * A * here.leftCols(k);
      F1_.middleRows(block.from, k) += h_ * gauss_.b[i] * A * here.rightCols(s * m);
    }
  }

  const PeriodicWithMemory& system_;
  double h_;
  GaussPoints gauss_;
  std::vector<MemoryBlock> blocks_;
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
  constexpr int fewest = 8, most = 16384;  // of a motion that grows by 1e141 in a period 4096 did not do
  // Halved steps change Φ by a 2⁻¹⁰ of what those before them did, and by a 2⁻⁵ where states are fast beside a step,
  // for which the order is five: that is supposed first, and then seen.
  constexpr double least = 1.0 / 1024, usual = 1.0 / 32;
  const Index n = system.at(0).P.rows() + system.A.rows();
  MatrixXd before = by_steps(system, n, period_s, fewest);
  std::optional<double> last;
  for (int steps = 2 * fewest; steps <= most; steps *= 2) {
    MatrixXd out = by_steps(system, n, period_s, steps);
    if (!out.allFinite())
      throw hydro::NumericsError(
          fmt::format("a motion leaves the range of doubles within a period of {:.6g} s", period_s));
    const double change = (out - before).norm(), share = last ? std::max(least, change / *last) : usual;
    if (share < 1 && change * share <= tolerance * out.norm()) return out;
    last = change;
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
