#include "dynamics/line/line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hydro/base/error.hpp"

namespace dynamics::line {
namespace {

using hydro::require;

void check(const Segment& s, std::size_t j) {
  require(std::isfinite(s.length) && s.length > 0, "segment {} must have a length above 0, got {} m", j + 1, s.length);
  require(std::isfinite(s.mass) && s.mass >= 0, "segment {} must not have the mass {} kg", j + 1, s.mass);
  require(std::isfinite(s.inertia) && s.inertia >= 0, "segment {} must not have the inertia {} kg m^2", j + 1,
          s.inertia);
  require(s.centre >= 0 && s.centre <= 1, "the centre of segment {} must lie between its ends, got the share {}", j + 1,
          s.centre);
  require(s.axial_stiffness > 0, "segment {} needs an axial stiffness above 0, got {} N", j + 1, s.axial_stiffness);
  require(std::isfinite(s.axial_damping) && s.axial_damping >= 0, "segment {} must not have the axial damping {} N s",
          j + 1, s.axial_damping);
  require(!(s.pulls_only && s.keeps_length()),
          "segment {} keeps its length, so it cannot go slack: give it an axial stiffness", j + 1);
  require(!(s.sags && (s.keeps_length() || s.pulls_only)),
          "segment {} sags, so it needs an axial stiffness and never goes slack: leave pulls_only out", j + 1);
  require(!(s.axial_damping > 0 && s.keeps_length()), "segment {} keeps its length, so its axial damping cannot act",
          j + 1);
  require(std::isfinite(s.bending_stiffness) && s.bending_stiffness >= 0,
          "segment {} must not have the bending stiffness {} N m^2", j + 1, s.bending_stiffness);
  require(!(s.sags && s.bending_stiffness > 0), "segment {} sags, so it has no straight axis that bends", j + 1);
  require(s.diameter >= 0 && s.cd >= 0 && s.cd_tangential >= 0 && s.ca >= 0,
          "diameter and coefficients of segment {} must not be negative", j + 1);
}

void check(const Node& n, std::size_t i) {
  require(std::isfinite(n.mass) && n.mass >= 0, "node {} must not have the mass {} kg", i, n.mass);
  require(n.damping >= 0 && n.quadratic_damping >= 0, "the damping of node {} must not be negative", i);
  require(n.force.allFinite(), "the force on node {} is not finite", i);
}

/// Weight of the water that a segment displaces, N.
double buoyancy(const Segment& s, const hydro::waves::WaveField& water) {
  return water.water().density * water.water().gravity * std::numbers::pi / 4 * s.diameter * s.diameter * s.length;
}

}  // namespace

Segment Segment::rod(double length, double mass) {
  return {.length = length, .mass = mass, .inertia = mass * length * length / 12};
}

Segment Segment::bobs(double length, double mass) {
  return {.length = length, .mass = mass, .inertia = mass * length * length / 4};
}

Line::Line(Description description) : d_(std::move(description)) {
  require(d_.nodes.size() == d_.segments.size() + 1 && !d_.segments.empty(),
          "a line of {} segments has {} nodes, not {}", d_.segments.size(), d_.segments.size() + 1, d_.nodes.size());
  require(d_.bed.size() <= 1, "a line lies on one bed, not on {}", d_.bed.size());
  for (const Bed& bed : d_.bed)
    require(std::isfinite(bed.friction) && bed.friction >= 0, "the bed must not have the friction {}", bed.friction);
  require(d_.water.wet == Wet::nothing || d_.water.field != nullptr, "a line that is wet needs water");
  const bool always_lifted = d_.water.wet == Wet::all && d_.water.buoyancy;
  const Eigen::Index n = nodes();
  diagonal_ = bed_area_ = Eigen::VectorXd::Zero(n);
  between_ = sag_weight_ = Eigen::VectorXd::Zero(n - 1);
  constant_ = Places::Zero(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Node& node = d_.nodes[static_cast<std::size_t>(i)];
    check(node, static_cast<std::size_t>(i));
    diagonal_[i] = node.mass;
    constant_.col(i) = node.force;
    constant_(2, i) -= node.mass * d_.gravity;
  }
  for (Eigen::Index j = 0; j + 1 < n; ++j) {
    const Segment& s = d_.segments[static_cast<std::size_t>(j)];
    check(s, static_cast<std::size_t>(j));
    // (D71): ∫(1 − s)² dm, ∫s(1 − s) dm, ∫s² dm of the rod.
    const double second = s.inertia / (s.length * s.length) + s.mass * s.centre * s.centre;
    between_[j] = s.mass * s.centre - second;
    diagonal_[j] += s.mass - s.mass * s.centre - between_[j];
    diagonal_[j + 1] += second;
    constant_(2, j) -= s.mass * d_.gravity * (1 - s.centre);
    constant_(2, j + 1) -= s.mass * d_.gravity * s.centre;
    const double lift = always_lifted ? buoyancy(s, *d_.water.field) : 0;
    sag_weight_[j] = (s.mass * d_.gravity - lift) / s.length;
    require(!s.sags || d_.water.wet != Wet::below_surface,
            "segment {} sags by its weight in water, which a line that is wet in part does not have", j + 1);
    require(!s.sags || sag_weight_[j] > 0, "segment {} sags, but it weighs {} N/m in water", j + 1, sag_weight_[j]);
    for (const Eigen::Index i : {j, j + 1}) {
      constant_(2, i) += lift / 2;
      bed_area_[i] += s.diameter * s.length / 2;
    }
  }
  find_held();
  find_bending();
}

// (D106), (D107)
void Line::find_bending() {
  bending_ = Eigen::VectorXd::Zero(nodes());
  for (int i = 1; i < segments(); ++i) {
    const Segment &a = segment(i - 1), &b = segment(i);
    if (a.bending_stiffness > 0 && b.bending_stiffness > 0)
      bending_[i] = 2 / (a.length / a.bending_stiffness + b.length / b.bending_stiffness);
  }
  for (const Held& h : d_.held) {
    if (h.clamp.isZero(0)) continue;
    require(h.node == 0 || h.node == segments(), "node {} is clamped, but is no end of the line", h.node);
    require(std::abs(h.clamp.norm() - 1) < 1e-9, "node {} is clamped in a direction that is not of length 1", h.node);
    const Segment& s = segment(h.node == 0 ? 0 : h.node - 1);
    require(s.bending_stiffness > 0, "node {} is clamped, but its segment has no bending stiffness", h.node);
    bending_[h.node] = 2 * s.bending_stiffness / s.length;
  }
  for (int j = 0; j < segments(); ++j)
    hardest_bending_ =
        std::max(hardest_bending_, std::max(bending_[j], bending_[j + 1]) / (segment(j).length * segment(j).length));
}

void Line::find_held() {
  held_.assign(d_.nodes.size(), -1);
  for (std::size_t k = 0; k < d_.held.size(); ++k) {
    const int node = d_.held[k].node;
    require(node >= 0 && node < nodes(), "a line of {} nodes has no node {}", nodes(), node);
    require(held(node) == nullptr, "node {} is held twice", node);
    held_[static_cast<std::size_t>(node)] = static_cast<int>(k);
  }
}

bool Line::has_massless_nodes() const {
  for (int i = 0; i < nodes(); ++i)
    if (mass(i) == 0 && held(i) == nullptr) return true;
  return false;
}

double Line::length() const {
  double sum = 0;
  for (const Segment& s : d_.segments) sum += s.length;
  return sum;
}

LinkAngles link_angles(const State& state, int segment) {
  const Eigen::Vector3d d = state.position.col(segment + 1) - state.position.col(segment);
  const double level = std::hypot(d.x(), d.y());
  return {std::atan2(-d.z(), level), level > 0 ? std::atan2(d.y(), d.x()) : 0};
}

LinkAngles link_angles(const State& state, int segment, const LinkAngles& before) {
  constexpr double pi = std::numbers::pi;
  const auto near = [](double angle, double to) { return angle + 2 * pi * std::round((to - angle) / (2 * pi)); };
  const auto distance = [&](const LinkAngles& a) {
    return std::hypot(a.polar - before.polar, a.azimuth - before.azimuth);
  };
  const LinkAngles one = link_angles(state, segment);
  const LinkAngles first{near(one.polar, before.polar), near(one.azimuth, before.azimuth)},
      second{near(pi - one.polar, before.polar), near(one.azimuth + pi, before.azimuth)};
  return distance(first) <= distance(second) ? first : second;
}

LinkAngles link_rates(const State& state, int segment, const LinkAngles& now) {
  const Eigen::Vector3d d = state.position.col(segment + 1) - state.position.col(segment),
                        v = state.velocity.col(segment + 1) - state.velocity.col(segment);
  const double level = std::hypot(d.x(), d.y());
  if (level == 0) return {0, 0};
  const double level_rate = (d.x() * v.x() + d.y() * v.y()) / level;
  const double polar_rate = (d.z() * level_rate - level * v.z()) / d.squaredNorm();
  // On the branch (π − θ, φ + π) the polar angle runs the other way.
  return {std::cos(now.polar) < 0 ? -polar_rate : polar_rate, (d.x() * v.y() - d.y() * v.x()) / (level * level)};
}

}  // namespace dynamics::line
