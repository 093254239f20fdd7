#include "dynamics/frequency/modes.hpp"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "hydro/base/dense.hpp"
#include "reduction.hpp"
#include "scatter.hpp"

namespace dynamics::frequency {
namespace {

using Complex = std::complex<double>;
constexpr double slowest_of_all = 1e-6;  // rad/s: two months

/// Matrices of the free motions.
class FreeMotions {
 public:
  FreeMotions(const SmallMotions& about, const std::vector<PotentialGroup>& groups)
      : groups_(groups), size_(about.model.modes()), reduction_(about) {
    stiffness_ = reduced(about.linear.stiffness);
    damping_ = reduced(about.linear.damping);
    mass_ = reduced(about.mass);
    gyration_.resize(size_);
    for (int m = 0; m < size_; ++m) gyration_[m] = radius_of_gyration(about.model, m);
    scale_ = mass_.diagonal().cwiseSqrt().cwiseInverse();
  }

  Eigen::Index count() const { return reduction_.count(); }
  const Eigen::MatrixXd& stiffness() const { return stiffness_; }
  /// A matrix in motions x/scale, in which all dry masses are one; and a motion back from there.
  Eigen::MatrixXd scaled(const Eigen::MatrixXd& m) const { return scale_.asDiagonal() * m * scale_.asDiagonal(); }
  Eigen::VectorXd unscaled(const Eigen::VectorXd& x) const { return scale_.cwiseProduct(x); }
  /// The smallest eigenvalue of the scaled M + A(ω).
  double lightest(double omega) const { return hydro::dense::symmetric_eigenvalues(scaled(mass(omega))).minCoeff(); }

  /// Frequencies at which any table has a row.
  std::vector<double> frequencies() const {
    std::vector<double> out;
    for (const PotentialGroup& g : groups_)
      if (g.radiation) out.insert(out.end(), g.table.coefficients().omega.begin(), g.table.coefficients().omega.end());
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  bool inside_data(double omega) const {
    return std::all_of(groups_.begin(), groups_.end(), [&](const PotentialGroup& g) {
      return !g.radiation || (omega >= g.table.lowest() && omega <= g.table.highest());
    });
  }

  /// M + A(ω); outside a table its nearest end.
  Eigen::MatrixXd mass(double omega) const {
    return mass_ + gathered([&](const auto& table) { return table.added_mass(clamped(omega, table)); });
  }
  /// D + B(ω), as mass().
  Eigen::MatrixXd damping(double omega) const {
    return damping_ + gathered([&](const auto& table) { return table.damping(clamped(omega, table)); });
  }

  /// Displacements of all motions, turns as the way of the radius of gyration, m; a column each.
  Eigen::MatrixXd displacements(const Eigen::MatrixXd& x) const {
    return gyration_.asDiagonal() * reduction_.expanded(x);
  }
  /// Displacements of all motions, scaled as Mode::shape says. `x` is real up to a common factor.
  template <class Vector>
  Vector shape(const Vector& x) const {
    Eigen::Index largest = 0;
    const Vector out = reduction_.expanded(x);
    gyration_.cwiseProduct(out.cwiseAbs()).maxCoeff(&largest);
    return out / (gyration_[largest] * out[largest]);
  }

 private:
  static double clamped(double omega, const hydro::potential::FrequencyTable& table) {
    return std::clamp(omega, table.lowest(), table.highest());
  }

  static double radius_of_gyration(const Model& model, int mode) {
    const RigidBody& body = model.bodies()[static_cast<std::size_t>(mode / 6)];
    return mode % 6 < 3 ? 1 : std::sqrt(body.inertia()(mode % 6 - 3, mode % 6 - 3) / body.mass());
  }

  /// Symmetric: K, M and A of a system at rest are, but for the discretisation error of panel codes.
  Eigen::MatrixXd reduced(const Eigen::MatrixXd& whole) const {
    return hydro::dense::symmetric_part(reduction_.matrix(whole));
  }

  template <class Of>
  Eigen::MatrixXd gathered(Of of) const {
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(size_, size_);
    for (const PotentialGroup& g : groups_)
      if (g.radiation) scatter_add(g.bodies, Eigen::MatrixXd(of(g.table)), whole);
    return reduced(whole);
  }

  const std::vector<PotentialGroup>& groups_;
  Eigen::Index size_;
  Reduction reduction_;
  Eigen::VectorXd gyration_;  // one a mode of the model
  Eigen::VectorXd scale_;
  Eigen::MatrixXd stiffness_, damping_, mass_;
};

/// K − ω²(M + A(ω)), in motions scaled so that each body's own mass is one; its eigenvalues are μ_1 ≤ … ≤ μ_n.
Eigen::MatrixXd dynamic_stiffness(const FreeMotions& system, double omega) {
  return system.scaled(system.stiffness() - omega * omega * system.mass(omega));
}

Eigen::VectorXd eigenvalues(const FreeMotions& system, double omega) {
  return hydro::dense::symmetric_eigenvalues(dynamic_stiffness(system, omega));
}

struct Bracket {
  double omega, value;
};

/// The root of μ_k between two frequencies where it differs in sign (Q2): false position by Illinois' rule.
double own_frequency(const FreeMotions& system, Eigen::Index k, Bracket low, Bracket high) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  for (int i = 0; i < 200 && high.omega - low.omega > 4 * epsilon * high.omega; ++i) {
    const double omega = (low.omega * high.value - high.omega * low.value) / (high.value - low.value);
    const Eigen::VectorXd mu = eigenvalues(system, omega);
    if (std::abs(mu[k]) <= epsilon * mu.cwiseAbs().maxCoeff()) return omega;  // rounding of the eigenvalues
    // The end that stays counts half, so that both ends move.
    if ((mu[k] > 0) == (low.value > 0)) {
      low = {omega, mu[k]};
      high.value /= 2;
    } else {
      high = {omega, mu[k]};
      low.value /= 2;
    }
  }
  return (low.omega + high.omega) / 2;
}

/// Roots of x^T F(s) x = 0, F = s² m + s c + k of matrices (Q3); the one nearest to `near`.
Complex rayleigh(const Eigen::VectorXcd& x, const Eigen::MatrixXd& m, const Eigen::MatrixXd& c,
                 const Eigen::MatrixXd& k, Complex near) {
  const auto form = [&](const Eigen::MatrixXd& a) { return (x.transpose() * a.cast<Complex>() * x).value(); };
  const Complex a = form(m), b = form(c), root = std::sqrt(b * b - 4.0 * a * form(k));
  const Complex one = (-b + root) / (2.0 * a), other = (-b - root) / (2.0 * a);
  return std::abs(one - near) < std::abs(other - near) ? one : other;
}

/// Modal assurance criterion: 1 for equal shapes, 0 for shapes that have nothing in common.
double likeness(const Eigen::VectorXcd& x, const Eigen::VectorXd& y) {
  return std::norm(y.cast<Complex>().dot(x)) / (x.squaredNorm() * y.squaredNorm());
}

/// F x = 0 to rounding. Where several motions have one root, inverse iteration would leave this one for any mixture.
bool is_root(const Eigen::MatrixXcd& F, const Eigen::VectorXcd& x) {
  constexpr double rounding = 1e-13;
  return (F * x).norm() <= rounding * (F.cwiseAbs() * x.cwiseAbs()).norm();
}

std::optional<DampedMode> damped(const FreeMotions& system, double omega, const Eigen::VectorXd& undamped) {
  Complex s(0, omega);
  Eigen::VectorXcd x = undamped.cast<Complex>();
  for (int i = 0; i < 200; ++i) {
    const Eigen::MatrixXd m = system.mass(s.imag()), c = system.damping(s.imag());
    const Complex next = rayleigh(x, m, c, system.stiffness(), s);
    if (!(next.imag() > 1e-3 * omega)) return std::nullopt;
    const bool settled = std::abs(next - s) < 1e-12 * std::abs(next);
    s = next;
    const Eigen::MatrixXcd F = s * s * m + s * c + system.stiffness();
    if (is_root(F, x)) return DampedMode{s, system.shape(x)};
    // One step of inverse iteration towards the shape; F is near singular on purpose, its rounding lies along x.
    const Eigen::VectorXcd y = hydro::dense::ComplexLu(F).solve((2.0 * s * m + c) * x);
    if (y.allFinite() && y.norm() > 0) x = y / y.norm();
    if (!settled || i < 3) continue;
    // The iteration may end at another motion. |s| = ω whatever the damping, but for A that changes with frequency; and
    // three modes of nearly one frequency, mixed by their damping, are a third like each.
    if (likeness(x, undamped) < 0.3 || std::abs(std::abs(s) - omega) > 0.1 * omega) return std::nullopt;
    return DampedMode{s, system.shape(x)};
  }
  return std::nullopt;
}

/// n − 1 columns that are orthonormal, and across a unit vector: those of Householder's mirror.
Eigen::MatrixXd across(const Eigen::VectorXd& along) {
  const Eigen::Index n = along.size();
  Eigen::VectorXd normal = along;
  normal[0] += std::copysign(1.0, along[0]);
  const Eigen::MatrixXd mirror =
      Eigen::MatrixXd::Identity(n, n) - 2 / normal.squaredNorm() * normal * normal.transpose();
  return mirror.rightCols(n - 1);
}

/// The combination of columns in which the largest motion of all is as large as can be, those that have nothing of it,
/// and so on among these: of motions of one frequency, in place of any mixture of them, those of few bodies.
Eigen::MatrixXd purest(const Eigen::MatrixXd& motions) {
  const Eigen::Index count = motions.cols();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(count, count), left = Eigen::MatrixXd::Identity(count, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    Eigen::Index largest = 0;
    const Eigen::MatrixXd of_left = motions * left;
    of_left.rowwise().squaredNorm().maxCoeff(&largest);
    const Eigen::VectorXd along = of_left.row(largest).normalized();
    out.col(k) = left * along;
    left = left * across(along);
  }
  return out;
}

/// Motions x of one frequency so that neither M nor the damping mixes them: any combination of columns is one too. (Q2)
Eigen::MatrixXd apart(const FreeMotions& system, double omega, Eigen::MatrixXd x) {
  const Eigen::MatrixXd energy = x.transpose() * system.mass(omega) * x;
  const hydro::dense::Cholesky factor(energy);
  if (!factor) return x;  // about a resonance of the water M + A is no energy
  const Eigen::MatrixXd L = factor.L();
  x = L.triangularView<Eigen::Lower>().solve(x.transpose()).transpose().eval();
  x *= purest(system.displacements(x));
  Eigen::MatrixXd damping = hydro::dense::symmetric_part(x.transpose() * system.damping(omega) * x);
  const double rounding = 1e-10 * damping.cwiseAbs().maxCoeff();
  damping = (damping.array().abs() > rounding).select(damping, 0);
  if (damping.isDiagonal(0)) return x;
  return x * hydro::dense::symmetric_eigen(damping).vectors;
}

/// The modes of so many roots at one frequency, or so near to each other that rounding hides which is which.
std::vector<Mode> modes_at(const FreeMotions& system, double omega, std::size_t count) {
  const auto eigen = hydro::dense::symmetric_eigen(dynamic_stiffness(system, omega));
  std::vector<Eigen::Index> order(static_cast<std::size_t>(eigen.values.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return std::abs(eigen.values[a]) < std::abs(eigen.values[b]); });
  Eigen::MatrixXd x(eigen.vectors.rows(), static_cast<Eigen::Index>(count));
  for (Eigen::Index k = 0; k < x.cols(); ++k)
    x.col(k) = system.unscaled(eigen.vectors.col(order[static_cast<std::size_t>(k)]));
  if (count > 1) x = apart(system, omega, std::move(x));
  std::vector<Mode> out;
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    const Eigen::VectorXd motion = x.col(k);
    out.push_back({omega, system.shape(motion), !system.inside_data(omega), damped(system, omega, motion)});
  }
  return out;
}

/// How far apart two roots can be told, rad/s: eigenvalues are right to some ε of the largest, and fall with ω by 2ω
/// times a mass that is no less than the dry one, 1.
double told_apart(const FreeMotions& system, double omega) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon(), roundings = 100, most = 1e-4;
  const double largest = eigenvalues(system, omega).cwiseAbs().maxCoeff();
  return std::min(most * omega, roundings * epsilon * (omega + largest / omega));
}

/// Of sorted roots.
std::vector<Mode> modes_of(const FreeMotions& system, const std::vector<double>& roots) {
  std::vector<Mode> out;
  for (std::size_t first = 0, end; first < roots.size(); first = end) {
    const double near = told_apart(system, roots[first]);
    for (end = first + 1; end < roots.size() && roots[end] - roots[end - 1] <= near;) ++end;
    for (Mode& mode : modes_at(system, (roots[first] + roots[end - 1]) / 2, end - first))
      out.push_back(std::move(mode));
  }
  return out;
}

constexpr double no_stiffness = 1e-9;  ///< of that of the stiffest motion
/// Scaled by masses, 1/s²: of the slowest motion. Less is rounding, where nothing is stiff, as between slack lines.
constexpr double no_stiffness_at_all = slowest_of_all * slowest_of_all;

/// True unless some motion has less stiffness than none: the pivots of the factors have the signs of the eigenvalues.
/// Of a thousand bodies that only connectors join, factors are sparse.
bool holds(const SmallMotions& about) {
  const Reduction reduction(about);
  const Eigen::VectorXd scale = reduction.matrix(about.mass).diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd whole = hydro::dense::symmetric_part(reduction.matrix(about.linear.stiffness));
  Eigen::SparseMatrix<double> K = (scale.asDiagonal() * whole * scale.asDiagonal()).sparseView();
  Eigen::SparseMatrix<double> none(K.rows(), K.cols());
  none.setIdentity();
  const double stiffest = whole.diagonal().cwiseAbs().cwiseProduct(scale.cwiseAbs2()).maxCoeff();
  K += std::max(no_stiffness * stiffest, no_stiffness_at_all) * none;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(K);
  return factors.info() == Eigen::Success && factors.vectorD().minCoeff() > 0;
}

/// Motions with no stiffness, or less than none.
void add_unrestored(const FreeMotions& system, ModeList& out) {
  const auto K = hydro::dense::symmetric_eigen(dynamic_stiffness(system, 0));
  const double none = std::max(no_stiffness * K.values.cwiseAbs().maxCoeff(), no_stiffness_at_all);
  for (Eigen::Index k = 0; k < system.count() && K.values[k] <= none; ++k)
    (K.values[k] < -none ? out.toppling : out.adrift)
        .push_back(system.shape(Eigen::VectorXd(system.unscaled(K.vectors.col(k)))));
}

}  // namespace

Eigen::VectorXd Mode::energy_share(const SmallMotions& about) const {
  const Eigen::VectorXd share = shape.cwiseProduct(about.mass * shape);
  return share / share.sum();
}

std::vector<Eigen::VectorXd> toppling_motions(const SmallMotions& about) {
  ModeList out;
  if (Reduction(about).count() > 0 && !holds(about)) add_unrestored(FreeMotions(about, {}), out);
  return out.toppling;
}

ModeList free_motions(const SmallMotions& about, const std::vector<PotentialGroup>& groups) {
  const FreeMotions system(about, groups);
  ModeList out;
  if (system.count() == 0) return out;
  add_unrestored(system, out);
  std::vector<double> nodes = system.frequencies();
  for (const double omega : nodes)
    if (!hydro::dense::Cholesky(system.mass(omega))) out.indefinite_at.push_back(omega);
  // Beyond either end of the tables the added mass no longer changes, so the roots there can be bounded.
  const double lightest = system.lightest(nodes.empty() ? 1 : nodes.back());
  const double stiffest = eigenvalues(system, 0).maxCoeff();
  nodes.insert(nodes.begin(), slowest_of_all);
  if (lightest > 0) nodes.push_back(2 * std::max(nodes.back(), std::sqrt(std::max(0.0, stiffest) / lightest)));
  std::vector<double> roots;
  Eigen::VectorXd before = eigenvalues(system, nodes.front());
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const Eigen::VectorXd here = eigenvalues(system, nodes[i]);
    for (Eigen::Index k = 0; k < system.count(); ++k)
      if ((before[k] > 0) != (here[k] > 0))
        roots.push_back(own_frequency(system, k, {nodes[i - 1], before[k]}, {nodes[i], here[k]}));
    before = here;
  }
  std::sort(roots.begin(), roots.end());
  out.modes = modes_of(system, roots);
  return out;
}

}  // namespace dynamics::frequency
