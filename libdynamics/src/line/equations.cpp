#include "equations.hpp"

#include <fmt/format.h>

#include <cmath>

#include "springs.hpp"

namespace dynamics::line {
namespace {
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
}  // namespace

void set_instant(const State& state, const Places& a, const Stage* flow_of, Stage& out) {
  out.t = out.end = state.time;
  out.h = out.x_by = out.v_by = 0;
  out.a_by = 1;
  out.v_from = state.velocity;
  out.a_from = a;
  out.mean = out.still = false;
  out.foreseen = flow_of != nullptr && flow_of->foreseen;
  if (out.foreseen) out.water_at = flow_of->water_at;
}

Equations::Equations(const Line& line)
    : line_(line),
      loads_(line),
      matrix_(4 * line.nodes(), line.bends() ? Reach::next_neighbours : Reach::neighbours),
      rhs_(4 * line.nodes()),
      law_(line.segments()),
      by_{Places(3, line.nodes()), VectorXd(line.segments())},
      from_(by_),
      follow_{.here = {}, .end = {}, .by = {}, .y = {}, .matrix = matrix_, .of_rest = {}, .total = {}} {
  blocks_.set_zero(line.nodes(), line.segments());
  x_ = v_ = a_ = force_ = residual_ = none_ = whole_ = Places::Zero(3, line.nodes());
  for (int j = 0; j < line.segments(); ++j) {
    any_inextensible_ = any_inextensible_ || line.segment(j).is_inextensible();
    any_catenary_ = any_catenary_ || line.segment(j).catenary;
  }
  push_.resize(static_cast<std::size_t>(line.nodes()));
  sag_.resize(static_cast<std::size_t>(line.segments()));
  if (line.is_network()) network_ = std::make_unique<NetworkSolver>(line);
}

void Equations::move(const Stage& stage, const State& before, const Places& u) {
  x_ = before.position + stage.x_by * u;
  v_ = stage.v_from + stage.v_by * u;
  a_ = stage.a_from + stage.a_by * u;
  if (stage.still) return;
  for (const Held& h : line_.description().held) {
    const Path::Place end =
        h.path ? h.path->at(stage.end) : Path::Place{before.position.col(h.node), Vector3d::Zero(), Vector3d::Zero()};
    v_.col(h.node) = stage.mean ? (u.col(h.node) / stage.h).eval() : end.velocity;
    a_.col(h.node) = stage.mean ? ((end.velocity - before.velocity.col(h.node)) / stage.h).eval() : end.acceleration;
  }
}

// (D72), (D79)
Equations::Pull Equations::pull(int j, const Stage& stage, const State& before, double T) const {
  const Segment& s = line_.segment(j);
  const int i = line_.first(j);
  const Vector3d d0 = before.position.col(i + 1) - before.position.col(i);
  Vector3d d1 = x_.col(i + 1) - x_.col(i);
  if (stage.mean) d1 = 2 * d1 - d0;  // x_ is in the middle of the step
  const double r1 = d1.norm(), r0 = stage.mean ? d0.norm() : r1;
  const Vector3d t1 = r1 > 0 ? Vector3d(d1 / r1) : Vector3d::Zero();
  const double middle = (r0 + r1) / 2;
  const double own = stage.mean ? 0.5 : 1;  // of both ends of the step, the share of this one
  Pull p;
  p.direction = stage.mean && middle > 0 ? Vector3d((d0 + d1) / (2 * middle)) : t1;
  p.direction_by.setZero();
  if (middle > 0) p.direction_by = own * (Matrix3d::Identity() - p.direction * t1.transpose()) / middle;
  const Vector3d w = v_.col(i + 1) - v_.col(i);
  const bool at_once = stage.x_by == 0;
  if (s.is_inextensible()) {
    p.law = r1 - s.length;
    if (at_once)  // (D77): t·ẅ + |w across t|²/ℓ = 0
      p.law = t1.dot(a_.col(i + 1) - a_.col(i)) + (w - t1 * t1.dot(w)).squaredNorm() / r1;
    p.law_by = t1;
    p.law_by_T = 0;
    return p;
  }
  const double k = s.axial_stiffness / s.length, c = s.axial_damping / s.length;
  const double rate = stage.mean ? (r1 - r0) / stage.h : t1.dot(w);
  const Vector3d rate_by =
      stage.mean ? Vector3d(t1 / stage.h) : Vector3d(stage.v_by * t1 + (r1 > 0 ? (w - t1 * t1.dot(w)) / r1 : w));
  const auto [both, lost] = axial_spring(s, r0 - s.length, r1 - s.length, own, rate);
  p.lost = lost;
  p.law = (T - both.force) / k;
  p.law_by_T = 1 / k;
  p.law_by = -(both.by_stretch * t1 + both.by_damper * c * rate_by) / k;
  if (at_once) p.law_by.setZero();
  if (s.catenary) sag(j, T, p);
  return p;
}

void Equations::add_block(int row, int column, const Matrix3d& block) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) matrix_(place_index(row) + r, place_index(column) + c) += block(r, c);
}

// The columns of T_j, in units of the matrix's own scale.
void Equations::set_pull(int j, const Vector3d& direction) {
  const int row = place_index(line_.first(j)), column = tension_index(j);
  for (int r = 0; r < 3; ++r) {
    matrix_(row + r, column) = -scale_ * direction[r];
    matrix_(row + 4 + r, column) = scale_ * direction[r];
  }
}

/// Masses and the derivative of loads in blocks_.
void Equations::fill(double mass_by, double relax) {
  matrix_.set_zero();
  for (int i = 0; i < line_.nodes(); ++i)
    add_block(i, i,
              (mass_by * line_.mass(i) + relax) * Matrix3d::Identity() - blocks_.diagonal[static_cast<std::size_t>(i)]);
  for (int j = 0; j < line_.segments(); ++j) {
    const int i = line_.first(j);
    const Matrix3d joined = mass_by * line_.mass_between(j) * Matrix3d::Identity();
    add_block(i, i + 1, joined - blocks_.upper[static_cast<std::size_t>(j)]);
    add_block(i + 1, i, joined - blocks_.lower[static_cast<std::size_t>(j)]);
  }
}

// M a, not of nodes that relax.
void Equations::add_mass(const Places& a) {
  for (int i = 0; i < line_.nodes(); ++i) residual_.col(i) += line_.mass(i) * a.col(i);
  for (int j = 0; j < line_.segments(); ++j) {
    const int i = line_.first(j);
    residual_.col(i) += line_.mass_between(j) * a.col(i + 1);
    residual_.col(i + 1) += line_.mass_between(j) * a.col(i);
  }
}

// (D75), (D79)
Equations::Push Equations::bed(int i, const Stage& stage, const State& before) const {
  const Bed& bed = line_.description().bed.front();
  const double k = bed.stiffness * line_.bed_area(i), c = bed.damping * line_.bed_area(i);
  const double z0 = before.position(2, i), z1 = stage.mean ? 2 * x_(2, i) - z0 : x_(2, i);
  const double depth1 = bed.z - z1, depth0 = stage.mean ? bed.z - z0 : depth1;
  const double rate = stage.mean ? (z0 - z1) / stage.h : -v_(2, i);
  const auto [both, lost] = damped_one_sided_spring(k, c, depth0, depth1, rate);
  double by_end = both.by_stretch + both.by_damper * c * (stage.mean ? 1 / stage.h : stage.v_by);
  if (stage.x_by == 0) by_end = 0;
  return {both.force, by_end, lost};
}

void Equations::add_bed(const Stage& stage, const State& before, bool matrix) {
  if (line_.description().bed.empty()) return;
  for (int i = 0; i < line_.nodes(); ++i) {
    const Push& push = push_[static_cast<std::size_t>(i)] = bed(i, stage, before);
    residual_(2, i) -= push.force;
    if (matrix) matrix_(place_index(i) + 2, place_index(i) + 2) += push.by_end;
  }
}

void Equations::add_pulls(const Stage& stage, const State& before, const VectorXd& T, bool matrix) {
  for (int j = 0; j < line_.segments(); ++j) {
    const Pull p = pull(j, stage, before, T[j]);
    const int first = line_.first(j), second = first + 1;
    residual_.col(first) -= T[j] * p.direction;
    residual_.col(second) += T[j] * p.direction;
    law_[j] = p.law;
    sag_[static_cast<std::size_t>(j)] = p.sag;
    for (int i = 0; i < 2; ++i) residual_(2, first + i) -= p.sag.relief[i];
    if (!matrix) continue;
    const Matrix3d stiffness = stage.x_by == 0 ? Matrix3d::Zero() : Matrix3d(T[j] * p.direction_by);
    add_block(first, first, stiffness);
    add_block(second, second, stiffness);
    add_block(first, second, -stiffness);
    add_block(second, first, -stiffness);
    set_pull(j, p.direction);
    for (int c = 0; c < 3; ++c) {
      matrix_(tension_index(j), place_index(first) + c) = -scale_ * p.law_by[c];
      matrix_(tension_index(j), place_index(second) + c) = scale_ * p.law_by[c];
    }
    // Of a length that others keep already (both ends of a straight line held) the tension is undetermined: a share of
    // 1e-13 of its change chooses the least, and changes nothing where it is determined.
    matrix_(tension_index(j), tension_index(j)) =
        line_.segment(j).is_inextensible() ? -undetermined * scale_ : scale_ * scale_ * p.law_by_T;
    if (line_.segment(j).catenary) add_sag_derivatives(j, p, stage);
  }
}

Motion Equations::motion(const Stage& stage) const {
  return {stage.t, x_, v_, a_, stage.foreseen ? &stage.water_at : nullptr};
}

/// Residual, law, and the matrix of their derivatives; returns their size, m.
double Equations::assemble(const Stage& stage, const State& before, const Places& u, const VectorXd& T, bool matrix) {
  move(stage, before, u);
  force_.setZero();
  if (matrix) blocks_.set_zero(line_.nodes(), line_.segments());
  loads_.add(motion(stage), {stage.x_by, stage.v_by, stage.a_by}, force_, matrix ? &blocks_ : nullptr);
  residual_ = -force_ + stage.relax * u;
  if (!stage.still) add_mass(a_);
  if (matrix) fill(stage.still ? 0 : stage.a_by, stage.relax);
  add_bed(stage, before, matrix);
  add_bending(stage, matrix);
  add_pulls(stage, before, T, matrix);
  if (line_.rubs_on_bed() && !stage.still) add_friction(stage, before, matrix);
  add_up_ties();
  double sum = law_.squaredNorm();
  for (int i = 0; i < line_.nodes(); ++i)
    if (line_.held(i) == nullptr) sum += residual_.col(i).squaredNorm() / (scale_ * scale_);
  return std::sqrt(sum);
}

/// What is left over at nodes that are one place is that of the first; of the others nothing. (D110)
void Equations::add_up_ties() {
  for (const auto& tie : line_.description().ties)
    for (std::size_t k = 1; k < tie.size(); ++k) {
      residual_.col(tie.front()) += residual_.col(tie[k]);
      residual_.col(tie[k]).setZero();
    }
}

/// Rows of held nodes, which keep what they have, and of the tension that there is not before the first node of a
/// chain.
void Equations::keep_held() {
  for (int c = 0; c < line_.chains(); ++c) {
    const int none = 4 * line_.first_of_chain(c);
    matrix_(none, none) = 1;
  }
  const int last = static_cast<int>(rhs_.size()) - 1;
  for (const Held& h : line_.description().held)
    for (int r = place_index(h.node); r < place_index(h.node) + 3; ++r) {
      for (int c = std::max(0, r - matrix_.half()); c <= std::min(last, r + matrix_.half()); ++c) matrix_(r, c) = 0;
      matrix_(r, r) = scale_;
    }
}

/// Held nodes keep what they have; then solves for the corrections.
bool Equations::solve_linear(Places& du, VectorXd& dT) {
  for (int c = 0; c < line_.chains(); ++c) rhs_[4 * line_.first_of_chain(c)] = 0;
  for (int j = 0; j < line_.segments(); ++j)
    rhs_[tension_index(j)] = std::abs(law_[j]) > met_ || !line_.segment(j).is_inextensible() ? -scale_ * law_[j] : 0;
  for (int i = 0; i < line_.nodes(); ++i) {
    rhs_.segment<3>(place_index(i)) = -residual_.col(i);
    if (line_.held(i) != nullptr) rhs_.segment<3>(place_index(i)).setZero();
  }
  keep_held();
  if (!(network_ ? network_->solve(matrix_, rhs_) : matrix_.solve(rhs_))) return false;
  for (int j = 0; j < line_.segments(); ++j) dT[j] = scale_ * rhs_[tension_index(j)];
  for (int i = 0; i < line_.nodes(); ++i) du.col(i) = rhs_.segment<3>(place_index(i));
  return du.allFinite() && dT.allFinite();
}

void Equations::scale_for(const Stage& stage, const VectorXd& T) {
  scale_ = std::max(stage.relax, 1e-300);
  for (int i = 0; i < line_.nodes(); ++i) scale_ = std::max(scale_, line_.mass(i) * std::abs(stage.a_by));
  for (int j = 0; j < line_.segments(); ++j) scale_ = std::max(scale_, std::abs(T[j]) / line_.segment(j).length);
  scale_ = std::max(scale_, line_.hardest_bending());
}

/// As much of the correction, added to `from_`, as brings what is left over down, halved up to twelve times; its size
/// is returned. After the last one nobody needs the matrix.
double Equations::search(const Stage& stage, const State& before, double size, bool enough, bool last, Places& u,
                         VectorXd& T) {
  constexpr int halvings = 12;
  double share = 1, left = 0;
  for (int cut = 0; cut < halvings; ++cut, share /= 2) {
    u = from_.u + share * by_.u;
    T = from_.T + share * by_.T;
    left = assemble(stage, before, u, T, !last);
    if (left <= (1 - 1e-4 * share) * size || enough) break;
  }
  return left;
}

int Equations::worst_node() const {
  int worst = 0;
  double largest = -1;
  for (int i = 0; i < line_.nodes(); ++i)
    if (line_.held(i) == nullptr && !(residual_.col(i).norm() <= largest)) {
      largest = residual_.col(i).norm();
      worst = i;
    }
  return worst;
}

Equations::Outcome Equations::solve(Stage& stage, const State& before, double tolerance, int most, Places& u,
                                    VectorXd& T) {
  for (const Held& h : line_.description().held) {
    u.col(h.node) = h.path ? (h.path->at(stage.end).position - before.position.col(h.node)).eval() : Vector3d::Zero();
    if (stage.foreseen) stage.water_at.col(h.node) = before.position.col(h.node) + stage.x_by * u.col(h.node);
  }
  const Outcome out = newton(stage, before, tolerance, most, u, T);
  if (!out.converged || !stage.foreseen) return out;
  x_ = before.position + stage.x_by * u;
  if (!loads_.flow_differs(x_)) return out;
  stage.water_at = x_;
  Outcome again = newton(stage, before, tolerance, most, u, T);
  again.iterations += out.iterations;
  return again;
}

/// What doubles can tell of balance, relative to places. At rest on a bed that is hard beside all pulls, no more than
/// what its force changes by with the last digit of a place.
double Equations::told(const Stage& stage) const {
  double stiffness = scale_;
  if (stage.still && !line_.description().bed.empty())
    for (int i = 0; i < line_.nodes(); ++i)
      stiffness = std::max(stiffness, line_.description().bed.front().stiffness * line_.bed_area(i));
  return 4e-16 * stiffness / scale_;
}

Equations::Outcome Equations::newton(const Stage& stage, const State& before, double tolerance, int most, Places& u,
                                     VectorXd& T) {
  scale_for(stage, T);
  const double extent = before.position.cwiseAbs().maxCoeff(), rounding = stage.rounding * extent;
  const double balanced = told(stage) * extent * std::sqrt(static_cast<double>(rhs_.size()));
  // At rest a straight line between two places has a length that nothing can change: its rounding asks for no tension.
  met_ = stage.still ? 4e-16 * extent : 0;
  Outcome out;
  double step_before = 0, pull_before = 0;
  out.size = assemble(stage, before, u, T, true);
  for (out.iterations = 1; out.iterations <= most; ++out.iterations) {
    if (!std::isfinite(out.size) || !solve_linear(by_.u, by_.T)) {
      out.why = "its equations are singular or not finite";
      break;
    }
    from_.u = u;
    from_.T = T;
    const double step = by_.u.cwiseAbs().maxCoeff(), pull = by_.T.cwiseAbs().maxCoeff();
    // Newton contracts ever faster, so the correction that is left out is at most this share of this one. Means over a
    // step go on to the last digits, which keep the energy. (D78)
    const bool foresees = out.iterations > 1 && !stage.mean;
    const double contraction = foresees ? std::min(1.0, std::max(step / step_before, pull / pull_before)) : 1;
    step_before = step;
    pull_before = pull;
    const bool small = contraction * step <= std::max(tolerance * u.cwiseAbs().maxCoeff(), rounding) &&
                       contraction * pull <= std::max(tolerance * T.cwiseAbs().maxCoeff(), scale_ * step);
    const double size = search(stage, before, out.size, step <= rounding, small, u, T);
    const bool falls = size <= out.size;
    if (!falls && (out.size <= balanced || !small)) {
      u = from_.u;
      T = from_.T;
      out.converged = out.size <= balanced;
      if (!out.converged) out.why = "no part of Newton's correction brings it nearer to balance";
      break;
    }
    out.size = size;
    if ((out.converged = small)) break;
  }
  needed_ = residual_;
  if (!out.converged && out.why.empty()) out.why = fmt::format("Newton did not converge in {} iterations", most);
  if (!out.converged) out.worst = worst_node();
  return out;
}

}  // namespace dynamics::line
