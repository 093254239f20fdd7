#include "passivity.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "hydro/base/dense.hpp"
#include "hydro/base/product.hpp"
#include "pole_basis.hpp"

namespace hydro::radiation::detail {
namespace {

using Complex = std::complex<double>;
constexpr double quarter_turn = std::numbers::pi / 2;

bool positive(const Eigen::MatrixXd& Q, double margin) {
  Eigen::MatrixXd shifted = Q;
  shifted.diagonal().array() -= margin;
  return shifted.allFinite() && static_cast<bool>(dense::Cholesky(shifted));
}

/// ‖(C − iS)/2‖ of each pole, Frobenius: an upper bound of the spectral norm of its residue.
Eigen::VectorXd residue_sizes(const std::vector<Pole>& poles, const Eigen::MatrixXd& coefficients) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(poles.size()));
  Eigen::Index column = 0;
  for (std::size_t k = 0; k < poles.size(); ++k) {
    const Eigen::Index width = poles[k].omega > 0 ? 2 : 1;
    out[static_cast<Eigen::Index>(k)] = coefficients.middleRows(column, width).norm() / 2;
    column += width;
  }
  return out;
}

}  // namespace

Eigen::RowVectorXd packed(const Eigen::MatrixXd& m) {
  const Eigen::Index n = m.rows();
  Eigen::RowVectorXd row(n * (n + 1) / 2);
  Eigen::Index at = 0;
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i <= j; ++i) row[at++] = i == j ? m(i, j) : std::numbers::sqrt2 * m(i, j);
  return row;
}

Eigen::MatrixXd unpacked(const Eigen::RowVectorXd& row, Eigen::Index n) {
  Eigen::MatrixXd m(n, n);
  Eigen::Index at = 0;
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i <= j; ++i) {
      const double value = row[at++];
      m(i, j) = m(j, i) = i == j ? value : value / std::numbers::sqrt2;
    }
  return m;
}

WeightedDamping::WeightedDamping(std::vector<Pole> poles, double centre)
    : poles_(std::move(poles)), c_(centre), falling_(falling_at_zero(poles_)) {
  // W/(s − p) with W = −(c² − p²)²/p², and s = c (z − 1)/(z + 1).
  const auto share = [&](Complex p) {
    const Complex W = -std::pow(c_ * c_ - p * p, 2) / (p * p);
    return Share{W / (c_ - p), W * 2.0 * c_ / ((c_ - p) * (c_ - p)), (c_ + p) / (c_ - p)};
  };
  for (const Pole& pole : poles_) shares_.push_back(share({-pole.decay, pole.omega}));
}

Eigen::MatrixXd WeightedDamping::rows(double theta) const {
  const Complex z = std::polar(1.0, 2 * theta), i(0, 1);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3, falling_.size());
  out.row(0) = falling_;
  const auto derivatives = [&](const Share& s) {
    const Complex u = z - s.place, inverse = std::conj(u) / std::norm(u), v = z * inverse;
    const Complex first = s.k * inverse;
    return Eigen::Vector3cd(s.constant + first, -2.0 * i * first * v, first * (4.0 * v - 8.0 * v * v));
  };
  Eigen::Index column = 0;
  for (std::size_t n = 0; n < poles_.size(); ++n) {
    const Share& s = shares_[n];
    const Eigen::Vector3cd up = derivatives(s);
    const Eigen::Vector3cd down = derivatives({std::conj(s.constant), std::conj(s.k), std::conj(s.place)});
    out.col(column++) += ((up + down) / 2.0).real();
    if (poles_[n].omega > 0) out.col(column++) += ((up - down) / 2.0).imag();
  }
  return out / (4 * c_ * c_);
}

Eigen::VectorXd WeightedDamping::third_derivative(double theta, double radius) const {
  const Complex z = std::polar(1.0, 2 * theta);
  Eigen::VectorXd out(static_cast<Eigen::Index>(poles_.size()));
  for (std::size_t n = 0; n < poles_.size(); ++n) {
    double sum = 0;
    for (const Complex place : {shares_[n].place, std::conj(shares_[n].place)}) {
      // The point z moves on the unit circle by twice the angle, and the circle itself keeps 1 − |place| away.
      const double d = std::max(std::abs(z - place) - 2 * radius, 1 - std::abs(place));
      sum += 8 / (d * d) + 48 / (d * d * d) + 48 / (d * d * d * d);
    }
    out[static_cast<Eigen::Index>(n)] = std::abs(shares_[n].k) * sum / (4 * c_ * c_);
  }
  return out;
}

Certificate certify(const WeightedDamping& weighted, const Eigen::MatrixXd& coefficients, Eigen::Index n,
                    double margin) {
  constexpr int most_intervals = 60000, most_open = 50;
  constexpr double narrowest = 1e-7;
  const Eigen::VectorXd size = residue_sizes(weighted.poles(), coefficients);
  struct Interval {
    double from, to;
  };
  std::vector<Interval> left;
  constexpr int start = 64;
  for (int i = start; i-- > 0;) left.push_back({quarter_turn * i / start, quarter_turn * (i + 1) / start});
  Certificate out;
  for (int used = 0; !left.empty(); ++used) {
    const Interval now = left.back();
    left.pop_back();
    const double middle = (now.from + now.to) / 2, h = (now.to - now.from) / 2;
    const Eigen::MatrixXd q = weighted.rows(middle) * coefficients;
    const Eigen::MatrixXd Q = unpacked(q.row(0), n), slope = h * unpacked(q.row(1), n),
                          bend = h * h / 2 * unpacked(q.row(2), n);
    const double rest = weighted.third_derivative(middle, h).dot(size) * h * h * h / 6;
    if (positive(Q - bend, margin + rest) && positive(Q - slope + bend, margin + rest) &&
        positive(Q + slope + bend, margin + rest))
      continue;
    if (used >= most_intervals || h < narrowest || !positive(Q, margin)) {
      out.open.push_back(middle);
      if (out.open.size() >= most_open) return out;
      continue;
    }
    left.push_back({middle, now.to});
    left.push_back({now.from, middle});
  }
  out.passive = out.open.empty();
  return out;
}

namespace {

/// Angles that see every pole: even ones, and each resonance with its flanks.
std::vector<double> angles(const WeightedDamping& weighted) {
  std::vector<double> out;
  constexpr int even = 160;
  for (int i = 0; i <= even; ++i) out.push_back(quarter_turn * i / even);
  for (const Pole& p : weighted.poles())
    for (const double flank : {-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0})
      if (const double omega = p.omega + flank * p.decay; omega > 0)
        out.push_back(std::atan(omega / weighted.centre()));
  std::sort(out.begin(), out.end());
  return out;
}

Eigen::MatrixXd rows_at(const WeightedDamping& weighted, const std::vector<double>& theta) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(theta.size()), columns(weighted.poles()));
  for (std::size_t i = 0; i < theta.size(); ++i) out.row(static_cast<Eigen::Index>(i)) = weighted.rows(theta[i]).row(0);
  return out;
}

/// Smallest eigenvalue of each row's matrix.
Eigen::VectorXd smallest(const Eigen::MatrixXd& Q, Eigen::Index n) {
  Eigen::VectorXd out(Q.rows());
  for (Eigen::Index i = 0; i < Q.rows(); ++i) out[i] = dense::symmetric_eigenvalues(unpacked(Q.row(i), n))[0];
  return out;
}

/// Each row's matrix with eigenvalues below `floor` raised to it; the lowest of each row, `floor` where none is below.
struct Raised {
  Eigen::MatrixXd Q;
  Eigen::VectorXd lowest;
};

Raised raised(Eigen::MatrixXd Q, Eigen::Index n, double floor) {
  Raised out{std::move(Q), {}};
  out.lowest.setConstant(out.Q.rows(), floor);
  for (Eigen::Index i = 0; i < out.Q.rows(); ++i) {
    const Eigen::MatrixXd m = unpacked(out.Q.row(i), n);
    if (positive(m, floor)) continue;
    const auto [values, vectors] = dense::symmetric_eigen(m);
    out.lowest[i] = values[0];
    out.Q.row(i) = packed(vectors * values.cwiseMax(floor).asDiagonal() * vectors.transpose());
  }
  return out;
}

/// On the face of the multipliers `on` that are not zero, towards where all its slacks vanish, as far as they stay
/// positive.
void along_face(const Eigen::MatrixXd& dual, const std::vector<Eigen::Index>& on, Eigen::VectorXd& multiplier,
                Eigen::VectorXd& slack) {
  Eigen::MatrixXd face = dual(on, on);
  face.diagonal() *= 1 + 1e-9;  // rows that repeat each other
  const dense::Cholesky factor(face);
  if (!factor) return;
  const Eigen::VectorXd way = -factor.solve(Eigen::VectorXd(slack(on)));
  const Eigen::ArrayXd at = multiplier(on);
  const double share = std::min(1.0, (way.array() < 0).select(-at / way.array(), 1.0).minCoeff());
  for (std::size_t k = 0; k < on.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double moved = std::max(at[i] + share * way[i], 0.0) - at[i];
    multiplier[on[k]] += moved;
    slack += moved * dual.col(on[k]);
  }
}

/// The smallest x (‖design · x‖ least) with rows · x >= least, by its dual: non-negative multipliers, one at a time,
/// and all that are not zero together once those are the same as before. They are begun from those given, of the first
/// rows, and left there.
Eigen::VectorXd least_lift(const Eigen::MatrixXd& design, const Eigen::MatrixXd& rows, const Eigen::VectorXd& least,
                           Eigen::VectorXd& multiplier) {
  const Eigen::Index n = design.cols();
  Eigen::MatrixXd M = design.transpose() * design;
  M.diagonal().array() += 1e-8 * M.trace() / static_cast<double>(n);
  const Eigen::MatrixXd toward = dense::Cholesky(M).solve(rows.transpose());  // (n, rows)
  const Eigen::MatrixXd dual = rows * toward;
  multiplier.conservativeResizeLike(Eigen::VectorXd::Zero(rows.rows()));
  Eigen::VectorXd slack = dual * multiplier - least;
  std::vector<Eigen::Index> before;
  constexpr int sweeps = 300;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double worst = 0;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const double step = std::max(-multiplier[i], -slack[i] / dual(i, i));
      if (step == 0) continue;
      worst = std::max(worst, std::abs(step) * dual(i, i));
      multiplier[i] += step;
      slack += step * dual.col(i);
    }
    if (worst < 1e-3 * least.cwiseAbs().maxCoeff()) break;
    std::vector<Eigen::Index> on;
    for (Eigen::Index i = 0; i < multiplier.size(); ++i)
      if (multiplier[i] > 0) on.push_back(i);
    if (on == before) along_face(dual, on, multiplier, slack);
    before = std::move(on);
  }
  return toward * multiplier;
}

/// sin² 2θ, by which B is Q.
Eigen::VectorXd share_of_damping(const std::vector<double>& theta) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(theta.size()));
  for (std::size_t i = 0; i < theta.size(); ++i)
    out[static_cast<Eigen::Index>(i)] = std::pow(std::sin(2 * theta[i]), 2);
  return out;
}

/// Data and targets of Q at the angles of `rows`, fitted together: x = fixed + by_target · targets.
struct Targeted {
  Eigen::MatrixXd fixed, by_target;
  Eigen::VectorXd weight;  // of each angle
};

Targeted targeted(const Fitting& fitting, const Eigen::MatrixXd& rows, const Eigen::VectorXd& share) {
  const Eigen::Index data = fitting.design.rows();
  // Weight of each angle: that of B itself, so that the ends, where B is next to nothing, do not lead.
  const Eigen::VectorXd weight =
      3 * std::sqrt(static_cast<double>(data) / 2 / static_cast<double>(rows.rows())) * share.cwiseMax(0.1);
  Eigen::MatrixXd design(data + rows.rows(), fitting.design.cols());
  design << fitting.design, weight.asDiagonal() * rows, Eigen::MatrixXd::Zero(rows.rows(), fitting.extra);
  const Eigen::VectorXd scale = design.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const dense::HouseholderQr qr(design * scale.asDiagonal());
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(design.rows(), fitting.right.cols());
  right.topRows(data) = fitting.right;
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(design.rows(), rows.rows());
  unit.bottomRows(rows.rows()).diagonal() = weight;
  return {scale.asDiagonal() * qr.solve(right), scale.asDiagonal() * qr.solve(unit), weight};
}

/// Whether what Q is short of its margin is nothing, or no more of B than damping on all modes alike may make good.
bool near_enough(const Margins& margins, const Eigen::VectorXd& lowest, const Eigen::VectorXd& share) {
  const Eigen::ArrayXd missing = (margins.kept - lowest.array()).max(0);
  return margins.lifted > 0 ? (missing * share.array()).maxCoeff() <= margins.lifted : missing.maxCoeff() == 0;
}

}  // namespace

Eigen::MatrixXd least_squares(const Eigen::MatrixXd& design, const Eigen::MatrixXd& right) {
  const Eigen::VectorXd scale = design.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  return scale.asDiagonal() * dense::PivotedQr(design * scale.asDiagonal()).solve(right);
}

/// Each turn fits the data and, at every angle, a matrix without negative eigenvalues near that of the
/// fit before; the way so far is continued each time (Nesterov's acceleration), and begun anew where the distance from
/// the targets grows. Turns end where Q is near enough and the data are missed by no less than a turn before, or where
/// Q comes no nearer since the data pull as hard.
Approached approach(const WeightedDamping& weighted, const Eigen::MatrixXd& null, const Fitting& fitting,
                    Eigen::Index n, const Margins& margins) {
  // A turn costs an eigenproblem of n modes at each angle; large arrays get fewer turns and more lift.
  const double size = static_cast<double>(n);
  const int turns = n <= 40 ? 150 : std::max(10, static_cast<int>(150 * 40 * 40 / (size * size)));
  constexpr double beyond = 1.8;    // targets beyond the nearest matrix are reached sooner
  constexpr int once_in = 10;       // turns, in which the distance shall fall
  constexpr double falling = 0.97;  // to this share of it, and what the data are missed by in one turn
  const std::vector<double> theta = angles(weighted);
  const Eigen::MatrixXd rows = rows_at(weighted, theta) * null;
  const Eigen::VectorXd share = share_of_damping(theta);
  const Eigen::Index inner = rows.cols();
  const Targeted fit = targeted(fitting, rows, share);
  const Eigen::MatrixXd to_angles = rows.transpose(), to_data = fitting.design.transpose(),
                        from_targets = fit.by_target.transpose();  // as products of each turn want them
  Approached out;
  Eigen::MatrixXd x = least_squares(fitting.design, fitting.right), point = x;
  double momentum = 1, last = HUGE_VAL, reference = HUGE_VAL, missed_before = HUGE_VAL;
  for (int turn = 0; turn < turns; ++turn) {
    const Eigen::MatrixXd now = transposed_product(to_angles, point.topRows(inner));
    const Raised target = raised(now, n, 2 * margins.kept);
    if (turn == 0) out.most_negative = std::min(0.0, target.lowest.minCoeff());
    const double missed = (transposed_product(to_data, point) - fitting.right).norm();
    const bool near = near_enough(margins, target.lowest, share);
    const bool was_near = std::exchange(out.near, near);
    if (near && was_near && missed > falling * missed_before) break;
    missed_before = missed;
    const double distance = (fit.weight.asDiagonal() * (target.Q - now)).norm();
    if (turn % once_in == 0) {
      if (!near && distance > falling * reference) break;
      reference = distance;
    }
    if (distance > last) momentum = 1;
    last = distance;
    Eigen::MatrixXd next = fit.fixed + transposed_product(from_targets, now + beyond * (target.Q - now));
    const double momentum_next = (1 + std::sqrt(1 + 4 * momentum * momentum)) / 2;
    point = next + (momentum - 1) / momentum_next * (next - x);
    x = std::move(next);
    momentum = momentum_next;
  }
  out.x = std::move(point);
  return out;
}

Covered cover(const WeightedDamping& weighted, const Eigen::MatrixXd& null, const Fitting& fitting, Eigen::Index n,
              double margin, const Eigen::MatrixXd& x) {
  const Eigen::Index inner = null.cols();
  const Eigen::MatrixXd diagonal = packed(Eigen::MatrixXd::Identity(n, n));
  Eigen::MatrixXd rows = rows_at(weighted, angles(weighted)) * null;
  Eigen::VectorXd multiplier;
  Covered out;
  constexpr int rounds = 16;
  for (int round = 0; round < rounds; ++round) {
    const Eigen::VectorXd lowest = smallest(rows * x.topRows(inner), n);
    out.x = x;
    if (round > 0 || lowest.minCoeff() < margin) {
      const Eigen::VectorXd least = (1.5 * margin - lowest.array()).cwiseMax(0);
      const Eigen::VectorXd lifted = least_lift(fitting.design.leftCols(inner), rows, least, multiplier);
      out.x.topRows(inner) += lifted * diagonal;
      out.lift = (rows * lifted).maxCoeff();
    }
    const Certificate certificate = certify(weighted, null * out.x.topRows(inner), n, margin);
    out.passive = certificate.passive;
    if (out.passive) break;
    const Eigen::MatrixXd more = rows_at(weighted, certificate.open) * null;
    rows.conservativeResize(rows.rows() + more.rows(), Eigen::NoChange);
    rows.bottomRows(more.rows()) = more;
  }
  return out;
}

}  // namespace hydro::radiation::detail
