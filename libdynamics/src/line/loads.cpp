#include "loads.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace dynamics::line {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Coefficients per length: ½ρC_D D, ½ρC_T πD, ρA, ρA C_A, and ρgA.
struct PerLength {
  double normal, tangential, displaced, added, lift;

  PerLength(const Segment& s, const hydro::Water& water) {
    normal = 0.5 * water.density * s.cd * s.diameter;
    tangential = 0.5 * water.density * s.cd_tangential * std::numbers::pi * s.diameter;
    displaced = water.density * std::numbers::pi / 4 * s.diameter * s.diameter;
    added = displaced * s.ca;
    lift = displaced * water.gravity;
  }
};

/// The share of a segment that is under water, its surface straight between heights g₀, g₁ above the ends.
std::array<double, 2> wet_interval(double g0, double g1) {
  if (g0 >= 0 && g1 >= 0) return {0, 1};
  if (g0 < 0 && g1 < 0) return {0, 0};
  const double at = g0 / (g0 - g1);
  return g0 < 0 ? std::array{at, 1.0} : std::array{0.0, at};
}

/// One point of a segment: where, what length of wet line it stands for, and what flows past.
struct Point {
  double s, length;
  Vector3d axis, water, relative, inertial;  // t, u, u − w, and y = (1 + C_A)ρA u̇ − C_A ρA ẇ
};

Vector3d drag(const PerLength& c, const Point& p) {
  const double along = p.axis.dot(p.relative);
  const Vector3d across = p.relative - along * p.axis;
  return c.normal * across.norm() * across + c.tangential * std::abs(along) * along * p.axis;
}

Vector3d inertia(const Point& p) { return p.inertial - p.axis * p.axis.dot(p.inertial); }

/// Derivatives of drag and inertia per length by u − w, by y and by t.
struct PointDerivatives {
  Matrix3d by_relative, by_inertial, by_axis;
};

PointDerivatives differentiate(const PerLength& c, const Point& p) {
  const Matrix3d outer = p.axis * p.axis.transpose(), P = Matrix3d::Identity() - outer;
  const double along = p.axis.dot(p.relative);
  const Vector3d across = p.relative - along * p.axis;
  const double speed = across.norm(), normal = c.normal * speed, skin = c.tangential * std::abs(along);
  // Of normal |w| w by w, which is across the axis: its product with the axis is normal times the axis.
  Matrix3d by_across = normal * Matrix3d::Identity();
  if (speed > 0) by_across += (c.normal / speed) * across * across.transpose();  // flat at w = 0
  PointDerivatives d;
  d.by_relative = by_across + (2 * skin - normal) * outer;
  d.by_inertial = P;
  d.by_axis = (skin * along - p.axis.dot(p.inertial)) * Matrix3d::Identity() - along * by_across +
              p.axis * ((2 * skin - normal) * p.relative - p.inertial).transpose();
  return d;
}

/// Both Gauss points of the wet part of segment j: exact for the added mass of a rod, of third order in the drag.
std::array<Point, 2> points(const Line& line, int j, const PerLength& c, const Motion& now,
                            const std::vector<hydro::waves::Kinematics>& water) {
  const Segment& segment = line.segment(j);
  const int first = line.first(j), second = first + 1;
  const Vector3d axis = (now.x.col(second) - now.x.col(first)).normalized();
  const auto& k0 = water[static_cast<std::size_t>(first)];
  const auto& k1 = water[static_cast<std::size_t>(second)];
  std::array<double, 2> wet{0, 1};
  if (line.description().water.wet == Wet::below_surface)
    wet = wet_interval(k0.elevation - now.x(2, first), k1.elevation - now.x(2, second));
  std::array<Point, 2> out;
  const double middle = (wet[0] + wet[1]) / 2, half = (wet[1] - wet[0]) / 2;
  for (std::size_t g = 0; g < 2; ++g) {
    Point& p = out[g];
    p.s = middle + (g == 0 ? -half : half) / std::numbers::sqrt3;
    p.length = half * segment.length;
    p.axis = axis;
    const double r = 1 - p.s, s = p.s;
    p.water = r * k0.velocity + s * k1.velocity;
    p.relative = p.water - r * now.v.col(first) - s * now.v.col(second);
    p.inertial = (c.displaced + c.added) * (r * k0.material_acceleration() + s * k1.material_acceleration()) -
                 c.added * (r * now.a.col(first) + s * now.a.col(second));
  }
  return out;
}

}  // namespace

void Blocks::set_zero(int nodes, int segments) {
  diagonal.assign(static_cast<std::size_t>(nodes), Matrix3d::Zero());
  upper.assign(static_cast<std::size_t>(segments), Matrix3d::Zero());
  lower = upper;
}

bool Loads::meets_water(int node) const {
  return line_.description().water.wet != Wet::nothing || line_.node(node).sphere.diameter > 0;
}

void Loads::look_at_water(const Motion& now) {
  const auto& field = *line_.description().water.field;
  const double bed = -field.water().depth.metres();
  const Places& at = now.water_at != nullptr ? *now.water_at : now.x;
  const bool same_instant = now.t == looked_at_;
  looked_at_ = std::numeric_limits<double>::quiet_NaN();  // until it has been
  points_.resize(static_cast<std::size_t>(line_.nodes()));
  water_.resize(points_.size());
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
  for (std::size_t k = 0; k < anew_.nodes.size(); ++k)
    water_[static_cast<std::size_t>(anew_.nodes[k])] = anew_.water[k];
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
  add_node_forces(now, by, force, derivative);
  const bool wet = line_.description().water.wet != Wet::nothing;
  if (!wet && !line_.has_spheres()) return;
  look_at_water(now);
  for (int j = 0; wet && j < line_.segments(); ++j) add_water(j, now, by, force, derivative);
  if (line_.has_spheres()) add_spheres(now, by, force, derivative);
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

void Loads::add_water(int j, const Motion& now, const By& by, Places& force, Blocks* derivative) const {
  const Segment& segment = line_.segment(j);
  const auto& surroundings = line_.description().water;
  const PerLength c(segment, surroundings.field->water());
  const bool lifted = surroundings.buoyancy && surroundings.wet == Wet::below_surface;
  const int first = line_.first(j), second = first + 1;
  const double length = (now.x.col(second) - now.x.col(first)).norm();
  for (const Point& p : points(line_, j, c, now, water_)) {
    if (p.length == 0) continue;
    Vector3d f = drag(c, p) + inertia(p);
    if (lifted) f.z() += c.lift;
    const double share[2] = {p.length * (1 - p.s), p.length * p.s};
    force.col(first) += share[0] * f;
    force.col(second) += share[1] * f;
    if (derivative == nullptr) continue;
    const PointDerivatives d = differentiate(c, p);
    const double turning = length > 0 ? by.x / length : 0;
    const Vector3d along = d.by_axis * p.axis;
    const Matrix3d turn = turning * (d.by_axis - along * p.axis.transpose());
    const Matrix3d follow = -by.v * d.by_relative - by.a * c.added * d.by_inertial;
    const Matrix3d by_first = (1 - p.s) * follow - turn, by_second = p.s * follow + turn;
    const auto at = static_cast<std::size_t>(j), node = static_cast<std::size_t>(first);
    derivative->diagonal[node] += share[0] * by_first;
    derivative->upper[at] += share[0] * by_second;
    derivative->lower[at] += share[1] * by_first;
    derivative->diagonal[node + 1] += share[1] * by_second;
  }
}

LoadPowers Loads::powers(const Motion& now) {
  LoadPowers out;
  node_forces_.setZero(3, line_.nodes());
  add_node_forces(now, {0, 0, 0}, node_forces_, nullptr);
  out.damping = -node_forces_.cwiseProduct(now.v).sum();
  const auto& surroundings = line_.description().water;
  const bool wet = surroundings.wet != Wet::nothing;
  if (!wet && !line_.has_spheres()) return out;
  look_at_water(now);
  const bool lifted = surroundings.buoyancy && surroundings.wet == Wet::below_surface;
  for (int j = 0; wet && j < line_.segments(); ++j) {
    const PerLength c(line_.segment(j), surroundings.field->water());
    for (const Point& p : points(line_, j, c, now, water_)) {
      const Vector3d resistance = p.length * drag(c, p), own = p.water - p.relative;
      out.drag_supplied += resistance.dot(p.water);
      out.drag_dissipated += resistance.dot(p.relative);
      out.inertia_supplied += p.length * inertia(p).dot(own);
      if (lifted) out.buoyancy_supplied += p.length * c.lift * own.z();
    }
  }
  if (line_.has_spheres()) add_sphere_powers(now, out);
  return out;
}

}  // namespace dynamics::line
