#include "dynamics/line/line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/spatial/rotation.hpp"
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
  require(!(s.tension_only && s.is_inextensible()),
          "segment {} is inextensible, so it cannot go slack: give it an axial stiffness", j + 1);
  require(!(s.catenary && (s.is_inextensible() || s.tension_only)),
          "segment {} is a catenary, so it needs an axial stiffness and never goes slack: leave tension_only out",
          j + 1);
  require(!(s.axial_damping > 0 && s.is_inextensible()), "segment {} is inextensible, so its axial damping cannot act",
          j + 1);
  require(std::isfinite(s.bending_stiffness) && s.bending_stiffness >= 0,
          "segment {} must not have the bending stiffness {} N m^2", j + 1, s.bending_stiffness);
  require(!(s.catenary && s.bending_stiffness > 0), "segment {} is a catenary, so it has no straight axis that bends",
          j + 1);
  require(s.diameter >= 0 && s.cd >= 0 && s.cd_tangential >= 0 && s.ca >= 0,
          "diameter and coefficients of segment {} must not be negative", j + 1);
}

void check(const Node& n, std::size_t i) {
  require(std::isfinite(n.mass) && n.mass >= 0, "node {} must not have the mass {} kg", i, n.mass);
  for (const auto& force : n.forces) require(force != nullptr, "node {} has a force that is none", i);
  require(n.force.allFinite(), "the force on node {} is not finite", i);
  for (const TimedForce& load : n.loads)
    require(load.force.allFinite() && load.history.is_ordered(),
            "a load on node {} is not finite, or ends before it has risen", i);
  require(n.bob.diameter >= 0 && n.bob.cd >= 0 && n.bob.ca >= 0,
          "diameter and coefficients of the bob at node {} must not be negative", i);
  require(n.bob.length >= 0 && (n.bob.is_sphere() || n.bob.wet == Wet::all),
          "the bob at node {} is a cylinder, which has a length and is always wet", i);
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
  find_chains();
  require(d_.bed.size() <= 1, "a line lies on one bed, not on {}", d_.bed.size());
  for (const Bed& bed : d_.bed)
    require(std::isfinite(bed.friction) && bed.friction >= 0, "the bed must not have the friction {}", bed.friction);
  require(d_.water.wet == Wet::nothing || d_.water.field != nullptr, "a line that is wet needs water");
  diagonal_ = bed_area_ = Eigen::VectorXd::Zero(nodes());
  between_ = sag_weight_ = Eigen::VectorXd::Zero(segments());
  constant_ = Places::Zero(3, nodes());
  for (int i = 0; i < nodes(); ++i) add_node(i);
  for (int j = 0; j < segments(); ++j) add_segment(j);
  find_held();
  find_ties();
  find_bending();
}

void Line::add_node(int i) {
  const Node& n = node(i);
  check(n, static_cast<std::size_t>(i));
  diagonal_[i] = n.mass;
  constant_.col(i) = n.force;
  constant_(2, i) -= n.mass * d_.gravity;
  timed_loads_ = timed_loads_ || !n.loads.empty();
  if (n.bob.diameter == 0) return;
  bobs_ = true;
  require(d_.water.field != nullptr, "node {} has a bob, which needs water", i);
  const hydro::Water& water = d_.water.field->water();
  if (n.bob.buoyancy && n.bob.wet == Wet::all) constant_(2, i) += water.density * water.gravity * n.bob.volume();
}

void Line::add_segment(int j) {
  const Segment& s = segment(j);
  const int i = first(j);
  check(s, static_cast<std::size_t>(j));
  // (D71): ∫(1 − s)² dm, ∫s(1 − s) dm, ∫s² dm of the rod.
  const double second = s.inertia / (s.length * s.length) + s.mass * s.centre * s.centre;
  between_[j] = s.mass * s.centre - second;
  diagonal_[i] += s.mass - s.mass * s.centre - between_[j];
  diagonal_[i + 1] += second;
  constant_(2, i) -= s.mass * d_.gravity * (1 - s.centre);
  constant_(2, i + 1) -= s.mass * d_.gravity * s.centre;
  const bool always_lifted = d_.water.wet == Wet::all && d_.water.buoyancy;
  const double lift = always_lifted ? buoyancy(s, *d_.water.field) : 0;
  sag_weight_[j] = (s.mass * d_.gravity - lift) / s.length;
  require(!s.catenary || d_.water.wet != Wet::below_surface,
          "segment {} is a catenary by its weight in water, which a line that is wet in part does not have", j + 1);
  require(!s.catenary || sag_weight_[j] > 0, "segment {} is a catenary, but it weighs {} N/m in water", j + 1,
          sag_weight_[j]);
  for (const int end : {i, i + 1}) {
    constant_(2, end) += lift / 2;
    if (s.meets_bed) bed_area_[end] += s.diameter * s.length / 2;
  }
}

void Line::find_chains() {
  require(d_.nodes.size() == d_.segments.size() + d_.begins.size() + 1 && !d_.segments.empty(),
          "{} of {} segments has {} nodes, not {}", d_.begins.empty() ? "a line" : "a network", d_.segments.size(),
          d_.segments.size() + d_.begins.size() + 1, d_.nodes.size());
  after_.assign(d_.nodes.size(), -1);
  for (int c = 0; c < chains(); ++c) {
    require(last_of_chain(c) > first_of_chain(c), "chain {} of a network has no segment", c + 1);
    for (int i = first_of_chain(c); i < last_of_chain(c); ++i) {
      after_[static_cast<std::size_t>(i)] = static_cast<int>(first_.size());
      first_.push_back(i);
    }
  }
}

// (D110)
void Line::find_ties() {
  tie_.assign(d_.nodes.size(), -1);
  for (std::size_t k = 0; k < d_.ties.size(); ++k)
    for (const int i : d_.ties[k]) {
      require(i >= 0 && i < nodes(), "a network of {} nodes has no node {}", nodes(), i);
      require(tie(i) < 0, "node {} is tied twice", i);
      require(held(i) == nullptr, "node {} is tied, but held: hold the nodes that it is tied to instead", i);
      require(d_.ties[k].size() > 1, "node {} is tied to nothing", i);
      const bool bends = before(i) >= 0 && after(i) >= 0 && segment(before(i)).bending_stiffness > 0 &&
                         segment(after(i)).bending_stiffness > 0;
      require(!bends, "node {} is tied in the middle of a line that resists bending there: let a chain end at it", i);
      tie_[static_cast<std::size_t>(i)] = static_cast<int>(k);
    }
}

// (D106), (D107)
void Line::find_bending() {
  bending_ = Eigen::VectorXd::Zero(nodes());
  for (int i = 0; i < nodes(); ++i) {
    if (before(i) < 0 || after(i) < 0) continue;
    const Segment &a = segment(before(i)), &b = segment(after(i));
    if (a.bending_stiffness > 0 && b.bending_stiffness > 0)
      bending_[i] = 2 / (a.length / a.bending_stiffness + b.length / b.bending_stiffness);
  }
  for (const Held& h : d_.held) {
    if (h.clamp.isZero(0)) continue;
    require(before(h.node) < 0 || after(h.node) < 0, "node {} is clamped, but is no end of the line", h.node);
    require(std::abs(h.clamp.norm() - 1) < 1e-9, "node {} is clamped in a direction that is not of length 1", h.node);
    const Segment& s = segment(before(h.node) < 0 ? after(h.node) : before(h.node));
    require(s.bending_stiffness > 0, "node {} is clamped, but its segment has no bending stiffness", h.node);
    bending_[h.node] = 2 * s.bending_stiffness / s.length;
  }
  for (int j = 0; j < segments(); ++j)
    hardest_bending_ = std::max(hardest_bending_, std::max(bending_[first(j)], bending_[first(j) + 1]) /
                                                      (segment(j).length * segment(j).length));
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
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(nodes());
  for (int i = 0; i < nodes(); ++i) whole[same_as(i)] += mass(i);
  for (int i = 0; i < nodes(); ++i)
    if (moves(i) && whole[i] == 0) return true;
  return false;
}

double Line::next_corner(double t) const {
  double out = std::numeric_limits<double>::infinity();
  for (const Node& n : d_.nodes)
    for (const TimedForce& load : n.loads) out = std::min(out, load.history.next_corner(t));
  return out;
}

double Line::length() const {
  double sum = 0;
  for (const Segment& s : d_.segments) sum += s.length;
  return sum;
}

LinkAngles link_angles(const State& state, int first) {
  const Eigen::Vector3d d = state.position.col(first + 1) - state.position.col(first);
  const double level = std::hypot(d.x(), d.y());
  return {std::atan2(-d.z(), level), level > 0 ? std::atan2(d.y(), d.x()) : 0};
}

LinkAngles first_link_angles(const State& state, int first) {
  constexpr double quarter = std::numbers::pi / 2, rounding = 1e-9;
  const LinkAngles one = link_angles(state, first);
  if (std::abs(one.azimuth) <= quarter + rounding) return one;
  return link_angles(state, first, {one.polar > -rounding ? 2 * quarter : -2 * quarter, 0});
}

LinkAngles link_angles(const State& state, int first, const LinkAngles& before) {
  constexpr double pi = std::numbers::pi;
  const auto distance = [&](const LinkAngles& a) {
    return std::hypot(a.polar - before.polar, a.azimuth - before.azimuth);
  };
  LinkAngles one = link_angles(state, first);
  constexpr double vertical = 1e-10;  // rounding is all that is left of the azimuth
  if (std::cos(one.polar) < vertical) one.azimuth = before.azimuth;
  const LinkAngles same{nearest_turn(one.polar, before.polar), nearest_turn(one.azimuth, before.azimuth)},
      other{nearest_turn(pi - one.polar, before.polar), nearest_turn(one.azimuth + pi, before.azimuth)};
  return distance(same) <= distance(other) ? same : other;
}

LinkAngles link_rates(const State& state, int first, const LinkAngles& now) {
  const Eigen::Vector3d d = state.position.col(first + 1) - state.position.col(first),
                        v = state.velocity.col(first + 1) - state.velocity.col(first);
  // Along the azimuth and across it; on the branch (π − θ, φ + π) the link goes against it.
  const double c = std::cos(now.azimuth), s = std::sin(now.azimuth);
  const double along = c * d.x() + s * d.y();
  const double polar_rate = (d.z() * (c * v.x() + s * v.y()) - along * v.z()) / d.squaredNorm();
  constexpr double upright = 1e-6;  // rad from the vertical: speeds are known to no more digits than turn it there
  return {polar_rate, std::abs(along) > upright * d.norm() ? (c * v.y() - s * v.x()) / along : 0};
}

}  // namespace dynamics::line
