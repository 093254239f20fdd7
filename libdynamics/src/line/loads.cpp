#include "loads.hpp"

#include <cmath>
#include <numbers>

#include "water_points.hpp"

namespace dynamics::line {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

}  // namespace

PerLength::PerLength(const Segment& s, const hydro::Water& water)
    : normal(0.5 * water.density * s.cd * s.diameter),
      tangential(0.5 * water.density * s.cd_tangential * std::numbers::pi * s.diameter),
      displaced(water.density * std::numbers::pi / 4 * s.diameter * s.diameter),
      added(displaced * s.ca),
      lift(displaced * water.gravity) {}

Loads::Loads(const Line& line) : line_(line) {
  const auto& field = line.description().water.field;
  if (!field) return;
  still_ = field->is_still();
  for (int j = 0; j < line.segments(); ++j) per_length_.emplace_back(line.segment(j), field->water());
}

void LoadPowers::add(const PerLength& c, const WaterPoint& p, bool lifted) {
  const Triple own = p.water - p.relative, resistance = drag(c, p);
  drag_supplied += p.length * resistance.dot(p.water);
  drag_dissipated += p.length * resistance.dot(p.relative);
  inertia_supplied += p.length * inertia(p).dot(own);
  if (lifted) buoyancy_supplied += p.length * c.lift * own.z;
}

void Blocks::set_zero(int nodes, int segments) {
  diagonal.assign(static_cast<std::size_t>(nodes), Matrix3d::Zero());
  upper.assign(static_cast<std::size_t>(segments), Matrix3d::Zero());
  lower = upper;
}

bool Loads::meets_water(int node) const {
  return line_.description().water.wet != Wet::nothing || line_.node(node).bob.diameter > 0;
}

void Loads::look_at_water(const Motion& now) {
  if (still_ && !flow_.empty()) return;
  const auto& field = *line_.description().water.field;
  const double bed = -field.water().depth.metres();
  const Eigen::Ref<const Places> at = now.water_at != nullptr ? Eigen::Ref<const Places>(*now.water_at) : now.x;
  const bool same_instant = now.t == looked_at_;
  looked_at_ = std::numeric_limits<double>::quiet_NaN();  // until it has been
  points_.resize(static_cast<std::size_t>(line_.nodes()));
  water_.resize(points_.size());
  flow_.resize(points_.size());
  anew_.nodes.clear();
  anew_.points.clear();
  for (int i = 0; i < line_.nodes(); ++i) {
    if (!meets_water(i)) continue;
    Vector3d p = at.col(i);
    p.z() = std::max(p.z(), bed);  // a node pressed into the bed feels the water above it
    Vector3d& kept = points_[static_cast<std::size_t>(i)];
    if (same_instant && kept == p) continue;
    kept = p;
    anew_.nodes.push_back(i);
    anew_.points.push_back(p);
  }
  anew_.water.resize(anew_.points.size());
  field.at(now.t, anew_.points, anew_.water);
  for (std::size_t k = 0; k < anew_.nodes.size(); ++k) {
    const auto node = static_cast<std::size_t>(anew_.nodes[k]);
    const hydro::waves::Kinematics& water = water_[node] = anew_.water[k];
    flow_[node] = {water.elevation, water.velocity, water.material_acceleration()};
  }
  looked_at_ = now.t;
}

bool Loads::flow_differs(const Places& x) const {
  constexpr double much = 1e-3;
  if (std::isnan(looked_at_)) return false;
  double difference = 0, speed = 0;
  for (int i = 0; i < line_.nodes(); ++i) {
    if (!meets_water(i)) continue;
    const auto& water = water_[static_cast<std::size_t>(i)];
    difference = std::max(difference, (water.gradient * (x.col(i) - points_[static_cast<std::size_t>(i)])).norm());
    speed = std::max(speed, water.velocity.norm());
  }
  return difference > much * speed;
}

void Loads::add(const Motion& now, const By& by, Places& force, Blocks* derivative) {
  force += line_.constant_load();
  if (meet_water()) look_at_water(now);
  for (int j = 0; are_wet() && j < line_.segments(); ++j) add_water(j, now, by, force, derivative);
  add_at_nodes(now, by, force, derivative);
}

void Loads::add_at_nodes(const Motion& now, const By& by, Places& force, Blocks* derivative) const {
  add_node_forces(now, by, force, derivative);
  if (line_.has_timed_loads()) add_timed_loads(now.t, force);
  if (line_.has_bobs()) add_bobs(now, by, force, derivative);
}

void Loads::add_node_forces(const Motion& now, const By& by, Places& force, Blocks* derivative) const {
  for (int i = 0; i < line_.nodes(); ++i) {
    const Node& node = line_.node(i);
    if (node.forces.empty()) continue;
    const NodeForce::At at{now.t, now.x.col(i), now.v.col(i)};
    NodeForce::Derivatives d;
    for (const auto& of : node.forces) force.col(i) += node.share * of->force(at, derivative != nullptr ? &d : nullptr);
    if (derivative != nullptr)
      derivative->diagonal[static_cast<std::size_t>(i)] += node.share * (by.x * d.by_place + by.v * d.by_velocity);
  }
}

// (D150)
void Loads::add_timed_loads(double t, Places& force) const {
  const double within = std::isnan(within_) ? t : within_;
  for (int i = 0; i < line_.nodes(); ++i)
    for (const TimedForce& load : line_.node(i).loads) force.col(i) += load.history.share(t, within) * load.force;
}

void Loads::add_water(int j, const Motion& now, const By& by, Places& force, Blocks* derivative) const {
  const Triple axis = Triple::of((now.x.col(line_.first(j) + 1) - now.x.col(line_.first(j))).normalized());
  for (const Stretch& wet : wet_stretches(line_, j, now, flow_)) {
    if (wet.from == wet.to) continue;
    for (const WaterPoint& p : points(line_, j, wet, axis, per_length(j), now, flow_))
      add_point(j, p, now, by, force, derivative);
  }
}

void Loads::add_point(int j, const WaterPoint& p, const Motion& now, const By& by, Places& force,
                      Blocks* derivative) const {
  const PerLength& c = per_length(j);
  const int first = line_.first(j), second = first + 1;
  Triple f = drag(c, p) + inertia(p);
  if (lifts_what_is_wet()) f.z += c.lift;
  force.col(first) += p.length * (1 - p.s) * f.vector();
  force.col(second) += p.length * p.s * f.vector();
  if (derivative == nullptr) return;
  const PointDerivatives of(c, p, (now.x.col(second) - now.x.col(first)).norm());
  Matrix3d follow = -by.v * of.by_relative;
  add_unit(-by.a * c.added, follow);
  add_outer(by.a * c.added, p.axis, p.axis, follow);
  spread(p, j, first, -by.x, by.x, of.by_turning, *derivative);
  spread(p, j, first, 1 - p.s, p.s, follow, *derivative);
  if (p.by_depth > 0) spread_rise(p, j, first, by.x, f, *derivative);
}

LoadPowers Loads::powers(const Motion& now) {
  LoadPowers out;
  if (meet_water()) look_at_water(now);
  const bool lifted = lifts_what_is_wet();
  for (int j = 0; are_wet() && j < line_.segments(); ++j) {
    const PerLength& c = per_length(j);
    const int first = line_.first(j);
    const Triple axis = Triple::of((now.x.col(first + 1) - now.x.col(first)).normalized());
    for (const Stretch& wet : wet_stretches(line_, j, now, flow_))
      for (const WaterPoint& p : points(line_, j, wet, axis, c, now, flow_)) out.add(c, p, lifted);
  }
  add_powers_at_nodes(now, out);
  return out;
}

void Loads::add_powers_at_nodes(const Motion& now, LoadPowers& out) {
  node_forces_.setZero(3, line_.nodes());
  add_node_forces(now, {0, 0, 0}, node_forces_, nullptr);
  out.damping -= node_forces_.cwiseProduct(now.v).sum();
  if (line_.has_timed_loads()) {
    node_forces_.setZero();
    add_timed_loads(now.t, node_forces_);
    out.load_supplied += node_forces_.cwiseProduct(now.v).sum();
  }
  if (line_.has_bobs()) add_bob_powers(now, out);
}

}  // namespace dynamics::line
