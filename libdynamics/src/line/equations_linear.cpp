/// What of a line's equations is linear: accelerations, projections; and the powers and energies of its parts.
#include <algorithm>
#include <cmath>

#include "equations.hpp"

namespace dynamics::line {

using Eigen::Vector3d;
using Eigen::VectorXd;

void Equations::scale_by_mass() {
  scale_ = 1e-300;
  for (int i = 0; i < line_.nodes(); ++i) scale_ = std::max(scale_, line_.mass(i));
}

bool Equations::accelerations(const State& state, Places& a, VectorXd& T, const Stage* flow_of) {
  scale_by_mass();
  a.setZero(3, line_.nodes());
  T.setZero(line_.segments());
  set_instant(state, a, flow_of, instant_);
  move(instant_, state, a);
  for (int j = 0; j < line_.segments(); ++j)
    if (line_.segment(j).catenary) T[j] = tension_of_sag(j, instant_, state);
  assemble(instant_, state, a, T, true);
  if (!solve_linear(a, by_.T)) return false;
  T += by_.T;
  a += a_;  // of nodes along paths
  return true;
}

void Equations::find_holding(const State& state, const Places& a, const VectorXd& T, Places& out,
                             const Stage* flow_of) {
  set_instant(state, a, flow_of, instant_);
  assemble(instant_, state, none_, T, false);
  out.setZero(3, line_.nodes());
  for (const Held& h : line_.description().held) out.col(h.node) = residual_.col(h.node);
}

/// M δ + Gᵀ μ = 0 and G δ = −law_ in the matrix, G the lengths that are kept, along `along`, and their derivative at x.
void Equations::assemble_projection(const Places& along, const Places& x) {
  scale_by_mass();
  blocks_.set_zero(line_.nodes(), line_.segments());
  residual_.setZero();
  fill(1, 0);
  for (int j = 0; j < line_.segments(); ++j) {
    if (!line_.segment(j).is_inextensible()) {
      matrix_(tension_index(j), tension_index(j)) = 1;
      law_[j] = 0;
      continue;
    }
    matrix_(tension_index(j), tension_index(j)) = -undetermined * scale_;
    const int i = line_.first(j);
    set_pull(j, (along.col(i + 1) - along.col(i)).normalized());
    const Vector3d t = (x.col(i + 1) - x.col(i)).normalized();
    for (int c = 0; c < 3; ++c) {
      matrix_(tension_index(j), place_index(i) + c) = -scale_ * t[c];
      matrix_(tension_index(j), place_index(i + 1) + c) = scale_ * t[c];
    }
  }
}

bool Equations::project_velocity(const State& state, Places& v) {
  if (!any_inextensible_) return true;
  assemble_projection(state.position, state.position);
  for (int j = 0; j < line_.segments(); ++j)
    if (line_.segment(j).is_inextensible()) law_[j] = along(state.position, j).normalized().dot(along(v, j));
  if (!solve_linear(by_.u, by_.T)) return false;
  v += by_.u;
  return true;
}

bool Equations::project_place(const Places& from, double tolerance, Places& x) {
  constexpr int most = 50;
  for (int i = 0; i < most; ++i) {
    assemble_projection(from, x);
    for (int j = 0; j < line_.segments(); ++j)
      if (line_.segment(j).is_inextensible()) law_[j] = along(x, j).norm() - line_.segment(j).length;
    const double open = law_.cwiseAbs().maxCoeff();
    if (!solve_linear(by_.u, by_.T)) return false;
    x += by_.u;
    if (open <= tolerance) return true;
  }
  return false;
}

Powers Equations::powers(const Stage& stage, const State& before, const Places& u, const VectorXd& T) {
  assemble(stage, before, u, T, false);
  Powers out{loads_.powers(motion(stage))};
  for (int j = 0; j < line_.segments(); ++j) out.axial += pull(j, stage, before, T[j]).lost;
  if (!line_.description().bed.empty())
    for (int i = 0; i < line_.nodes(); ++i) out.bed += bed(i, stage, before).lost;
  if (line_.rubs_on_bed()) out.friction = -friction_.cwiseProduct(v_.topRows<2>()).sum();
  // What holds a node gives its force times the way; but of the force on the masses, times the mean of the velocities,
  // as their kinetic energy has it.
  whole_ = residual_;
  residual_.setZero();
  add_mass(a_);
  for (const Held& h : line_.description().held) {
    const Vector3d inertia = residual_.col(h.node), rest = whole_.col(h.node) - inertia, v = v_.col(h.node);
    const Vector3d mean = stage.mean ? Vector3d(before.velocity.col(h.node) + stage.h / 2 * a_.col(h.node)) : v;
    out.held += inertia.dot(mean) + rest.dot(v);
  }
  return out;
}

double Equations::kinetic(const Places& v) const {
  double sum = 0;
  for (int i = 0; i < line_.nodes(); ++i) sum += line_.mass(i) / 2 * v.col(i).squaredNorm();
  for (int j = 0; j < line_.segments(); ++j)
    sum += line_.mass_between(j) * v.col(line_.first(j)).dot(v.col(line_.first(j) + 1));
  return sum;
}

double Equations::stored_in_segments(const State& state) {
  double sum = 0;
  if (any_catenary_) {
    still_ = state;
    still_.velocity.setZero();
    set_instant(still_, none_, nullptr, instant_);
    move(instant_, still_, none_);
  }
  for (int j = 0; j < line_.segments(); ++j) {
    const Segment& s = line_.segment(j);
    if (s.is_inextensible()) continue;
    if (s.catenary) {
      const double T = tension_of_sag(j, instant_, still_), r = along(x_, j).norm();
      sum += T * (r - s.length) - T * T * s.length / (2 * s.axial_stiffness) + pull(j, instant_, still_, T).sag.stored;
      continue;
    }
    double stretch = along(state.position, j).norm() - s.length;
    if (s.tension_only) stretch = std::max(stretch, 0.0);
    sum += s.axial_stiffness / s.length / 2 * stretch * stretch;
  }
  return sum;
}

double Equations::stored_in_bed(const State& state) const {
  double sum = 0;
  for (const Bed& bed : line_.description().bed)
    for (int i = 0; i < line_.nodes(); ++i) {
      const double depth = std::max(bed.z - state.position(2, i), 0.0);
      sum += bed.stiffness * line_.bed_area(i) / 2 * depth * depth;
    }
  return sum;
}

}  // namespace dynamics::line
