#include "dynamics/force/catenary_mooring.hpp"

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

struct Reach {
  Vector3d arm, ahead;  // horizontal direction from anchor to fairlead
  double x, z;
};

Reach reach_of(const CatenaryMooring& m, const State& state) {
  const Pose& pose = state.pose[static_cast<std::size_t>(m.body)];
  Reach r;
  r.arm = pose.attitude * m.fairlead;
  const Vector3d d = pose.centre + r.arm - m.anchor;
  r.x = d.head<2>().norm();
  r.z = d.z();
  r.ahead = r.x > 0 ? Vector3d(d.x() / r.x, d.y() / r.x, 0) : Vector3d(Vector3d::Zero());
  return r;
}

// (D63)
Pull pull_of(const CatenaryMooring& m, const State& state) {
  const Reach r = reach_of(m, state);
  const LineTension t = catenary(m.line, r.x, r.z);
  const Vector3d up = Vector3d::UnitZ(), aside = up.cross(r.ahead);
  Eigen::Matrix<double, 3, 2> plane;
  plane << r.ahead, up;
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
  const Reach r = reach_of(mooring, state);
  return catenary(mooring.line, r.x, r.z);
}

void CatenaryMooringKind::add_load(const Instant& now, LoadSink& out) const {
  for (const CatenaryMooring& m : elements_) {
    const Pull p = pull_of(m, now.state);
    Vector6 load;
    load << p.force, p.arm.cross(p.force);
    out.add(m.body, load);
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
    out.add(m.body, m.body, by_q, Matrix6::Zero());
  }
}

EnergyFlow CatenaryMooringKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (const CatenaryMooring& m : elements_) flow.stored += pull_of(m, now.state).stored;
  return flow;
}

}  // namespace dynamics
