#include "dynamics/frequency/sea_drag.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <deque>
#include <numbers>

#include "drag_motion.hpp"
#include "dynamics/frequency/linear_drag.hpp"
#include "equations.hpp"
#include "hydro/base/error.hpp"

namespace dynamics::frequency {

using Eigen::Index, Eigen::MatrixXcd, Eigen::VectorXd;

// In units of σ along each axis the velocity has an angle that is uniform and, independent of it, Rayleigh's radius r:
// the mean over the angle is that over an ellipse, and ⟨r³⟩/⟨r²⟩ = (3/2)√(π/2).
double power_equivalent_speed(double sigma_major, double sigma_minor) {
  const Eigen::Vector3cd ellipse(sigma_major, std::complex<double>(0, sigma_minor), 0);
  return 1.5 * std::sqrt(std::numbers::pi / 2) * energy_equivalent_speed(ellipse);
}

namespace {

/// Responses of one frequency to all headings, by what drag changes of them.
struct Cell {
  double omega;
  MatrixXcd load;   ///< without drag, per metre, (modes, headings)
  MatrixXcd water;  ///< velocity at pieces, per metre, (3 pieces, headings)
  VectorXd variance;
};

class SeaResponses {
 public:
  SeaResponses(const SmallMotions& about, const std::vector<PotentialGroup>& groups, const std::vector<double>& omega,
               const std::vector<DragPiece>& pieces, const DragSea& sea)
      : pieces_(turned(pieces, about.still)), slow_(sea.slow), modes_(about.model.modes()), equations_(about, groups) {
    if (slow_.empty()) slow_.assign(pieces.size(), Eigen::Matrix3d::Zero());
    for (std::size_t w = 0; w < omega.size(); ++w) {
      const auto headings = static_cast<Index>(sea.heading.size());
      Cell cell{omega[w], MatrixXcd(modes_, headings), MatrixXcd(3 * static_cast<Index>(pieces.size()), headings),
                sea.variance.col(static_cast<Index>(w))};
      for (Index h = 0; h < headings; ++h) {
        const double heading = sea.heading[static_cast<std::size_t>(h)];
        cell.load.col(h) = excitation(about, groups, omega[w], heading);
        cell.water.col(h) = water_velocity(pieces, about.model.bodies(), sea.water, omega[w], heading);
      }
      cells_.push_back(std::move(cell));
    }
  }

  /// Standard deviations of relative velocities with drag of these coefficients; none: past bodies that do not move.
  Eigen::MatrixX2d sigma(const VectorXd& coefficient) const {
    std::vector<Eigen::Matrix3d> covariance = slow_;
    for (const Cell& cell : cells_) {
      const MatrixXcd xi = motions(cell, coefficient);
      for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const MatrixXcd w = relative(cell, i, xi);
        covariance[i] += (w * cell.variance.asDiagonal() * w.adjoint()).real();
      }
    }
    Eigen::MatrixX2d out(pieces_.size(), 2);
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance[i], Eigen::EigenvaluesOnly);
      // Eigenvalues are right to rounding of the largest: along the axis of the piece, and across a line, they are
      // none.
      constexpr double rounding = 1e-14;
      const double largest = axes.eigenvalues()[2], second = axes.eigenvalues()[1];
      out.row(static_cast<Index>(i)) << std::sqrt(largest), second > rounding * largest ? std::sqrt(second) : 0.0;
    }
    return out;
  }

  VectorXd coefficients(const Eigen::MatrixX2d& sigma) const {
    VectorXd out(sigma.rows());
    for (Index i = 0; i < out.size(); ++i)
      out[i] = pieces_[static_cast<std::size_t>(i)].factor * power_equivalent_speed(sigma(i, 0), sigma(i, 1));
    return out;
  }

 private:
  MatrixXcd motions(const Cell& cell, const VectorXd& coefficient) const {
    if (equations_.are_empty() || coefficient.size() == 0) return MatrixXcd::Zero(modes_, cell.load.cols());
    LinearDrag drag{pieces_, {}, coefficient};
    Impedance Z = equations_.impedance(cell.omega);
    add_drag(drag, 0, cell.omega, Z);
    MatrixXcd load = cell.load;
    for (Index h = 0; h < load.cols(); ++h) {
      drag.velocity = cell.water.col(h);
      load.col(h) += drag.excitation(0, modes_);
    }
    return equations_.solve(Z, load, cell.omega).xi;
  }

  /// Of water and piece, what the piece feels of it, (3, headings).
  MatrixXcd relative(const Cell& cell, std::size_t i, const MatrixXcd& xi) const {
    const DragPiece& piece = pieces_[i];
    return projection(piece) * cell.water.middleRows<3>(3 * static_cast<Index>(i)) -
           std::complex<double>(0, cell.omega) * projected_velocity(piece) * xi.middleRows<6>(6 * piece.body);
  }

  std::vector<DragPiece> pieces_;
  std::vector<Eigen::Matrix3d> slow_;
  Index modes_;
  Equations equations_;
  std::vector<Cell> cells_;
};

/// Anderson's method: the next place of x ← g(x), by the secants of the last turns.
class Secants {
 public:
  VectorXd next(const VectorXd& x, const VectorXd& g) {
    constexpr std::size_t most = 5;  // more of them are nearly parallel, and tell rounding
    const VectorXd f = g - x;
    if (f_.size() > 0) {
      df_.push_back(f - f_);
      dg_.push_back(g - g_);
      if (df_.size() > most) df_.pop_front(), dg_.pop_front();
    }
    f_ = f, g_ = g;
    if (df_.empty()) return (x + g) / 2;  // exact where drag alone limits a response, as in (Q5)
    Eigen::MatrixXd F(f.size(), df_.size()), G(f.size(), df_.size());
    for (std::size_t k = 0; k < df_.size(); ++k) {
      F.col(static_cast<Index>(k)) = df_[k];
      G.col(static_cast<Index>(k)) = dg_[k];
    }
    const VectorXd out = g - G * F.completeOrthogonalDecomposition().solve(f);
    // Secants that lead where no drag is: half the way, which is sure.
    return out.allFinite() && (out.array() >= 0).all() ? out : VectorXd((x + g) / 2);
  }

 private:
  VectorXd f_, g_;
  std::deque<VectorXd> df_, dg_;
};

}  // namespace

SeaDrag drag_in_sea(const SmallMotions& about, const std::vector<PotentialGroup>& groups,
                    const std::vector<double>& omega, const std::vector<DragPiece>& pieces, const DragSea& sea,
                    const VectorXd& start) {
  constexpr int most = 100;
  constexpr double enough = 1e-6;  // of the largest coefficient: far below what a drag coefficient is known to
  const SeaResponses responses(about, groups, omega, pieces, sea);
  SeaDrag out;
  out.coefficient = start.size() > 0 ? start : responses.coefficients(responses.sigma({}));
  Secants secants;
  for (out.iterations = 1; out.iterations <= most; ++out.iterations) {
    out.sigma = responses.sigma(out.coefficient);
    const VectorXd found = responses.coefficients(out.sigma);
    const double largest = found.lpNorm<Eigen::Infinity>();
    const double change = (found - out.coefficient).lpNorm<Eigen::Infinity>();
    out.residual = largest > 0 ? change / largest : 0;
    if (out.residual <= enough) {
      out.coefficient = found;
      return out;
    }
    out.coefficient = secants.next(out.coefficient, found);
  }
  throw hydro::NumericsError(fmt::format(
      "linear drag did not settle in {} turns in this sea: the last would have changed it by {:.2g} of its largest",
      most, out.residual));
}

LinearDrag drag_with(const VectorXd& coefficient, const SmallMotions& about, const std::vector<double>& omega,
                     const std::vector<DragPiece>& pieces, const hydro::Water& water, double heading) {
  const auto frequencies = static_cast<Index>(omega.size());
  LinearDrag drag{.pieces = turned(pieces, about.still),
                  .velocity = MatrixXcd(3 * coefficient.size(), frequencies),
                  .coefficient = coefficient.replicate(1, frequencies)};
  for (Index w = 0; w < frequencies; ++w)
    drag.velocity.col(w) =
        water_velocity(pieces, about.model.bodies(), water, omega[static_cast<std::size_t>(w)], heading);
  return drag;
}

LinearDrag still_water_drag(const VectorXd& coefficient, const SmallMotions& about,
                            const std::vector<DragPiece>& pieces) {
  return {.pieces = turned(pieces, about.still), .velocity = {}, .coefficient = coefficient};
}

namespace {

/// Two axes across a piece, or the one along it, and half way between them, (3, 3) by columns.
Eigen::Matrix3d axes_of(const DragPiece& piece) {
  Eigen::Matrix3d out;
  out.col(0) = piece.along ? piece.axis : piece.axis.unitOrthogonal();
  out.col(1) = piece.axis.cross(out.col(0));
  out.col(2) = (out.col(0) + out.col(1)) / std::numbers::sqrt2;
  return out;
}

}  // namespace

std::vector<Variation> velocities_across(const SmallMotions& about, const std::vector<DragPiece>& pieces) {
  std::vector<Variation> out;
  for (const DragPiece& piece : turned(pieces, about.still)) {
    const Eigen::Matrix<double, 3, 6> rows = axes_of(piece).transpose() * projected_velocity(piece);
    for (int axis = 0; axis < 3; ++axis)
      out.push_back({.parts = {{.body = piece.body, .by_velocity = rows.row(axis)}}});
  }
  return out;
}

// With s of the axis half way, ⟨w₁w₂⟩ = ⟨s²⟩ − (⟨w₁²⟩ + ⟨w₂²⟩)/2.
std::vector<Eigen::Matrix3d> covariances_across(const SmallMotions& about, const std::vector<DragPiece>& pieces,
                                                const VectorXd& variance) {
  std::vector<Eigen::Matrix3d> out;
  for (Index i = 0; i < std::ssize(pieces); ++i) {
    const Eigen::Vector3d of = variance.segment<3>(3 * i);
    const double both = of[2] - (of[0] + of[1]) / 2;
    const Eigen::Matrix3d axes = axes_of(turned(pieces[static_cast<std::size_t>(i)], about.still));
    const Eigen::Matrix<double, 3, 2> across = axes.leftCols<2>();
    out.emplace_back(across * Eigen::Matrix2d{{of[0], both}, {both, of[1]}} * across.transpose());
  }
  return out;
}

}  // namespace dynamics::frequency
