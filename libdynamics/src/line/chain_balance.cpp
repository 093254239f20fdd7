#include "chain_balance.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/machine.hpp"
#include "springs.hpp"
#include "water_points.hpp"

namespace dynamics::line {

using Eigen::Matrix3d;
using Eigen::Vector3d;

ChainBalance::Unfit ChainBalance::unfit(const Line& line) {
  if (line.chains() > 1) return {"lines that meet", "step them with \"generalized_alpha\""};
  if (line.bends()) return {"bending stiffness", "step it with \"generalized_alpha\""};
  if (line.rubs_on_bed()) return {"a bed with friction", "leave friction out, or step it with \"generalized_alpha\""};
  for (const Segment& s : line.description().segments)
    if (s.is_inextensible())
      return {"inextensible segments", "give it an axial stiffness, or step it with \"generalized_alpha\""};
  return {};
}

ChainBalance::ChainBalance(const Line& line)
    : line_(line), loads_(line), eliminations_(static_cast<std::size_t>(line.segments())), matrix_(line.nodes()) {
  forces_ = x_ = v_ = a_ = there_.force = Places::Zero(3, line.nodes());
  there_.law = Eigen::VectorXd::Zero(line.segments());
  any_at_nodes_ = line.has_bobs() || line.has_timed_loads();
  for (int i = 0; i < line.nodes(); ++i) any_at_nodes_ = any_at_nodes_ || !line.node(i).forces.empty();
  for (const Held& h : line.description().held) any_path_ = any_path_ || h.path != nullptr;
  const auto moves = [&](int i) { return line.held(i) != nullptr && line.held(i)->path != nullptr; };
  for (int j = 0; j < line.segments(); ++j)
    if (moves(j) || moves(j + 1)) beside_paths_.push_back(j);
}

FROUDE_INLINE ChainBalance::Bar ChainBalance::bar(int j, const Instant& now) {
  const Triple d = column(now.x, j + 1) - column(now.x, j), w = column(now.v, j + 1) - column(now.v, j);
  const double r = d.norm();
  const Triple t = r > 0 ? 1 / r * d : Triple{0, 0, 0};
  return {t, w, r, t.dot(w)};
}

// (D72), (D88)
FROUDE_INLINE ChainBalance::Law ChainBalance::law(int j, const Bar& bar, const Instant& now, bool derivatives) const {
  const Segment& s = line_.segment(j);
  const double k = s.axial_stiffness / s.length, c = s.axial_damping / s.length, stretch = bar.r - s.length;
  const auto [both, lost] = axial_spring(s, stretch, stretch, 1, bar.rate);
  Law out{.left = (now.T[j] - both.force) / k,
          .by_T = 1 / k,
          .by_length = -both.by_stretch / k,
          .by_rate = -both.by_damper * c / k,
          .lost = lost,
          .sag = {}};
  if (!s.catenary) return out;
  const Span span = span_of(line_, j, now.x, bar.t.z);
  out.sag = derivatives ? sag_of<true>(span, now.T[j]) : sag_of<false>(span, now.T[j]);
  out.left -= out.sag.shortening;
  out.by_T -= out.sag.by_tension;
  return out;
}

// (D75)
ChainBalance::Push ChainBalance::push(int i, const Instant& now) const {
  const Bed& bed = line_.description().bed.front();
  const double depth = bed.z - now.x(2, i), k = bed.stiffness * line_.bed_area(i), c = bed.damping * line_.bed_area(i);
  if (depth <= 0) return {0, 0, 0, 0};
  const auto [both, lost] = damped_one_sided_spring(k, c, depth, depth, -now.v(2, i));
  return {both.force, both.by_stretch, both.by_damper * c, lost};
}

// (D70), (D74)
FROUDE_INLINE void ChainBalance::add_segment(int j, const Instant& now, Balance& out) const {
  const Bar bar = this->bar(j, now);
  const Law law = this->law(j, bar, now, false);
  out.law[j] = law.left;
  const double m = line_.mass_between(j), T = now.T[j];
  Triple first = m * column(now.a, j + 1) - T * bar.t, second = m * column(now.a, j) + T * bar.t;
  first.z -= law.sag.relief[0];
  second.z -= law.sag.relief[1];
  if (loads_.are_wet()) {
    const PerLength& c = loads_.per_length(j);
    const double lift = loads_.lifts_what_is_wet() ? c.lift : 0;
    for (const Stretch& wet : wet_stretches(line_, j, now, loads_.flow())) {
      if (wet.from == wet.to) continue;
      for (const WaterPoint& p : points(line_, j, wet, bar.t, c, now, loads_.flow())) {
        const Triple f = p.length * (drag(c, p) + inertia(p) + Triple{0, 0, lift});
        first = first - (1 - p.s) * f;
        second = second - p.s * f;
      }
    }
  }
  first.add_to(out.force.col(j).data());
  second.add_to(out.force.col(j + 1).data());
}

FROUDE_EVERY_MACHINE void ChainBalance::add_segments(const Instant& now, Balance& out) const {
  for (int j = 0; j < line_.segments(); ++j) add_segment(j, now, out);
}

void ChainBalance::add_nodes(const Instant& now, Balance& out) {
  for (int i = 0; i < line_.nodes(); ++i)
    out.force.col(i) = line_.mass(i) * now.a.col(i) - line_.constant_load().col(i);
  if (!line_.description().bed.empty())
    for (int i = 0; i < line_.nodes(); ++i) out.force(2, i) -= push(i, now).force;
  if (!any_at_nodes_) return;
  forces_.setZero();
  loads_.add_at_nodes(now, {0, 0, 0}, forces_, nullptr);
  out.force -= forces_;
}

void ChainBalance::evaluate(const Instant& now, Balance& out) {
  if (loads_.meet_water()) loads_.look_at_water(now);
  add_nodes(now, out);
  add_segments(now, out);
}

void ChainBalance::linearise(const Instant& now, Balance& out, Powers& powers) {
  evaluate(now, out);
  powers = {};
  for (Blocks* blocks : {&by_place_, &by_velocity_, &by_acceleration_})
    blocks->set_zero(line_.nodes(), line_.segments());
  differentiate_nodes(now, powers);
  differentiate_segments(now, powers);
  for (const Held& h : line_.description().held) powers.held += out.force.col(h.node).dot(now.v.col(h.node));
}

void ChainBalance::differentiate_nodes(const Instant& now, Powers& powers) {
  for (int i = 0; i < line_.nodes(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    add_unit(-line_.mass(i), by_acceleration_.diagonal[node]);
    if (line_.description().bed.empty()) continue;
    const Push p = push(i, now);
    by_place_.diagonal[node](2, 2) -= p.by_depth;
    by_velocity_.diagonal[node](2, 2) -= p.by_rate;
    powers.bed += p.lost;
  }
  if (!any_at_nodes_) return;
  loads_.add_at_nodes(now, {1, 0, 0}, forces_, &by_place_);
  loads_.add_at_nodes(now, {0, 1, 0}, forces_, &by_velocity_);
  loads_.add_at_nodes(now, {0, 0, 1}, forces_, &by_acceleration_);
  loads_.add_powers_at_nodes(now, powers);
}

FROUDE_INLINE void ChainBalance::differentiate_water(int j, const Instant& now, const Bar& bar, Powers& powers) {
  const PerLength& c = loads_.per_length(j);
  Matrix3d follow = Matrix3d::Zero();
  add_unit(-c.added, follow);
  add_outer(c.added, bar.t, bar.t, follow);
  const double lift = loads_.lifts_what_is_wet() ? c.lift : 0;
  for (const Stretch& wet : wet_stretches(line_, j, now, loads_.flow())) {
    if (wet.from == wet.to) continue;
    for (const WaterPoint& p : points(line_, j, wet, bar.t, c, now, loads_.flow())) {
      powers.add(c, p, loads_.lifts_what_is_wet());
      const PointDerivatives d(c, p, bar.r);
      spread(p, j, j, -1, 1, d.by_turning, by_place_);
      spread(p, j, j, p.s - 1, -p.s, d.by_relative, by_velocity_);
      spread(p, j, j, 1 - p.s, p.s, follow, by_acceleration_);
      if (p.by_depth > 0) spread_rise(p, j, j, 1, drag(c, p) + inertia(p) + Triple{0, 0, lift}, by_place_);
    }
  }
}

FROUDE_INLINE void ChainBalance::differentiate_segment(int j, const Instant& now, Powers& powers) {
  const auto at = static_cast<std::size_t>(j);
  const Bar bar = this->bar(j, now);
  const Law law = this->law(j, bar, now, true);
  powers.axial += law.lost;
  Elimination& e = eliminations_[at];
  e.by_T = law.by_T;
  e.by_rate = law.by_rate * bar.t;
  // By the vector from node to node: its length, its direction in the rate of that, and the slope of what sags.
  const double slope = bar.t.z, pull = now.T[j] / bar.r;
  const Triple turned{-slope * bar.t.x, -slope * bar.t.y, 1 - slope * slope};
  const Triple along = law.by_length * bar.t + law.by_rate / bar.r * (bar.w - bar.rate * bar.t) +
                       2 * law.sag.by_level * slope / bar.r * turned;
  Matrix3d across = Matrix3d::Zero();
  add_unit(pull, across);
  add_outer(-pull, bar.t, bar.t, across);
  for (int end = 0; end < 2; ++end) {
    const double sign = end == 0 ? -1 : 1;
    e.column[end] = sign * bar.t - Triple{0, 0, law.sag.relief_by_tension[end]};
    e.by_place[end] = sign * along - Triple{0, 0, law.sag.by_height[end]};
    add(-1, across, by_place_.diagonal[at + static_cast<std::size_t>(end)]);
    by_place_.diagonal[at + static_cast<std::size_t>(end)](2, 2) += law.sag.relief_by_height[end][end];
  }
  add(1, across, by_place_.upper[at]);
  add(1, across, by_place_.lower[at]);
  by_place_.upper[at](2, 2) += law.sag.relief_by_height[0][1];
  by_place_.lower[at](2, 2) += law.sag.relief_by_height[1][0];
  add_unit(-line_.mass_between(j), by_acceleration_.upper[at]);
  add_unit(-line_.mass_between(j), by_acceleration_.lower[at]);
  if (loads_.are_wet()) differentiate_water(j, now, bar, powers);
}

FROUDE_EVERY_MACHINE void ChainBalance::differentiate_segments(const Instant& now, Powers& powers) {
  for (int j = 0; j < line_.segments(); ++j) differentiate_segment(j, now, powers);
}

void ChainBalance::differentiate_by_time(const Instant& now, const Balance& balance, double dt, Balance& out) {
  out.force.setZero();
  out.law.setZero();
  x_ = now.x;
  v_ = now.v;
  a_ = now.a;
  prescribe(now.t + dt, x_, v_, a_);
  if (loads_.flow_changes()) {
    foreseen_ = now.x + dt * now.v;
    evaluate({{now.t + dt, x_, v_, a_, &foreseen_}, now.T}, there_);
    out.force = (there_.force - balance.force) / dt;
    out.law = (there_.law - balance.law) / dt;
    return;
  }
  for (const double sign : {1.0, -1.0}) {
    there_.force.setZero();
    const Instant then = sign > 0 ? Instant{{now.t + dt, x_, v_, a_}, now.T} : now;
    for (const int j : beside_paths_) {
      add_segment(j, then, there_);
      out.law[j] += sign / dt * there_.law[j];
    }
    if (line_.has_timed_loads()) {
      forces_.setZero();
      loads_.add_timed_loads(then.t, forces_);
      there_.force -= forces_;
    }
    out.force += sign / dt * there_.force;
  }
}

FROUDE_EVERY_MACHINE void ChainBalance::add_up(double by) {
  const auto sum = [&](const std::vector<Matrix3d> Blocks::*member, std::size_t at, Matrix3d& out) {
    const Matrix3d &x = (by_place_.*member)[at], &v = (by_velocity_.*member)[at], &a = (by_acceleration_.*member)[at];
    for (int e = 0; e < 9; ++e) out.data()[e] = -x.data()[e] - by * (v.data()[e] + by * a.data()[e]);
  };
  for (int i = 0; i < line_.nodes(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    sum(&Blocks::diagonal, at, matrix_[i].diagonal);
    if (i == line_.segments()) break;
    sum(&Blocks::upper, at, matrix_[i].upper);
    sum(&Blocks::lower, at, matrix_[i].lower);
  }
  for (int j = 0; j < line_.segments(); ++j) {
    Elimination& e = eliminations_[static_cast<std::size_t>(j)];
    e.row[0] = e.by_place[0] - by * e.by_rate;
    e.row[1] = e.by_place[1] + by * e.by_rate;
    const double share = -1 / e.by_T;
    add_outer(share, e.column[0], e.row[0], matrix_[j].diagonal);
    add_outer(share, e.column[0], e.row[1], matrix_[j].upper);
    add_outer(share, e.column[1], e.row[0], matrix_[j].lower);
    add_outer(share, e.column[1], e.row[1], matrix_[j + 1].diagonal);
  }
}

bool ChainBalance::factorise(double by) {
  add_up(by);
  for (const Held& h : line_.description().held) {
    matrix_[h.node].diagonal.setIdentity();
    matrix_[h.node].upper.setZero();
    if (h.node > 0) matrix_[h.node - 1].lower.setZero();
  }
  return matrix_.factorise();
}

FROUDE_EVERY_MACHINE void ChainBalance::add_rates(const Eigen::Ref<const Places>& v, const Eigen::Ref<const Places>& a,
                                                  Balance& out) const {
  for (int i = 0; i < line_.nodes(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    Triple own = times(by_velocity_.diagonal[at], column(v, i)) + times(by_acceleration_.diagonal[at], column(a, i));
    if (i < line_.segments()) {
      own = own + times(by_velocity_.upper[at], column(v, i + 1)) + times(by_acceleration_.upper[at], column(a, i + 1));
      const Triple next = times(by_velocity_.lower[at], column(v, i)) + times(by_acceleration_.lower[at], column(a, i));
      (-next).add_to(out.force.col(i + 1).data());
      out.law[i] += eliminations_[at].by_rate.dot(column(v, i + 1) - column(v, i));
    }
    (-own).add_to(out.force.col(i).data());
  }
}

void ChainBalance::solve(Balance& right, Eigen::Ref<Places> x, Eigen::Ref<Eigen::VectorXd> T) const {
  for (int j = 0; j < line_.segments(); ++j) {
    const Elimination& e = eliminations_[static_cast<std::size_t>(j)];
    const double share = -right.law[j] / e.by_T;
    (share * e.column[0]).add_to(right.force.col(j).data());
    (share * e.column[1]).add_to(right.force.col(j + 1).data());
  }
  x = right.force;
  for (const Held& h : line_.description().held) x.col(h.node).setZero();
  matrix_.solve(x);
  for (int j = 0; j < line_.segments(); ++j) {
    const Elimination& e = eliminations_[static_cast<std::size_t>(j)];
    T[j] = (right.law[j] - e.row[0].dot(column(x, j)) - e.row[1].dot(column(x, j + 1))) / e.by_T;
  }
}

void ChainBalance::prescribe(double t, Eigen::Ref<Places> x, Eigen::Ref<Places> v, Eigen::Ref<Places> a) const {
  for (const Held& h : line_.description().held) {
    if (!h.path) continue;
    const Path::Place p = h.path->at(t);
    x.col(h.node) = p.position;
    v.col(h.node) = p.velocity;
    a.col(h.node) = p.acceleration;
  }
}

}  // namespace dynamics::line
