#include "equations.hpp"

#include <cmath>
#include <limits>

#include "algebra/complex_sparse_lu.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"

namespace dynamics::frequency {

using Complex = std::complex<double>;
using Eigen::Index, Eigen::MatrixXcd, Eigen::VectorXcd;

namespace {

/// True if sparse factors cost less: by the bodies that move each other, by forces and joints and by the waves that
/// they radiate.
bool prefer_sparse(const SmallMotions& about, const std::vector<PotentialGroup>& groups) {
  BlockPattern pattern = about.model.pattern();
  for (const PotentialGroup& g : groups)
    for (const int i : g.bodies)
      for (const int j : g.bodies)
        if (g.radiation && i < j) pattern.couple(i, j);
  pattern.freeze();
  return BlockSolver(pattern).is_sparse();
}

}  // namespace

void Impedance::add(int on, int by, const Block& block) {
  if (dense) {
    dense->block<6, 6>(6 * on, 6 * by) += block;
    return;
  }
  for (int c = 0; c < 6; ++c)
    for (int r = 0; r < 6; ++r)
      if (block(r, c) != 0.0) entries.emplace_back(6 * on + r, 6 * by + c, block(r, c));
}

Equations::Equations(const SmallMotions& about, const std::vector<PotentialGroup>& groups, BelowData below)
    : about_(about),
      groups_(groups),
      below_(below),
      sparse_(prefer_sparse(about, groups)),
      mass_(about.mass.diagonal()) {
  for (int m = 0; m < about.model.modes(); ++m)
    if (about.model.is_free(m)) free_.push_back(m);
  if (sparse_)
    prepare_sparse();
  else
    prepare_dense();
}

void Equations::prepare_dense() {
  left_.emplace(about_);
  if (about_.linear.constraints.rows() == 0) return;
  // Only free modes have an equation, and rows are scaled so that newtons and newton metres compare.
  scale_ = Eigen::VectorXd::Zero(about_.model.modes());
  for (const int m : free_) scale_[m] = 1 / std::sqrt(mass_[m]);
  open_.emplace(scale_.asDiagonal() * about_.linear.constraints.transpose());
}

void Equations::prepare_sparse() {
  place_.assign(static_cast<std::size_t>(about_.model.modes()), -1);
  for (std::size_t i = 0; i < free_.size(); ++i) place_[static_cast<std::size_t>(free_[i])] = static_cast<int>(i);
  const Eigen::MatrixXd& G = about_.linear.constraints;
  const auto put_body = [&](Index constraint, int body) {
    const auto row = static_cast<int>(free_.size() + static_cast<std::size_t>(constraint));
    for (int m = 6 * body; m < 6 * body + 6; ++m)
      if (const int at = place_[static_cast<std::size_t>(m)]; at >= 0 && G(constraint, m) != 0) {
        joint_entries_.emplace_back(row, at, G(constraint, m));
        joint_entries_.emplace_back(at, row, G(constraint, m));
      }
  };
  for (Index k = 0; k < G.rows(); ++k) {
    const Constraint& c = about_.model.joints().constraints()[static_cast<std::size_t>(k)];
    put_body(k, c.first);
    if (c.second) put_body(k, *c.second);
  }
}

// (Q1)
Impedance Equations::impedance(double omega) const {
  const Complex i_omega(0, omega);
  Impedance Z;
  if (!sparse_) Z.dense.emplace(MatrixXcd::Zero(about_.model.modes(), about_.model.modes()));
  const BlockPattern& pattern = about_.model.pattern();
  for (int i = 0; i < pattern.bodies(); ++i)
    for (const int j : pattern.columns(i))
      Z.add(i, j,
            about_.linear.stiffness.block<6, 6>(6 * i, 6 * j) +
                i_omega * about_.linear.damping.block<6, 6>(6 * i, 6 * j) -
                (omega * omega * about_.mass.block<6, 6>(6 * i, 6 * j)).cast<Complex>());
  for (const PotentialGroup& g : groups_) {
    if (!g.radiation) continue;
    const bool from_zero = below_ == BelowData::straight_to_zero;
    const Eigen::MatrixXd A = from_zero ? g.table.added_mass_from_zero(omega) : g.table.added_mass(omega),
                          B = from_zero ? g.table.damping_from_zero(omega) : g.table.damping(omega);
    for (std::size_t i = 0; i < g.bodies.size(); ++i)
      for (std::size_t j = 0; j < g.bodies.size(); ++j) {
        const auto row = 6 * static_cast<Index>(i), column = 6 * static_cast<Index>(j);
        Z.add(g.bodies[i], g.bodies[j],
              i_omega * B.block<6, 6>(row, column) - (omega * omega * A.block<6, 6>(row, column)).cast<Complex>());
      }
  }
  return Z;
}

/// λ, from what motions leave open of the equations of motion.
MatrixXcd Equations::multipliers(const MatrixXcd& rest) const {
  MatrixXcd lambda(about_.linear.constraints.rows(), rest.cols());
  lambda.real() = open_->solve(scale_.asDiagonal() * rest.real());
  lambda.imag() = open_->solve(scale_.asDiagonal() * rest.imag());
  return lambda;
}

std::optional<Motions> Equations::solve_dense(const MatrixXcd& Z, const MatrixXcd& X) const {
  constexpr double working_precision = 1e-15;
  const hydro::dense::ComplexLu lu(left_->matrix(Z));
  if (!(lu.rcond() > working_precision)) return std::nullopt;
  Motions out{left_->expanded(lu.solve(left_->vector(X))), MatrixXcd(0, X.cols())};
  if (open_) out.lambda = multipliers(X - Z * out.xi);
  return out;
}

std::optional<Motions> Equations::solve_sparse(const std::vector<Impedance::Entry>& Z, const MatrixXcd& X) const {
  const auto free = static_cast<Index>(free_.size()), joints = about_.linear.constraints.rows();
  std::vector<Impedance::Entry> entries = joint_entries_;
  entries.reserve(entries.size() + Z.size());
  for (const Impedance::Entry& e : Z) {
    const int row = place_[static_cast<std::size_t>(e.row())], column = place_[static_cast<std::size_t>(e.col())];
    if (row >= 0 && column >= 0) entries.emplace_back(row, column, e.value());
  }
  ComplexSparseLu::Matrix matrix(free + joints, free + joints);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const ComplexSparseLu lu(matrix);
  if (lu.is_singular()) return std::nullopt;
  MatrixXcd right = MatrixXcd::Zero(free + joints, X.cols());
  right.topRows(free) = X(free_, Eigen::all);
  const MatrixXcd both = lu.solve(right);
  Motions out{MatrixXcd::Zero(X.rows(), X.cols()), both.bottomRows(joints)};
  out.xi(free_, Eigen::all) = both.topRows(free);
  return out;
}

std::optional<Motions> Equations::solve_any(const Impedance& Z, const MatrixXcd& X) const {
  auto out = Z.dense ? solve_dense(*Z.dense, X) : solve_sparse(Z.entries, X);
  if (out && !out->xi.allFinite()) out.reset();
  return out;
}

Motions Equations::solve(const Impedance& Z, const MatrixXcd& X, double omega) const {
  if (auto out = solve_any(Z, X); out && !is_rounding(out->xi, X, omega)) return *std::move(out);
  refuse(Z, omega);
}

// At a resonance that nothing damps stiffness and inertia cancel to what rounding leaves of them, and loads over that
// are an answer without a digit.
bool Equations::is_rounding(const MatrixXcd& xi, const MatrixXcd& X, double omega) const {
  constexpr double epsilon = std::numeric_limits<double>::epsilon(), most = 1e-5;  // of the loads
  const Eigen::VectorXd cancelled = about_.linear.stiffness.diagonal().cwiseAbs() + omega * omega * mass_;
  return epsilon * (cancelled.asDiagonal() * xi).norm() > most * X.norm();
}

// Which motion Z does not answer: three turns of inverse iteration in the metric of the masses, Z moved off the
// singular one by a billionth of its largest |Z x| over |M x|.
void Equations::refuse(Impedance Z, double omega) const {
  constexpr double little = 1e-9;
  const std::string what =
      omega == 0 ? "no static answer to a constant load exists: the stiffness is singular"
                 : fmt::format("no response exists at {:.6g} rad/s: the equations of motion are singular there", omega);
  const double largest = omega * omega + about_.linear.stiffness.diagonal().cwiseAbs().cwiseQuotient(mass_).maxCoeff();
  const hydro::RandomStream random(1, 0);
  VectorXcd x(mass_.size());
  for (Index m = 0; m < mass_.size(); ++m) x[m] = random.normal(static_cast<std::uint64_t>(m));
  for (int b = 0; b < static_cast<int>(about_.model.bodies().size()); ++b) {
    const Vector6 moved = little * largest * mass_.segment<6>(6 * b);
    Z.add(b, b, Complex(0, 1) * Matrix6(moved.asDiagonal()));
  }
  for (int turn = 0; turn < 3; ++turn) {
    const auto next = solve_any(Z, mass_.asDiagonal() * x);
    if (!next) throw hydro::NumericsError(what);
    x = next->xi / std::sqrt(next->xi.col(0).cwiseAbs2().dot(mass_));
  }
  Index most = 0;
  x.cwiseAbs2().cwiseProduct(mass_).maxCoeff(&most);
  const std::string motion = about_.model.mode_name(static_cast<int>(most));
  const double restored = std::abs(x.dot(about_.linear.stiffness.cast<Complex>() * x));
  throw hydro::NumericsError(what + (omega == 0 || restored < 0.5 * omega * omega
                                         ? fmt::format("; nothing holds {}: name what restores it, or hold it", motion)
                                         : fmt::format("; {} resonates, and nothing damps it", motion)));
}

}  // namespace dynamics::frequency
