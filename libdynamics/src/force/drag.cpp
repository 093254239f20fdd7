#include "dynamics/force/drag.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "dynamics/spatial/rotation.hpp"

namespace dynamics {
namespace {

struct DragFlow {
  Eigen::Vector3d arm, axis, omega, water, relative,
      across;  // global; relative = u − v, across: its part across the axis
};

/// What all pieces of one body share.
struct BodyMotion {
  Eigen::Matrix3d R;
  Eigen::Vector3d velocity, omega;
};

BodyMotion motion_of(int body, const State& state) {
  const auto twist = state.twist(body);
  return {state.pose[static_cast<std::size_t>(body)].attitude.toRotationMatrix(), twist.head<3>(), twist.tail<3>()};
}

DragFlow flow_past(const DragPiece& piece, const BodyMotion& body, const Eigen::Vector3d& water) {
  DragFlow f;
  f.arm = body.R * piece.arm;
  f.axis = body.R * piece.axis;
  f.omega = body.omega;
  f.water = water;
  f.relative = water - body.velocity - f.omega.cross(f.arm);
  f.across = f.relative - f.axis * f.axis.dot(f.relative);
  return f;
}

}  // namespace

std::vector<DragPiece> drag_pieces(const std::vector<RigidBody>& bodies, int body, const Eigen::Vector3d& from,
                                   const Eigen::Vector3d& to, double diameter, double cd, double density) {
  const RigidBody& b = bodies[static_cast<std::size_t>(body)];
  const Eigen::Vector3d origin = b.properties().rest_position.xyz;
  const double z0 = origin.z() + from.z(), z1 = origin.z() + to.z();
  double s0 = 0, s1 = 1;  // the wet part, as fractions of the length
  if (z0 > 0 && z1 > 0) return {};
  if (z0 > 0) s0 = z0 / (z0 - z1);
  if (z1 > 0) s1 = z0 / (z0 - z1);
  const Eigen::Vector3d along = to - from;
  // Three Gauss–Legendre points: exact for a velocity that varies as a fifth-degree polynomial along the member.
  constexpr std::array<double, 3> point{-0.774596669241483377, 0, 0.774596669241483377};
  constexpr std::array<double, 3> weight{5.0 / 18, 8.0 / 18, 5.0 / 18};
  std::vector<DragPiece> pieces;
  for (std::size_t i = 0; i < point.size(); ++i) {
    const double s = s0 + (s1 - s0) * (1 + point[i]) / 2, length = weight[i] * (s1 - s0) * along.norm();
    pieces.push_back({body, from + s * along - b.properties().centre_of_gravity.xyz, along.normalized(),
                      0.5 * density * cd * diameter * length, Eigen::Vector3d::Zero()});
  }
  return pieces;
}

Eigen::Vector3d rest_position(const DragPiece& piece, const std::vector<RigidBody>& bodies) {
  return bodies[static_cast<std::size_t>(piece.body)].rest_centre() + piece.arm;
}

namespace {
template <class Do>
void for_each_flow(const std::vector<DragPiece>& pieces, const std::optional<WaveSignals>& water, const State& state,
                   Do act) {
  const auto each = [&](const auto& velocity) {
    BodyMotion body;
    int of = -1;  // pieces of one body mostly lie together
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].body != of) body = motion_of(of = pieces[i].body, state);
      act(pieces[i], flow_past(pieces[i], body,
                               pieces[i].current + velocity.template segment<3>(3 * static_cast<Eigen::Index>(i))));
    }
  };
  if (water)
    water->use_at(state.time, each);
  else
    each(Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(pieces.size())));
}
}  // namespace

void DragKind::add_load(const Instant& now, LoadSink& out) const {
  Vector6 load = Vector6::Zero();
  int on = -1;
  for_each_flow(pieces_, water_, now.state, [&](const DragPiece& piece, const DragFlow& f) {
    if (piece.body != on) {
      if (on >= 0) out.add(on, load);
      load.setZero();
      on = piece.body;
    }
    const Eigen::Vector3d force = piece.factor * f.across.norm() * f.across;
    load.head<3>() += force;
    load.tail<3>() += f.arm.cross(force);
  });
  if (on >= 0) out.add(on, load);
}

void DragKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for_each_flow(pieces_, water_, now.state, [&](const DragPiece& piece, const DragFlow& f) {
    const double speed = f.across.norm();
    if (speed == 0) return;  // |w| w is flat there
    const Eigen::Vector3d force = piece.factor * speed * f.across;
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - f.axis * f.axis.transpose();
    const Eigen::Matrix3d by_w =
        piece.factor * (speed * Eigen::Matrix3d::Identity() + f.across * f.across.transpose() / speed);
    const Eigen::Matrix3d S = cross_matrix(f.arm), T = cross_matrix(f.axis);
    // Turning by θ moves the arm (its velocity ω × s) and the axis t; dt = −[t]× dθ.
    const Eigen::Matrix3d w_by_theta =
        across * cross_matrix(f.omega) * S + f.axis.dot(f.relative) * T + f.axis * f.relative.transpose() * T;
    Eigen::Matrix<double, 3, 6> force_by_q = Eigen::Matrix<double, 3, 6>::Zero(), force_by_v;
    force_by_q.rightCols<3>() = by_w * w_by_theta;
    force_by_v << -by_w * across, by_w * across * S;
    Matrix6 by_q, by_v;
    by_q << force_by_q, S * force_by_q;
    by_q.bottomRightCorner<3, 3>() += cross_matrix(force) * S;
    by_v << force_by_v, S * force_by_v;
    out.add(piece.body, piece.body, by_q, by_v);
  });
}

EnergyFlow DragKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for_each_flow(pieces_, water_, now.state, [&](const DragPiece& piece, const DragFlow& f) {
    const Eigen::Vector3d force = piece.factor * f.across.norm() * f.across;
    flow.supplied += force.dot(f.water);
    flow.dissipated += force.dot(f.relative);
  });
  return flow;
}

}  // namespace dynamics
