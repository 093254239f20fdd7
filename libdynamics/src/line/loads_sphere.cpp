/// Floats and sinkers at nodes. (D113)
#include <algorithm>
#include <cmath>
#include <numbers>

#include "loads.hpp"

namespace dynamics::line {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// What acts on a sphere, the wet share of its volume aside: ½ρC_D A |w|w + (1 + C_A)ρV u̇ − C_A ρV a, w = u − v.
struct Floating {
  double drag, displaced, added, lift;   // ½ρC_D A, ρV, C_A ρV, and ρgV where it lifts by what is wet
  double share = 1, share_by_depth = 0;  // of the volume, and its derivative by the depth of the centre
  Vector3d relative, resistance, inertia;

  Floating(const Sphere& s, const hydro::Water& water, const hydro::waves::Kinematics& at, const Vector3d& x,
           const Vector3d& v, const Vector3d& a) {
    const double D = s.diameter;
    drag = 0.5 * water.density * s.cd * std::numbers::pi / 4 * D * D;
    displaced = water.density * s.volume();
    added = s.ca * displaced;
    const bool in_part = s.wet == Wet::below_surface;
    lift = s.buoyancy && in_part ? displaced * water.gravity : 0;
    if (in_part) cut(D / 2, at.elevation - x.z());
    relative = at.velocity - v;
    resistance = drag * relative.norm() * relative;
    inertia = (displaced + added) * at.material_acceleration() - added * a;
  }

  /// The cap of height h = R + depth: π h² (3R − h)/3 of 4πR³/3.
  void cut(double R, double depth) {
    const double h = std::clamp(R + depth, 0.0, 2 * R);
    share = h * h * (3 * R - h) / (4 * R * R * R);
    share_by_depth = (6 * R * h - 3 * h * h) / (4 * R * R * R);
  }

  Vector3d whole() const { return resistance + inertia + lift * Vector3d::UnitZ(); }
};

}  // namespace

void Loads::add_spheres(const Motion& now, const By& by, Places& force, Blocks* derivative) const {
  const hydro::Water& water = line_.description().water.field->water();
  for (int i = 0; i < line_.nodes(); ++i) {
    const Sphere& s = line_.node(i).sphere;
    if (s.diameter == 0) continue;
    const auto at = static_cast<std::size_t>(i);
    const Floating f(s, water, water_[at], now.x.col(i), now.v.col(i), now.a.col(i));
    force.col(i) += f.share * f.whole();
    if (derivative == nullptr) continue;
    const double speed = f.relative.norm();
    Matrix3d by_relative = f.drag * speed * Matrix3d::Identity();
    if (speed > 0) by_relative += f.drag / speed * f.relative * f.relative.transpose();
    Matrix3d& block = derivative->diagonal[at];
    block -= f.share * (by.v * by_relative + by.a * f.added * Matrix3d::Identity());
    block.col(2) -= by.x * f.share_by_depth * f.whole();
  }
}

void Loads::add_sphere_powers(const Motion& now, LoadPowers& out) const {
  const hydro::Water& water = line_.description().water.field->water();
  for (int i = 0; i < line_.nodes(); ++i) {
    const Sphere& s = line_.node(i).sphere;
    if (s.diameter == 0) continue;
    const auto& at = water_[static_cast<std::size_t>(i)];
    const Vector3d v = now.v.col(i);
    const Floating f(s, water, at, now.x.col(i), v, now.a.col(i));
    out.drag_supplied += f.share * f.resistance.dot(at.velocity);
    out.drag_dissipated += f.share * f.resistance.dot(f.relative);
    out.inertia_supplied += f.share * f.inertia.dot(v);
    out.buoyancy_supplied += f.share * f.lift * v.z();
  }
}

}  // namespace dynamics::line
