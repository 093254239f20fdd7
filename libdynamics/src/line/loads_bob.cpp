/// Floats and sinkers at nodes, and cylinders that stand for what hangs there. (D113), (D153)
#include <algorithm>
#include <cmath>

#include "loads.hpp"

namespace dynamics::line {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// |w| w, or of each component by itself.
Vector3d squared(const Vector3d& w, bool by_component) {
  return by_component ? Vector3d(w.cwiseAbs().cwiseProduct(w)) : Vector3d(w.norm() * w);
}

Matrix3d squared_by(const Vector3d& w, bool by_component) {
  if (by_component) return Matrix3d((2 * w.cwiseAbs()).asDiagonal());
  const double speed = w.norm();
  Matrix3d out = speed * Matrix3d::Identity();
  if (speed > 0) out += w * w.transpose() / speed;
  return out;
}

/// What acts on a bob, the wet share of its volume aside: ½ρC_D A |w|w + (1 + C_A)ρV u̇ − C_A ρV a, w = u − v.
struct Floating {
  double drag, displaced, added, lift;   // ½ρC_D A, ρV, C_A ρV, and ρgV where it lifts by what is wet
  double share = 1, share_by_depth = 0;  // of the volume, and its derivative by the depth of the centre
  bool by_component;
  Vector3d relative, resistance, inertia;

  Floating(const Bob& b, const hydro::Water& water, const hydro::waves::Kinematics& at, const Vector3d& x,
           const Vector3d& v, const Vector3d& a)
      : by_component(b.by_component) {
    drag = 0.5 * water.density * b.cd * b.section();
    displaced = water.density * b.volume();
    added = b.ca * displaced;
    const bool in_part = b.wet == Wet::below_surface;
    lift = b.buoyancy && in_part ? displaced * water.gravity : 0;
    if (in_part) cut(b.diameter / 2, at.elevation - x.z());
    relative = at.velocity - v;
    resistance = drag * squared(relative, by_component);
    const double pushed = b.relative_only ? added : displaced + added;
    inertia = pushed * at.material_acceleration() - added * a;
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

void Loads::add_bobs(const Motion& now, const By& by, Places& force, Blocks* derivative) const {
  const hydro::Water& water = line_.description().water.field->water();
  for (int i = 0; i < line_.nodes(); ++i) {
    const Bob& b = line_.node(i).bob;
    if (b.diameter == 0) continue;
    const auto at = static_cast<std::size_t>(i);
    const Floating f(b, water, water_[at], now.x.col(i), now.v.col(i), now.a.col(i));
    force.col(i) += f.share * f.whole();
    if (derivative == nullptr) continue;
    const Matrix3d by_relative = f.drag * squared_by(f.relative, f.by_component);
    Matrix3d& block = derivative->diagonal[at];
    block -= f.share * (by.v * by_relative + by.a * f.added * Matrix3d::Identity());
    block.col(2) -= by.x * f.share_by_depth * f.whole();
  }
}

void Loads::add_bob_powers(const Motion& now, LoadPowers& out) const {
  const hydro::Water& water = line_.description().water.field->water();
  for (int i = 0; i < line_.nodes(); ++i) {
    const Bob& b = line_.node(i).bob;
    if (b.diameter == 0) continue;
    const auto& at = water_[static_cast<std::size_t>(i)];
    const Vector3d v = now.v.col(i);
    const Floating f(b, water, at, now.x.col(i), v, now.a.col(i));
    out.drag_supplied += f.share * f.resistance.dot(at.velocity);
    out.drag_dissipated += f.share * f.resistance.dot(f.relative);
    out.inertia_supplied += f.share * f.inertia.dot(v);
    out.buoyancy_supplied += f.share * f.lift * v.z();
  }
}

}  // namespace dynamics::line
