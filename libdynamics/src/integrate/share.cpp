#include "share.hpp"

#include <algorithm>
#include <limits>

#include "hydro/base/dense.hpp"

namespace dynamics {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double Bearing::spare(const VectorXd& y) const {
  return held > 0 ? -friction * y[row] - y.segment(row + 1, held).norm() : -y[row];
}

double least_spare(const std::vector<Bearing>& bearings, const VectorXd& y) {
  double least = std::numeric_limits<double>::infinity();
  for (const Bearing& b : bearings) least = std::min(least, b.spare(y));
  return least;
}

MatrixXd without_effect(const MatrixXd& C) {
  constexpr double rounding = 1e-9;  // of the largest: how well arms and directions are known
  MatrixXd wide = MatrixXd::Zero(C.rows(), std::max(C.rows(), C.cols()));
  wide.leftCols(C.cols()) = C;
  const auto parts = hydro::dense::svd(wide);
  const Index rank = (parts.values.array() > rounding * parts.values[0]).count();
  return parts.U.rightCols(C.rows() - rank);
}

namespace {

/// A cone r >= |τ| of which both are linear in the unknowns x: r = r₀ + r'x, τ = τ₀ + T x.
struct Cone {
  double r0;
  VectorXd r;
  VectorXd tau0;
  MatrixXd tau;

  double radius(const VectorXd& x) const { return r0 + r.dot(x); }
  VectorXd inside(const VectorXd& x) const { return tau0 + tau * x; }
  bool holds(const VectorXd& x) const { return radius(x) > inside(x).norm(); }
};

/// Least of weight · (linear·x + ½ x·diag(square) x) − Σ log(r² − |τ|²), which keeps x inside all cones; the larger
/// the weight, the nearer to the least of the goal alone: within 2/weight for each cone.
struct Barrier {
  std::vector<Cone> cones;
  VectorXd linear, square;

  bool holds(const VectorXd& x) const {
    return std::all_of(cones.begin(), cones.end(), [&](const Cone& c) { return c.holds(x); });
  }
  /// Gradient, and the second derivatives if they are wanted.
  VectorXd gradient(double weight, const VectorXd& x, MatrixXd* second) const;
  /// Newton's method towards that least. \returns false where it cannot get nearer
  bool step(double weight, VectorXd& x) const;
};

VectorXd Barrier::gradient(double weight, const VectorXd& x, MatrixXd* second) const {
  VectorXd out = weight * (linear + square.cwiseProduct(x));
  if (second != nullptr) *second = (weight * square).asDiagonal();
  for (const Cone& c : cones) {
    const double r = c.radius(x);
    const VectorXd tau = c.inside(x);
    const double q = (r - tau.norm()) * (r + tau.norm());
    const VectorXd by = 2 * (r * c.r - c.tau.transpose() * tau);  // of q
    out -= by / q;
    if (second != nullptr)
      *second += by * by.transpose() / (q * q) - 2 / q * (c.r * c.r.transpose() - c.tau.transpose() * c.tau);
  }
  return out;
}

// The step is halved until it stays inside and does not go past where the way down ends: sums of logarithms would not
// tell that to the last digits, slopes do.
bool Barrier::step(double weight, VectorXd& x) const {
  MatrixXd second;
  const VectorXd slope = gradient(weight, x, &second);
  const hydro::dense::Cholesky factors(second);
  if (!factors) return false;
  const VectorXd move = -factors.solve(slope);
  const double falls = -slope.dot(move);
  constexpr double near = 1e-6;  // of the barrier's own unit, in which one cone's share of the error is 2
  if (!(falls > near)) return false;
  for (double part = 1; part > 1e-6; part /= 2) {
    const VectorXd there = x + part * move;
    if (!holds(there) || gradient(weight, there, nullptr).dot(move) > falls / 2) continue;
    x = there;
    return true;
  }
  return false;
}

/// Of what bearings have to spare, for the unknowns z, and one more, σ, that all must leave, if it is sought.
Barrier barrier(const MatrixXd& N, const VectorXd& even, const std::vector<Bearing>& bearings, bool seeks) {
  const Index size = N.cols() + (seeks ? 1 : 0);
  Barrier out{{}, VectorXd::Zero(size), VectorXd::Zero(size)};
  for (const Bearing& b : bearings) {
    const double by_load = b.held > 0 ? b.friction : 1;
    Cone cone{-by_load * even[b.row], VectorXd::Zero(size), even.segment(b.row + 1, b.held),
              MatrixXd::Zero(b.held, size)};
    cone.r.head(N.cols()) = -by_load * N.row(b.row).transpose();
    if (seeks) cone.r[N.cols()] = -1;
    cone.tau.leftCols(N.cols()) = N.middleRows(b.row + 1, b.held);
    out.cones.push_back(std::move(cone));
  }
  return out;
}

}  // namespace

VectorXd best_share(const MatrixXd& N, const VectorXd& even, const std::vector<Bearing>& bearings) {
  constexpr double exact = 1e-9;    // of the largest load
  constexpr double farthest = 1e6;  // times the largest load: bodies may press on each other as hard as they like
  const double size = std::max(even.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  Barrier all = barrier(N, even / size, bearings, true);
  const Index sigma = N.cols();
  all.linear[sigma] = -1;
  MatrixXd pick = MatrixXd::Identity(sigma, sigma + 1);
  all.cones.push_back({farthest, VectorXd::Zero(sigma + 1), VectorXd::Zero(sigma), std::move(pick)});
  VectorXd x = VectorXd::Zero(sigma + 1);
  x[sigma] = least_spare(bearings, even / size) - 1;
  const auto loads = [&] { return VectorXd(even + size * (N * x.head(sigma))); };
  const double cones = static_cast<double>(all.cones.size());
  for (double weight = cones; weight < 2 * cones / exact; weight *= 10)
    for (int i = 0; i < 50 && all.step(weight, x); ++i)
      if (least_spare(bearings, loads()) > 0) return loads();
  return loads();
}

VectorXd nearest_share(const MatrixXd& N, const VectorXd& even, const std::vector<Bearing>& bearings,
                       const VectorXd& borne) {
  constexpr double exact = 1e-9;  // of the square of the largest load
  const double size = std::max(even.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  Barrier all = barrier(N, even / size, bearings, false);
  all.square.setOnes();
  VectorXd z = N.transpose() * (borne - even) / size;
  if (!all.holds(z)) return borne;
  const double cones = static_cast<double>(all.cones.size());
  for (double weight = cones; weight < 2 * cones / exact; weight *= 10)
    for (int i = 0; i < 50 && all.step(weight, z); ++i) {
    }
  return even + size * (N * z);
}

}  // namespace dynamics
