#include "dynamics/force/drag.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "dynamics/spatial/rotation.hpp"

namespace dynamics {
namespace {

/// How a body moves, seen along its own axes, in which arms and axes of its pieces stand still.
struct BodyMotion {
  Eigen::Matrix3d to_body;          // Rᵀ
  Eigen::Vector3d velocity, omega;  // of the centre of gravity, global; along body axes
};

BodyMotion motion_of(int body, const State& state) {
  const auto twist = state.twist(body);
  const Eigen::Matrix3d to_body = state.pose[static_cast<std::size_t>(body)].attitude.conjugate().toRotationMatrix();
  return {to_body, twist.head<3>(), to_body * twist.tail<3>()};
}

/// Flow past a piece along body axes.
struct DragFlow {
  Eigen::Vector3d towards, relative, across;  // u − v of the centre of gravity, of the piece, and across its axis
};

DragFlow flow_past(const DragPiece& piece, const BodyMotion& body, const Eigen::Vector3d& water) {
  DragFlow f;
  f.towards = body.to_body * (water - body.velocity);
  f.relative = f.towards - body.omega.cross(piece.arm);
  f.across = f.relative - piece.axis * piece.axis.dot(f.relative);
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

/// Calls act(piece, motion of its body, water, flow) for each piece, `water` global.
template <class Act>
void for_each_flow(const std::vector<DragPiece>& pieces, const std::optional<WaveSignals>& water, const State& state,
                   Act act) {
  const auto each = [&](const auto& velocity) {
    BodyMotion motion;
    int body = -1;  // pieces of one body mostly lie together
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const DragPiece& piece = pieces[i];
      if (piece.body != body) motion = motion_of(body = piece.body, state);
      const Eigen::Vector3d u = piece.current + velocity.template segment<3>(3 * static_cast<Eigen::Index>(i));
      act(piece, motion, u, flow_past(piece, motion, u));
    }
  };
  if (water)
    water->use_at(state.time, each);
  else
    each(Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(pieces.size())));
}

/// c |w| w across the axis, along body axes.
Eigen::Vector3d force_on(const DragPiece& piece, const DragFlow& f) {
  return piece.factor * f.across.norm() * f.across;
}

}  // namespace

void DragKind::add_load(const Instant& now, LoadSink& out) const {
  Eigen::Vector3d force, moment;  // on one body, along its axes
  Eigen::Matrix3d to_body;
  int body = -1;
  const auto add = [&] {
    if (body < 0) return;
    Vector6 load;
    load << to_body.transpose() * force, to_body.transpose() * moment;
    out.add(body, load);
  };
  for_each_flow(pieces_, water_, now.state,
                [&](const DragPiece& piece, const BodyMotion& motion, const Eigen::Vector3d&, const DragFlow& f) {
                  if (piece.body != body) {
                    add();
                    force.setZero();
                    moment.setZero();
                    to_body = motion.to_body;
                    body = piece.body;
                  }
                  const Eigen::Vector3d of_piece = force_on(piece, f);
                  force += of_piece;
                  moment += piece.arm.cross(of_piece);
                });
  add();
}

// Along body axes arms and axes are constant. What turns with the body by θ, δ = −[·]× θ, is the load itself; what is
// seen from it turns the other way: the flow towards it, δ(Rᵀ(u − v)) = [Rᵀ(u − v)]× θ, and ω, δ(Rᵀω) = [Rᵀω]× θ.
void DragKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  const auto each = [&](const DragPiece& piece, const BodyMotion& motion, const Eigen::Vector3d&, const DragFlow& f) {
    const double speed = f.across.norm();
    if (speed == 0) return;  // |w| w is flat there
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - piece.axis * piece.axis.transpose();
    const Eigen::Matrix3d by_relative =
        piece.factor * (speed * Eigen::Matrix3d::Identity() + f.across * f.across.transpose() / speed) * across;
    const Eigen::Matrix3d S = cross_matrix(piece.arm);
    const Eigen::Vector3d force = force_on(piece, f);
    Eigen::Matrix<double, 3, 6> force_by_q = Eigen::Matrix<double, 3, 6>::Zero(), force_by_v;
    force_by_q.rightCols<3>() = by_relative * (cross_matrix(f.towards) + S * cross_matrix(motion.omega));
    force_by_v << -by_relative, by_relative * S;
    Matrix6 by_q, by_v;
    by_q << force_by_q, S * force_by_q;
    by_v << force_by_v, S * force_by_v;
    by_q.topRightCorner<3, 3>() -= cross_matrix(force);
    by_q.bottomRightCorner<3, 3>() -= cross_matrix(piece.arm.cross(force));
    const Eigen::Matrix3d R = motion.to_body.transpose();
    out.add(piece.body, piece.body, turned(by_q, R), turned(by_v, R));
  };
  for_each_flow(pieces_, water_, now.state, each);
}

EnergyFlow DragKind::energy(const Instant& now) const {
  EnergyFlow flow;
  const auto each = [&](const DragPiece& piece, const BodyMotion& motion, const Eigen::Vector3d& water,
                        const DragFlow& f) {
    const Eigen::Vector3d force = force_on(piece, f);
    flow.supplied += force.dot(motion.to_body * water);
    flow.dissipated += force.dot(f.relative);
  };
  for_each_flow(pieces_, water_, now.state, each);
  return flow;
}

}  // namespace dynamics
