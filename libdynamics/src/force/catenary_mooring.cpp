#include "dynamics/force/catenary_mooring.hpp"

#include <fmt/format.h>

#include "dynamics/spatial/rotation.hpp"

namespace dynamics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A line where it is: its pull on the fairlead and how that changes as the fairlead moves, global axes.
struct Pull {
  Vector3d arm, force;
  Matrix3d by_place;
  double stored;
};

struct Span {
  Vector3d arm, ahead;  // horizontal direction from anchor to fairlead
  double x, z;
};

Span span_of(const CatenaryMooring& m, const State& state) {
  Span r;
  r.arm = arm_of(m.fairlead, state);
  const Vector3d d = place_of(m.fairlead, state) - m.anchor.place;
  r.x = d.head<2>().norm();
  r.z = d.z();
  r.ahead = r.x > 0 ? Vector3d(d.x() / r.x, d.y() / r.x, 0) : Vector3d(Vector3d::Zero());
  return r;
}

LineTension tension_at(const CatenaryMooring& m, const Span& r) {
  return m.table && m.table->reach().holds(r.x, r.z) ? m.table->at(r.x, r.z) : catenary(m.line, r.x, r.z);
}

/// Horizontal away from the anchor, and up.
Eigen::Matrix<double, 3, 2> plane_of(const Span& r) {
  Eigen::Matrix<double, 3, 2> plane;
  plane << r.ahead, Vector3d::UnitZ();
  return plane;
}

// (D63)
Pull pull_of(const CatenaryMooring& m, const State& state) {
  const Span r = span_of(m, state);
  const LineTension t = tension_at(m, r);
  const Vector3d up = Vector3d::UnitZ(), aside = up.cross(r.ahead);
  const auto plane = plane_of(r);
  Pull p;
  p.arm = r.arm;
  p.force = -t.horizontal * r.ahead - t.vertical * up;
  p.by_place = -plane * t.stiffness * plane.transpose();
  if (r.x > 0) p.by_place -= t.horizontal / r.x * aside * aside.transpose();
  p.stored = t.stored;
  return p;
}

}  // namespace

LineTension tension_of(const CatenaryMooring& mooring, const State& state) {
  return tension_at(mooring, span_of(mooring, state));
}

// T² = H² + V²; at the anchor V is smaller by the weight of the line, or zero where some of it rests.
TensionGradient tension_gradient(const CatenaryMooring& mooring, const State& state) {
  const Span r = span_of(mooring, state);
  const LineTension t = tension_at(mooring, r);
  const Eigen::Matrix<double, 2, 6> pull_by_q = t.stiffness * plane_of(r).transpose() * place_by_displacement(r.arm);
  TensionGradient out;
  out.fairlead = Eigen::RowVector2d(t.horizontal, t.vertical) / t.fairlead() * pull_by_q;
  out.anchor.setZero();
  if (t.anchor() > 0) out.anchor = Eigen::RowVector2d(t.horizontal, t.anchor_vertical) / t.anchor() * pull_by_q;
  return out;
}

std::vector<Signal> CatenaryMooringKind::signals() const {
  std::vector<Signal> out;
  for (const CatenaryMooring& m : elements_) {
    const auto add = [&](const char* what, const char* where, double (LineTension::*tension)() const,
                         Variation::Row TensionGradient::*gradient) {
      out.push_back({.name = fmt::format("{}.{}", m.name, what),
                     .unit = "N",
                     .meaning = fmt::format("tension of {} at the {}", m.name, where),
                     .value = [m, tension](const Reading& r) { return (tension_of(m, r.state).*tension)(); },
                     .variation =
                         [m, gradient](const Still& still) {
                           return Variation{.parts = {{.body = m.fairlead.body,
                                                       .by_motion = tension_gradient(m, still.state).*gradient}}};
                         }});
    };
    add("tension", "fairlead", &LineTension::fairlead, &TensionGradient::fairlead);
    add("anchor_tension", "anchor", &LineTension::anchor, &TensionGradient::anchor);
  }
  return out;
}

std::string CatenaryMooringKind::method() const {
  const CatenaryTable* worst = nullptr;
  std::size_t tabled = 0;
  for (const CatenaryMooring& m : elements_) {
    if (!m.table) continue;
    ++tabled;
    if (worst == nullptr || m.table->error() > worst->error()) worst = m.table.get();
  }
  if (worst == nullptr) return "elastic catenary, solved where the fairlead is";
  return fmt::format("elastic catenary; {} of {} from tables of up to {} x {} cells, within {:.2g} N; solved outside",
                     tabled, elements_.size(), worst->cells(), worst->cells(), worst->error());
}

void CatenaryMooringKind::add_load(const Instant& now, LoadSink& out) const {
  for (const CatenaryMooring& m : elements_) {
    const Pull p = pull_of(m, now.state);
    Vector6 load;
    load << p.force, p.arm.cross(p.force);
    out.add(m.fairlead.body, load);
  }
}

void CatenaryMooringKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for (const CatenaryMooring& m : elements_) {
    const Pull p = pull_of(m, now.state);
    const Matrix3d S = cross_matrix(p.arm);
    Eigen::Matrix<double, 3, 6> force_by_q;
    force_by_q << p.by_place, -p.by_place * S;
    Matrix6 by_q;
    by_q << force_by_q, S * force_by_q;
    by_q.bottomRightCorner<3, 3>() += cross_matrix(p.force) * S;
    out.add(m.fairlead.body, m.fairlead.body, by_q, Matrix6::Zero());
  }
}

EnergyFlow CatenaryMooringKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (const CatenaryMooring& m : elements_) flow.stored += pull_of(m, now.state).stored;
  return flow;
}

}  // namespace dynamics
