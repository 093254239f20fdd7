#include "dynamics/force/mode_damping.hpp"

#include "dynamics/spatial/rotation.hpp"

namespace dynamics {
namespace {

/// What one element does in a state.
struct At {
  Eigen::Vector3d arm;  ///< from the centre of gravity to the origin, global
  Vector6 velocity;     ///< u
  Vector6 load;         ///< at the origin
  Vector6 slope;        ///< b + 2q|u|
};

At at(const ModeDamping& e, const State& state) {
  At out{};
  const Vector6 twist = state.twist(e.body);
  out.arm = state.pose[static_cast<std::size_t>(e.body)].attitude * e.origin;
  out.velocity = twist;
  out.velocity.head<3>() += twist.tail<3>().cross(out.arm);
  const Vector6 size = out.velocity.cwiseAbs();
  out.load = -(e.linear + e.quadratic.cwiseProduct(size)).cwiseProduct(out.velocity);
  out.slope = e.linear + 2 * e.quadratic.cwiseProduct(size);
  return out;
}

/// u of a twist about the centre of gravity; its transpose brings a load from the origin there.
Matrix6 to_origin(const Eigen::Vector3d& arm) {
  Matrix6 out = Matrix6::Identity();
  out.topRightCorner<3, 3>() = -cross_matrix(arm);
  return out;
}

}  // namespace

void ModeDampingKind::add_load(const Instant& now, LoadSink& out) const {
  for (const ModeDamping& e : elements_) {
    const At a = at(e, now.state);
    out.add(e.body, to_origin(a.arm).transpose() * a.load);
  }
}

void ModeDampingKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for (const ModeDamping& e : elements_) {
    const At a = at(e, now.state);
    const Matrix6 T = to_origin(a.arm);
    const Matrix6 by_velocity = -T.transpose() * a.slope.asDiagonal() * T;
    // The arm turns by θ × r: u by ω × (θ × r), the moment r × F by (θ × r) × F.
    const Eigen::Matrix3d turned = -cross_matrix(a.arm);
    Eigen::Matrix<double, 6, 3> u = Eigen::Matrix<double, 6, 3>::Zero();
    u.topRows<3>() = cross_matrix(now.state.twist(e.body).tail<3>()) * turned;
    Matrix6 by_displacement = Matrix6::Zero();
    by_displacement.rightCols<3>() = -T.transpose() * a.slope.asDiagonal() * u;
    by_displacement.bottomRightCorner<3, 3>() -= cross_matrix(a.load.head<3>()) * turned;
    out.add(e.body, e.body, by_displacement, by_velocity);
  }
}

EnergyFlow ModeDampingKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (const ModeDamping& e : elements_) {
    const At a = at(e, now.state);
    flow.dissipated -= a.load.dot(a.velocity);
  }
  return flow;
}

}  // namespace dynamics
