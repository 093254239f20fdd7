#include "dynamics/force/restoring.hpp"

#include <fmt/format.h>

#include "dynamics/spatial/rotation.hpp"
#include "hydro/base/types.hpp"

namespace dynamics {
namespace {

using Eigen::Vector3d;

/// A load at a point, or how it varies, one a column, seen from `arm` before it.
template <int columns>
Eigen::Matrix<double, 6, columns> seen_from(Eigen::Matrix<double, 6, columns> load, const Vector3d& arm) {
  load.template bottomRows<3>() += cross_matrix(arm) * load.template topRows<3>();
  return load;
}

/// Where the point of an element is, and what the element does there.
struct AtPoint {
  Vector3d arm;  ///< from the centre of gravity, global
  Vector6 displacement, velocity;
  Vector6 load;  ///< about the point

  AtPoint(const Restoring& e, const RestoringKind::Held& held, const State& state) {
    const Pose& pose = state.pose[static_cast<std::size_t>(e.body)];
    arm = pose.attitude * e.point;
    displacement << pose.centre + arm - held.rest, rotation_log(pose.attitude);
    velocity = state.twist(e.body);
    velocity.head<3>() += Vector3d(velocity.tail<3>()).cross(arm);
    load = -e.stiffness * displacement;
    load.tail<3>() = left_jacobian_inverse(displacement.tail<3>()).transpose() * Vector3d(load.tail<3>());
    load -= e.damping * velocity;
  }
};

/// ∂load/∂(displacement of the point and small global rotation), both about the point, without damping.
Matrix6 stiffness_at(const Restoring& e, const Vector6& d) {
  const Vector3d phi = d.tail<3>(), m = (e.stiffness * d).tail<3>();
  Matrix6 G = Matrix6::Identity();
  G.bottomRightCorner<3, 3>() = left_jacobian_inverse(phi);
  Matrix6 K = -G.transpose() * e.stiffness * G;
  K.bottomRightCorner<3, 3>() -= left_jacobian_inverse_transpose_derivative(phi, m) * G.bottomRightCorner<3, 3>();
  return K;
}

/// ∂load/∂(displacement of the centre of gravity and small global rotation), about it: the arm turns with the body, and
/// with it the point's velocity.
Matrix6 by_displacement(const Restoring& e, const AtPoint& at) {
  Matrix6 velocity = Matrix6::Zero();  // of the point, by the turn of its arm
  velocity.topRightCorner<3, 3>() = -cross_matrix(at.velocity.tail<3>()) * cross_matrix(at.arm);
  Matrix6 K = seen_from<6>(stiffness_at(e, at.displacement) * shift_from_centre(at.arm) - e.damping * velocity, at.arm);
  K.bottomRightCorner<3, 3>() += cross_matrix(at.load.head<3>()) * cross_matrix(at.arm);
  return K;
}

Matrix6 by_velocity(const Restoring& e, const AtPoint& at) {
  return seen_from<6>(-e.damping * shift_from_centre(at.arm), at.arm);
}

/// The arm from the body's origin to its centre of gravity.
Vector3d to_centre(const Restoring& e, const RestoringKind::Held& held, const State& state) {
  return state.pose[static_cast<std::size_t>(e.body)].attitude * held.centre;
}

Vector6 load_about_origin(const Restoring& e, const RestoringKind::Held& held, const State& state) {
  const AtPoint at(e, held, state);
  return seen_from<1>(at.load, to_centre(e, held, state) + at.arm);
}

/// The arm turns with the body: δ(r × F) = r × δF + F × (r × θ).
Variation origin_variation(const Restoring& e, const RestoringKind::Held& held, const State& still, int mode) {
  const AtPoint at(e, held, still);
  const Vector3d arm = to_centre(e, held, still);
  Matrix6 by_q = seen_from<6>(by_displacement(e, at), arm);
  by_q.bottomRightCorner<3, 3>() += cross_matrix(at.load.head<3>()) * cross_matrix(arm);
  const Matrix6 by_v = seen_from<6>(by_velocity(e, at), arm);
  return {.parts = {{.body = e.body, .by_motion = by_q.row(mode), .by_velocity = by_v.row(mode)}}};
}

}  // namespace

RestoringKind::RestoringKind(std::string effect, const std::vector<RigidBody>& bodies, std::vector<Restoring> elements)
    : effect_(std::move(effect)), elements_(std::move(elements)) {
  for (const Restoring& e : elements_) {
    const RigidBody& body = bodies[static_cast<std::size_t>(e.body)];
    held_.push_back({body.name(), body.rest_centre() + e.point, body.properties().centre_of_gravity.xyz});
  }
}

std::vector<Signal> RestoringKind::signals() const {
  std::vector<Signal> out;
  for (std::size_t i = 0; i < elements_.size(); ++i)
    for (int mode = 0; mode < 6; ++mode) {
      const Restoring& e = elements_[i];
      if (!e.told[static_cast<std::size_t>(mode)]) continue;
      const std::string name(hydro::mode_names[static_cast<std::size_t>(mode)]);
      out.push_back(
          {.name = e.name + "." + name,
           .unit = load_unit(mode),
           .meaning = fmt::format("{} load of {} on {} about its origin", name, e.name, held_[i].name),
           .value = [this, i,
                     mode](const Reading& r) { return load_about_origin(elements_[i], held_[i], r.state)[mode]; },
           .variation =
               [this, i, mode](const Still& still) {
                 return origin_variation(elements_[i], held_[i], still.state, mode);
               }});
    }
  return out;
}

void RestoringKind::add_load(const Instant& now, LoadSink& out) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const AtPoint at(elements_[i], held_[i], now.state);
    out.add(elements_[i].body, seen_from<1>(at.load, at.arm));
  }
}

void RestoringKind::add_jacobian(const Instant& now, JacobianSink& out) const {
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Restoring& e = elements_[i];
    const AtPoint at(e, held_[i], now.state);
    out.add(e.body, e.body, by_displacement(e, at), by_velocity(e, at));
  }
}

std::string RestoringKind::breaks_off(const State& before, const State& after) const {
  for (const Restoring& e : elements_) {
    if (e.stiffness.rightCols<3>().isZero(0)) continue;
    const auto body = static_cast<std::size_t>(e.body);
    if (jumps(rotation_log(before.pose[body].attitude), rotation_log(after.pose[body].attitude)))
      return fmt::format("a body of \"{}\" has turned by more than half a turn from rest, where that law ends",
                         effect_);
  }
  return {};
}

EnergyFlow RestoringKind::energy(const Instant& now) const {
  EnergyFlow flow;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Restoring& e = elements_[i];
    const AtPoint at(e, held_[i], now.state);
    flow.stored += 0.5 * at.displacement.dot(e.stiffness * at.displacement);
    flow.dissipated += at.velocity.dot(e.damping * at.velocity);
  }
  return flow;
}

}  // namespace dynamics
